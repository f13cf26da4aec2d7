#define _POSIX_C_SOURCE 200809L
#include "render/team.h"

#include <pthread.h>
#include <stdlib.h>

#include "common/clock.h"
#include "render/tiles.h"

/* Where the caller leaves it to us, tiles are halved until each device can have this many: the last
 * ones, for which a fast device waits, are then a small part of the picture. */
#define TILES_A_MEMBER 16
#define TILE_SMALLEST 64

typedef struct member {
    rt_team *team;
    const rt_device *device;
    rt_renderer *renderer;
    rt_status *status; /* `own`, or the caller's where there is one member */
    rt_status own;
    pthread_t thread;
    bool has_thread;
    double seconds;
    bool good; /* whether its last task went well */
} member;

struct rt_team {
    member *members; /* owned: count of them */
    size_t count;
    int width, height, tile_side;
    /* What threads read while they work. */
    const rt_scene *scene;
    const rt_bvh *bvh;
    rt_render_options options;
    rt_tiles tiles;
    const rt_sample_range *range;
    rt_image *image;
    const rt_watch *watch;
    /* The caller's watch under a lock. */
    const rt_watch *inner;
    pthread_mutex_t lock;
    double done;
    bool stopped;
};

static void *make_renderer(void *argument)
{
    member *m = argument;
    m->renderer =
        rt_renderer_new(m->device, m->team->scene, m->team->bvh, &m->team->options, m->status);
    m->good = m->renderer != NULL;
    return NULL;
}

static void *draw_tiles(void *argument)
{
    member *m = argument;
    rt_team *team = m->team;
    const double start = rt_clock_seconds();
    m->good = rt_renderer_draw_tiles(m->renderer, &team->tiles, team->range, team->image,
                                     team->watch, m->status);
    m->seconds += rt_clock_seconds() - start;
    if (!m->good)
        rt_tiles_stop(&team->tiles);
    return NULL;
}

/* A status's text without its last newline, for "%.*s". */
static int length_of(const rt_status *status)
{
    return status->length ? (int)status->length - 1 : 0;
}

static const char *text_of(const rt_status *status)
{
    return status->text ? status->text : "";
}

/* Moves what several members say to the caller's status. More than one may have failed, or seen the
 * one interrupt: the first failure tells most. */
static bool collect(rt_team *team, rt_status *status)
{
    const member *first = NULL;
    for (size_t i = 0; i < team->count; ++i) {
        const member *m = &team->members[i];
        if (m->good && m->own.length)
            rt_status_warn(status, "%.*s", length_of(&m->own), text_of(&m->own));
        if (!m->good && (!first || first->own.code == RT_INTERRUPTED))
            first = m;
    }
    if (first && first->own.code == RT_INTERRUPTED)
        rt_status_fail(status, RT_INTERRUPTED, "%.*s", length_of(&first->own),
                       text_of(&first->own));
    else if (first)
        rt_status_fail(status, first->own.code, "rt: device %d, %s, failed:\n%.*s",
                       first->device->index, first->device->name, length_of(&first->own),
                       text_of(&first->own));
    for (size_t i = 0; i < team->count; ++i)
        rt_status_clear(&team->members[i].own);
    return first == NULL;
}

/* Runs a task for every member at the same time; the first member's in the calling thread, and that
 * of a member for which no thread could be had after it. */
static bool for_all(rt_team *team, void *(*task)(void *), rt_status *status)
{
    member *members = team->members;
    if (team->count == 1) {
        members->status = status;
        task(members);
        return members->good;
    }
    for (size_t i = 0; i < team->count; ++i)
        members[i].status = &members[i].own;
    for (size_t i = 1; i < team->count; ++i)
        members[i].has_thread = pthread_create(&members[i].thread, NULL, task, &members[i]) == 0;
    for (size_t i = 0; i < team->count; ++i)
        if (!members[i].has_thread)
            task(&members[i]);
    for (size_t i = 1; i < team->count; ++i)
        if (members[i].has_thread)
            pthread_join(members[i].thread, NULL);
    return collect(team, status);
}

static int choose_side(const rt_team *team, int side)
{
    const size_t pixels = (size_t)team->width * (size_t)team->height;
    const size_t enough = TILES_A_MEMBER * team->count;
    if (side)
        return side;
    side = RT_TILE_DEFAULT;
    while (team->count > 1 && side > TILE_SMALLEST && pixels < enough * (size_t)side * (size_t)side)
        side /= 2;
    return side;
}

