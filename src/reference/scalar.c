/* The pictures of the scalar reference: rays from the camera through the pixels, and the mean of
 * what they bring back. */
#include "reference/scalar.h"

#include <pthread.h>

#include "common/parallel.h"
#include "reference/effects.h"
#include "scene/camera.h"

/* The camera at this precision. */
typedef struct eye {
    vec origin, right, up, forward;
    vec lens_right, lens_up; /* the lens's radius along the picture's axes */
    real focus;              /* how far away along `forward` everything is sharp */
} eye;

/* A picture in the making, shared by the threads that take its rows. */
typedef struct picture {
    const rt_scene *scene;
    scalar_world world;
    rt_image *image;
    const rt_watch *watch;
    eye e;
    pthread_mutex_t lock; /* of what follows, and of the watch */
    rt_ray_counts counts;
    int rows_done;
    bool is_stopped;
} picture;

static void set_lens(eye *e, const rt_view *view)
{
    const double *r = view->lens_right, *u = view->lens_up;
    e->lens_right = (vec){(real)r[0], (real)r[1], (real)r[2]};
    e->lens_up = (vec){(real)u[0], (real)u[1], (real)u[2]};
    e->focus = (real)view->focus;
}

static eye eye_of(const rt_scene *scene)
{
    const rt_view v = rt_scene_view(scene);
#ifdef RT_SCALAR_DOUBLE
    eye e = {.origin = {v.origin[0], v.origin[1], v.origin[2]},
             .right = {v.right[0], v.right[1], v.right[2]},
             .up = {v.up[0], v.up[1], v.up[2]},
             .forward = {v.forward[0], v.forward[1], v.forward[2]}};
#else
    const rt_frame f = rt_scene_frame(scene);
    eye e = {.origin = {f.ox, f.oy, f.oz},
             .right = {f.right_x, f.right_y, f.right_z},
             .up = {f.up_x, f.up_y, f.up_z},
             .forward = {f.forward_x, f.forward_y, f.forward_z}};
#endif
    set_lens(&e, &v);
    return e;
}

/* A single sample goes through the pixel's centre. */
static ray primary_ray(const rt_scene *scene, const eye *e, const stream *samples)
{
    pair offset = {0, 0};
    if (scene->samples > 1) {
        const pair p = NAME(sample_point)(samples, FOR_PIXEL, samples->sample);
        offset = (pair){NAME(filtered)(scene->filter, p.x), NAME(filtered)(scene->filter, p.y)};
    }
    /* In half pixels from the middle of the picture; rows count downwards. */
    const real across = (real)(2 * (int)samples->x + 1 - scene->width) + 2 * offset.x;
    const real upward = (real)(scene->height - 1 - 2 * (int)samples->y) - 2 * offset.y;
    const vec through = add_scaled(e->right, across, add_scaled(e->up, upward, e->forward));
    if (!(scene->camera.aperture > 0.0f))
        return (ray){e->origin, unit(through), 0, INFINITY};
    const pair p = NAME(disk)(NAME(sample_point)(samples, FOR_LENS, samples->sample));
    const vec lens = add_scaled(e->lens_up, p.y, times(e->lens_right, p.x));
    const vec direction = add_scaled(through, e->focus, times(lens, -1));
    return (ray){plus(e->origin, lens), unit(direction), 0, INFINITY};
}

static void draw_pixel(const picture *p, const scalar_world *world, int x, int y)
{
    const size_t i = (size_t)y * (size_t)p->image->width + (size_t)x;
    const real count = (real)p->scene->samples;
    vec sum = {0, 0, 0};
    for (int sample = 0; sample < p->scene->samples; ++sample) {
        const stream samples = {(uint32_t)x, (uint32_t)y, (uint32_t)sample, 0, p->scene->seed};
        const ray r = primary_ray(p->scene, &p->e, &samples);
        const hit h = NAME(closest)(world, &r);
        sum = plus(sum, NAME(radiance)(world, &r, &h, &samples));
        if (sample == 0 && p->image->hits)
            p->image->hits[i] = (rt_hit){h.primitive, (float)LDEXP(h.t, -p->scene->unit_exponent),
                                         (float)h.u, (float)h.v};
    }
    p->image->rgb[3 * i] = (float)(sum.x / count);
    p->image->rgb[3 * i + 1] = (float)(sum.y / count);
    p->image->rgb[3 * i + 2] = (float)(sum.z / count);
}

static void draw_row(void *context, size_t row)
{
    picture *p = context;
    pthread_mutex_lock(&p->lock);
    const double done = (double)p->rows_done / p->image->height;
    if (!p->is_stopped && !rt_watch_tick(p->watch, done))
        p->is_stopped = true;
    const bool is_stopped = p->is_stopped;
    ++p->rows_done;
    pthread_mutex_unlock(&p->lock);
    if (is_stopped)
        return;
    rt_ray_counts counts = {.primary = (size_t)p->image->width * (size_t)p->scene->samples};
    scalar_world world = p->world;
    world.counts = &counts;
    for (int x = 0; x < p->image->width; ++x)
        draw_pixel(p, &world, x, (int)row);
    pthread_mutex_lock(&p->lock);
    rt_ray_counts_add(&p->counts, &counts);
    pthread_mutex_unlock(&p->lock);
}

static bool render(const rt_scalar_tree *tree, const rt_scene *scene, rt_image *image,
                   rt_ray_counts *counts, const rt_watch *watch, rt_status *status)
{
    picture p = {.scene = scene,
                 .world = NAME(world_open)(scene, tree),
                 .image = image,
                 .watch = watch,
                 .e = eye_of(scene),
                 .lock = PTHREAD_MUTEX_INITIALIZER};
    const bool has_memory = p.world.media.list != NULL;
    if (has_memory)
        rt_parallel((size_t)image->height, rt_parallel_processors(), draw_row, &p);
    pthread_mutex_destroy(&p.lock);
    NAME(world_leave)(&p.world, tree);
    if (!has_memory)
        return rt_status_no_memory(status, "media");
    if (p.is_stopped)
        return rt_status_fail(status, RT_INTERRUPTED, "rt: interrupted");
    if (counts)
        *counts = p.counts;
    return true;
}

bool NAME(render_by)(const rt_scalar_tree *tree, const rt_scene *scene, rt_image *image,
                     const rt_watch *watch, rt_status *status)
{
    return render(tree, scene, image, NULL, watch, status);
}

bool NAME(render_counted)(const rt_scene *scene, rt_image *image, rt_ray_counts *counts,
                          const rt_watch *watch, rt_status *status)
{
    return render(NULL, scene, image, counts, watch, status);
}

bool NAME(render)(const rt_scene *scene, rt_image *image, const rt_watch *watch, rt_status *status)
{
    return render(NULL, scene, image, NULL, watch, status);
}
