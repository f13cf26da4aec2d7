/* Which effects a scene calls for, by which statement, and what each costs on a device. */
#ifndef RT_STUDY_EXPLAIN_H
#define RT_STUDY_EXPLAIN_H

#include <stdio.h>

#include "common/file.h"
#include "render/renderer.h"
#include "study/figures.h"

/* Seconds a picture. Each pair of pictures, one with the effect and one without it but with all the
 * others, is one sample. */
typedef struct rt_explain_cost {
    bool is_measured;
    bool has_stages;  /* whether kernels of its own run for it, or it is a part of others */
    rt_spread stages; /* what they take, by the device's clock */
    rt_spread with, without, difference; /* wall time of the whole */
} rt_explain_cost;

typedef struct rt_explanation {
    rt_effects effects;
    const rt_device *device; /* NULL where nothing was measured */
    int width, height;       /* of the pictures that were measured: smaller where that is slow */
    int picture_width, picture_height;
    int pairs;
    rt_explain_cost costs[RT_EFFECT_COUNT];
} rt_explanation;

/* What the scene calls for, which is `effects`, without any cost. */
rt_explanation rt_explain(const rt_scene *scene, const rt_effects *effects);

/* Measures every effect that is on. The tree is the scene's own, or NULL; the options' effects do
 * not count. The picture is made
 * smaller where it would take minutes; kernels that are built for the first time add to the time.
 */
bool rt_explain_measure(rt_explanation *explanation, const rt_scene *scene, const rt_bvh *bvh,
                        const rt_device *device, const rt_render_options *options,
                        const rt_watch *watch, rt_status *status);

/* A table for people, and JSON for programs. */
void rt_explain_print(const rt_explanation *explanation, FILE *out);
bool rt_explain_write(const rt_explanation *explanation, rt_output *output, rt_status *status);

#endif