/* Threads come in any order, but what the caller's watch sees never goes back, and once it has said
 * stop it is not asked again. */
static bool tick_locked(void *context, double done)
{
    rt_team *team = context;
    pthread_mutex_lock(&team->lock);
    if (done > team->done)
        team->done = done;
    if (!team->stopped)
        team->stopped = !rt_watch_tick(team->inner, team->done);
    const bool stopped = team->stopped;
    pthread_mutex_unlock(&team->lock);
    return !stopped;
}

rt_team *rt_team_new(const rt_device *const *devices, size_t count, const rt_scene *scene,
                     const rt_bvh *bvh, const rt_render_options *options, rt_status *status)
{
    rt_team *team = calloc(1, sizeof *team);
    member *members = calloc(count, sizeof *members);
    if (!team || !members) {
        free(team);
        free(members);
        rt_status_no_memory(status, "the renderers");
        return NULL;
    }
    team->members = members;
    team->count = count;
    team->width = scene->width;
    team->height = scene->height;
    team->tile_side = choose_side(team, options->tile);
    team->scene = scene;
    team->bvh = bvh;
    team->options = *options;
    team->options.tile = team->tile_side;
    pthread_mutex_init(&team->lock, NULL);
    for (size_t i = 0; i < count; ++i) {
        members[i].team = team;
        members[i].own = RT_STATUS_INIT;
        members[i].device = devices[i];
    }
    const rt_watch locked = {tick_locked, team};
    team->inner = options->building;
    if (count > 1 && options->building)
        team->options.building = &locked;
    const bool good = for_all(team, make_renderer, status);
    team->scene = NULL; /* scene and tree may be cleared from here on */
    team->bvh = NULL;
    team->inner = team->options.building = NULL;
    if (good)
        return team;
    rt_team_free(team);
    return NULL;
}

void rt_team_free(rt_team *team)
{
    if (!team)
        return;
    for (size_t i = 0; i < team->count; ++i)
        rt_renderer_free(team->members[i].renderer);
    pthread_mutex_destroy(&team->lock);
    free(team->members);
    free(team);
}

bool rt_team_draw(rt_team *team, rt_image *image, const rt_watch *watch, rt_status *status)
{
    return rt_team_draw_range(team, NULL, image, watch, status);
}

bool rt_team_draw_range(rt_team *team, const rt_sample_range *range, rt_image *image,
                        const rt_watch *watch, rt_status *status)
{
    const rt_watch locked = {tick_locked, team};
    rt_tiles_init(&team->tiles, team->width, team->height, team->tile_side, (int)team->count);
    team->range = range;
    team->image = image;
    team->inner = watch;
    team->watch = team->count > 1 && watch ? &locked : watch;
    team->done = 0.0;
    team->stopped = false;
    const bool good = for_all(team, draw_tiles, status);
    team->range = NULL;
    team->image = NULL;
    team->inner = team->watch = NULL;
    return good;
}

size_t rt_team_count(const rt_team *team)
{
    return team->count;
}

rt_team_share rt_team_share_of(const rt_team *team, size_t i)
{
    const member *m = &team->members[i];
    const rt_render_times *times = rt_renderer_times(m->renderer);
    return (rt_team_share){m->device, rt_renderer_lanes(m->renderer), times->tiles,
                           times->rays.primary, m->seconds};
}

static double longer(double a, double b)
{
    return a > b ? a : b;
}

rt_render_times rt_team_times(const rt_team *team)
{
    rt_render_times sum = *rt_renderer_times(team->members[0].renderer);
    for (size_t i = 1; i < team->count; ++i) {
        const rt_render_times *times = rt_renderer_times(team->members[i].renderer);
        sum.program = longer(sum.program, times->program);
        sum.upload = longer(sum.upload, times->upload);
        sum.readback = longer(sum.readback, times->readback);
        for (int stage = 0; stage < RT_STAGE_COUNT; ++stage) {
            sum.stages[stage] += times->stages[stage];
            sum.launches[stage] += times->launches[stage];
        }
        sum.tiles += times->tiles;
        rt_ray_counts_add(&sum.rays, &times->rays);
    }
    return sum;
}
