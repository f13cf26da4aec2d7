/* What the pictures of a study are held against. The scalar path in double tries every primitive
 * with every ray, so for a scene of many primitives it would take hours; there the device's most
 * accurate level takes its place, and its own rays are held against the scalar path. */
#include "common/clock.h"
#include "reference/scalar.h"
#include "study/parts.h"

/* For all reference pictures together. */
#define SCALAR_SECONDS_MOST 60.0
#define DEVICE_SECONDS_MOST 60.0
/* Samples of the converged reference, in those of the finest picture: at most and at least. */
#define CONVERGED_MOST 4
#define CONVERGED_LEAST 2
/* A trial that takes less is mostly what comes before the rays. */
#define TRIAL_SECONDS 0.25

static rt_scene at_samples(const study_state *s, int samples)
{
    rt_scene scene = *s->scene;
    scene.accuracy = RT_ACCURACY_DOUBLE;
    scene.samples = samples;
    return scene;
}

/* Seconds that a picture at one sample a pixel takes, from smaller ones of the same view. */
static bool try_scalar(study_state *s, double *seconds)
{
    rt_scene scene = at_samples(s, 1);
    const int width = scene.width, height = scene.height;
    for (int side = 4;; side *= 4) {
        rt_image image;
        scene.width = side < width ? side : width;
        scene.height = side < height ? side : height;
        if (!rt_study_tick(s, 0.0) ||
            !rt_image_init(&image, scene.width, scene.height, false, s->status))
            return false;
        const rt_watch watch = rt_study_watch(s);
        const double start = rt_clock_seconds();
        const bool good = rt_scalar_double_render(&scene, &image, &watch, s->status);
        const double taken = rt_clock_seconds() - start;
        rt_image_clear(&image);
        if (!good)
            return false;
        *seconds = taken * ((double)width * height) / ((double)scene.width * scene.height);
        if (taken > TRIAL_SECONDS || (scene.width == width && scene.height == height))
            return true;
    }
}

bool rt_study_choose_reference(study_state *s, double device_seconds)
{
    rt_study *study = s->study;
    double sum = 0.0;
    for (size_t i = 0; i < study->plan.sample_count; ++i)
        sum += study->plan.samples[i];
    const double most = study->plan.samples[study->plan.sample_count - 1];
    if (!try_scalar(s, &study->reference_seconds))
        return false;
    int times = CONVERGED_MOST;
    while (times > CONVERGED_LEAST &&
           study->reference_seconds * (sum + times * most) > SCALAR_SECONDS_MOST)
        --times;
    study->reference_is_scalar =
        study->reference_seconds * (sum + times * most) <= SCALAR_SECONDS_MOST;
    if (!study->reference_is_scalar) {
        times = CONVERGED_MOST;
        while (times > CONVERGED_LEAST && device_seconds * times * most > DEVICE_SECONDS_MOST)
            --times;
    }
    study->converged_samples = times * (int)most;
    return true;
}

double rt_study_reference_seconds(const study_state *s, int samples, double device_seconds)
{
    return samples * (s->study->reference_is_scalar ? s->study->reference_seconds : device_seconds);
}

bool rt_study_draw_reference(study_state *s, int samples, rt_image *image)
{
    const rt_watch watch = rt_study_watch(s);
    if (s->study->reference_is_scalar) {
        const rt_scene scene = at_samples(s, samples);
        return rt_scalar_double_render(&scene, image, &watch, s->status);
    }
    rt_renderer *renderer =
        rt_study_renderer(s, s->scene, s->how->bvh, s->study->reference_level, samples);
    const bool good = renderer && rt_renderer_draw(renderer, image, &watch, s->status);
    rt_renderer_free(renderer);
    return good;
}
