/* What the pictures of a study are held against. The scalar path in double takes a ray at a time,
 * so for a scene of many primitives or effects it would take hours; there the most accurate level
 * of a device takes its place, and its own rays are held against the scalar path. */
#include "common/clock.h"
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
        const rt_watch watch = rt_study_watch_still(s);
        const double start = rt_clock_seconds();
        const bool good = rt_scalar_double_render_by(s->tree, &scene, &image, &watch, s->status);
        const double taken = rt_clock_seconds() - start;
        rt_image_clear(&image);
        if (!good)
            return false;
        *seconds = taken * ((double)width * height) / ((double)scene.width * scene.height);
        if (taken > TRIAL_SECONDS || (scene.width == width && scene.height == height))
            return true;
    }
}

/* The most samples for which all reference pictures take no longer than that, in those of the
 * finest picture; fewer than CONVERGED_LEAST where nothing is that short. */
static int converged_times(double seconds, double sum, double most, double limit)
{
    int times = CONVERGED_MOST;
    while (times >= CONVERGED_LEAST && seconds * (sum + times * most) > limit)
        --times;
    return times;
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
    int times = converged_times(study->reference_seconds, sum, most, SCALAR_SECONDS_MOST);
    study->reference_is_scalar = times >= CONVERGED_LEAST;
    if (!study->reference_is_scalar)
        times = converged_times(device_seconds, 0.0, most, DEVICE_SECONDS_MOST);
    times = times < CONVERGED_LEAST ? CONVERGED_LEAST : times;
    study->converged_samples = times * (int)most;
    rt_forecast_expect(&s->forecast, RT_WORK_REFERENCE,
                       study->reference_is_scalar ? study->reference_seconds : device_seconds);
    rt_forecast_plan(&s->forecast, RT_WORK_REFERENCE, sum + study->converged_samples);
    return true;
}

bool rt_study_draw_reference(study_state *s, int samples, rt_image *image)
{
    const rt_study *study = s->study;
    const rt_watch watch = rt_study_watch(s);
    rt_study_begin_part(s, RT_WORK_REFERENCE, samples);
    if (study->reference_is_scalar) {
        const rt_scene scene = at_samples(s, samples);
        return rt_scalar_double_render_by(s->tree, &scene, image, &watch, s->status);
    }
    rt_renderer *renderer = rt_study_renderer(s, s->scene, s->how->bvh, study->reference_device,
                                              study->reference_level, samples);
    const bool good = renderer && rt_renderer_draw(renderer, image, &watch, s->status);
    rt_renderer_free(renderer);
    return good;
}
