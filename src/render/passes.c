/* A tile's way through the stages: sample by sample of its pixels, and each sample pass by pass,
 * until no ray goes on. */
#include "render/passes.h"

#include "render/state.h"

/* What the passes over one tile share. */
typedef struct passes {
    rt_renderer *r;
    const rt_tile *tile;
    flight *f;
    rt_status *status;
    size_t rays; /* in the ray array, padded to whole blocks */
    rt_turn turn;
} passes;

static size_t whole_blocks(size_t rays)
{
    return (rays + RT_BLOCK_RAYS - 1) / RT_BLOCK_RAYS * RT_BLOCK_RAYS;
}

static size_t rays_of_tile(const rt_tile *tile)
{
    const size_t across = ((size_t)tile->width + RT_BLOCK_SIDE - 1) / RT_BLOCK_SIDE;
    const size_t down = ((size_t)tile->height + RT_BLOCK_SIDE - 1) / RT_BLOCK_SIDE;
    return across * down * RT_BLOCK_RAYS;
}

static bool set_tile(passes *p, enum rt_stage stage)
{
    const int at = p->r->changing[stage].tile;
    return at < 0 ||
           RT_CL(clSetKernelArg(p->r->kernels[stage], (cl_uint)at, sizeof *p->tile, p->tile),
                 p->status);
}

static bool set_turn(passes *p, enum rt_stage stage)
{
    const int at = p->r->changing[stage].turn;
    return at < 0 ||
           RT_CL(clSetKernelArg(p->r->kernels[stage], (cl_uint)at, sizeof p->turn, &p->turn),
                 p->status);
}

static bool launch(passes *p, enum rt_stage stage, size_t rays)
{
    return rt_flight_launch(p->f, p->r, stage, rays, p->status);
}

static size_t lesser(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* The probes to light `row`, or of ambient light, as many at a time as their array holds: of all
 * samples for a part of the rays, so that what the probes from a hit have in common is found once,
 * and of a share of the samples where those for a single block do not fit. */
static bool probe(passes *p, int row, int samples, enum rt_stage rays, enum rt_stage any_hit,
                  enum rt_stage tally)
{
    const size_t capacity = (size_t)p->r->capacity, all = (size_t)samples;
    const size_t fit = capacity / RT_BLOCK_RAYS / all * RT_BLOCK_RAYS;
    const size_t most_rays = lesser(fit ? fit : RT_BLOCK_RAYS, p->rays);
    /* Rays are set long before; the analyzer loses sight of them over the launches.
     * NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult) */
    const size_t most_samples = lesser(capacity / most_rays, all);
    p->turn.light = row;
    for (size_t from = 0; from < p->rays; from += most_rays) {
        const size_t count = lesser(p->rays - from, most_rays);
        p->turn.from = (cl_int)from;
        p->turn.rays = (cl_int)count;
        for (size_t first = 0; first < all; first += most_samples) {
            p->turn.first = (cl_int)first;
            p->turn.count = (cl_int)lesser(all - first, most_samples);
            const size_t probes = count * (size_t)p->turn.count;
            /* A block's work-item makes the probes of all samples, a ray's that of one. */
            if (!set_turn(p, rays) || !launch(p, rays, p->r->lanes > 1 ? count : probes) ||
                !launch(p, any_hit, probes) || !set_turn(p, RT_STAGE_SHADOW_TALLY) ||
                !launch(p, tally, count))
                return false;
        }
    }
    return true;
}

static bool probe_all(passes *p)
{
    rt_renderer *r = p->r;
    const bool shadows =
        r->effects.on[RT_EFFECT_HARD_SHADOWS] || r->effects.on[RT_EFFECT_SOFT_SHADOWS];
    for (int k = 0; shadows && k < r->light_count; ++k)
        if (r->lights[k].shadow && !probe(p, k, r->lights[k].samples, RT_STAGE_SHADOW_RAYS,
                                          RT_STAGE_SHADOW, RT_STAGE_SHADOW_TALLY))
            return false;
    return !r->effects.on[RT_EFFECT_AMBIENT_OCCLUSION] ||
           probe(p, r->light_count, r->occlusion_samples, RT_STAGE_AMBIENT_RAYS, RT_STAGE_AMBIENT,
                 RT_STAGE_AMBIENT_TALLY);
}

/* Sends on what goes on from a pass, waits for it, and packs it. p->rays becomes 0 where nothing
 * does. */
static bool pack(passes *p)
{
    rt_renderer *r = p->r;
    const size_t blocks = p->rays / RT_BLOCK_RAYS;
    cl_int *counts = r->counts, *first = r->counts + RT_COUNT_COMPONENTS * blocks;
    cl_event event = NULL;
    if (!set_turn(p, RT_STAGE_NEXT) || !launch(p, RT_STAGE_NEXT, p->rays) ||
        !launch(p, RT_STAGE_COUNT_NEXT, p->rays) ||
        !RT_CL(clEnqueueReadBuffer(r->queue, r->tile[BUFFER_COUNTS], CL_TRUE, 0,
                                   RT_COUNT_COMPONENTS * blocks * sizeof *counts, counts, 0, NULL,
                                   &event),
               p->status) ||
        !rt_flight_add(p->f, r, EVENT_READ, event, p->status))
        return false;
    cl_int total = 0;
    for (size_t i = 0; i < blocks; ++i) {
        first[i] = total;
        total += counts[i * RT_COUNT_COMPONENTS + RT_COUNT_ALL];
        r->times.rays.refraction += (size_t)counts[i * RT_COUNT_COMPONENTS + RT_COUNT_REFRACTED];
        r->times.rays.reflection += (size_t)(counts[i * RT_COUNT_COMPONENTS + RT_COUNT_ALL] -
                                             counts[i * RT_COUNT_COMPONENTS + RT_COUNT_REFRACTED]);
    }
    const size_t rays = p->rays;
    p->rays = whole_blocks((size_t)total);
    if (total == 0)
        return true;
    const int at = r->changing[RT_STAGE_PACK].total;
    return RT_CL(clEnqueueWriteBuffer(r->queue, r->tile[BUFFER_FIRST], CL_TRUE, 0,
                                      blocks * sizeof *first, first, 0, NULL, NULL),
                 p->status) &&
           RT_CL(clSetKernelArg(r->kernels[RT_STAGE_PACK], (cl_uint)at, sizeof total, &total),
                 p->status) &&
           launch(p, RT_STAGE_PACK, rays);
}

/* Not whether the kernels could: whether the scene calls for it. */
static bool goes_on(const rt_renderer *r)
{
    return r->effects.on[RT_EFFECT_REFLECT] || r->effects.on[RT_EFFECT_REFRACT];
}

static bool interrupted(passes *p, const rt_watch *watch, double done)
{
    return !rt_watch_tick(watch, done) &&
           !rt_status_fail(p->status, RT_INTERRUPTED, "rt: interrupted");
}

/* One sample of each pixel: primary rays, and what goes on from them. */
static bool draw_sample(passes *p, bool hits, const rt_watch *watch, double done)
{
    p->rays = rays_of_tile(p->tile);
    if (!set_turn(p, RT_STAGE_CAMERA) || !launch(p, RT_STAGE_CAMERA, p->rays))
        return false;
    bool is_first = true;
    while (p->rays) {
        if (!launch(p, is_first ? RT_STAGE_TRACE : RT_STAGE_NEXT_TRACE, p->rays) ||
            (is_first && hits && !launch(p, RT_STAGE_HITS, p->rays)) || !probe_all(p) ||
            !launch(p, is_first ? RT_STAGE_SHADE : RT_STAGE_NEXT_SHADE, p->rays))
            return false;
        if (!goes_on(p->r))
            return true;
        if (!pack(p) || interrupted(p, watch, done))
            return false;
        is_first = false;
    }
    return true;
}

/* The sums of the samples before go to where the camera stage takes them up. */
static bool write_sums(passes *p, const rt_image *image)
{
    const rt_tile *tile = p->tile;
    const size_t size = RT_COLOR_COMPONENTS * sizeof *image->rgb;
    const size_t source[3] = {(size_t)tile->x * size, (size_t)tile->y, 0}, target[3] = {0, 0, 0};
    const size_t region[3] = {(size_t)tile->width * size, (size_t)tile->height, 1};
    return RT_CL(clEnqueueWriteBufferRect(p->r->queue, p->r->tile[BUFFER_PICTURE], CL_FALSE, target,
                                          source, region, region[0], 0, (size_t)p->r->width * size,
                                          0, image->rgb, 0, NULL, NULL),
                 p->status);
}

/* Reads a tile's rows into their place in a picture of `size`-byte pixels. */
static bool read_tile(passes *p, enum tile_buffer buffer, void *pixels, size_t size)
{
    rt_renderer *r = p->r;
    const rt_tile *tile = p->tile;
    const size_t source[3] = {0, 0, 0};
    const size_t target[3] = {(size_t)tile->x * size, (size_t)tile->y, 0};
    const size_t region[3] = {(size_t)tile->width * size, (size_t)tile->height, 1};
    cl_event event = NULL;
    return RT_CL(clEnqueueReadBufferRect(r->queue, r->tile[buffer], CL_FALSE, source, target,
                                         region, region[0], 0, (size_t)r->width * size, 0, pixels,
                                         0, NULL, &event),
                 p->status) &&
           rt_flight_add(p->f, r, EVENT_READ, event, p->status);
}

bool rt_passes_start(rt_renderer *r, const rt_tile *tile, const rt_sample_range *range,
                     rt_image *image, flight *f, const rt_watch *watch, double done, double share,
                     rt_status *status)
{
    passes all = {.r = r, .tile = tile, .f = f, .status = status}, *p = &all;
    p->turn.begin = range->first;
    p->turn.divisor = range->as_sums ? 1 : range->first + range->count;
    static const enum rt_stage placed[] = {RT_STAGE_CAMERA,       RT_STAGE_RESOLVE,
                                           RT_STAGE_HITS,         RT_STAGE_SHADOW_RAYS,
                                           RT_STAGE_AMBIENT_RAYS, RT_STAGE_NEXT};
    f->busy = true;
    r->times.tiles++;
    r->times.rays.primary += (size_t)tile->width * (size_t)tile->height * (size_t)range->count;
    for (size_t i = 0; i < sizeof placed / sizeof *placed; ++i)
        if (!set_tile(p, placed[i]))
            return false;
    if (range->first > 0 && !write_sums(p, image))
        return false;
    for (int q = 0; q < range->count; ++q) {
        const double now = done + share * q / range->count;
        p->turn.sample = range->first + q;
        if ((q > 0 && interrupted(p, watch, now)) ||
            !draw_sample(p, p->turn.sample == 0 && image->hits, watch, now))
            return false;
    }
    return set_turn(p, RT_STAGE_RESOLVE) && launch(p, RT_STAGE_RESOLVE, rays_of_tile(tile)) &&
           read_tile(p, BUFFER_PICTURE, image->rgb, 3 * sizeof *image->rgb) &&
           (!image->hits || range->first > 0 ||
            read_tile(p, BUFFER_RECORDS, image->hits, sizeof *image->hits)) &&
           RT_CL(clFlush(r->queue), status);
}

bool rt_passes_read_tallies(rt_renderer *r, rt_status *status)
{
    if (!r->tile[BUFFER_TALLIES])
        return true;
    const size_t count = (size_t)r->stride;
    cl_ulong sums[RT_TALLY_COMPONENTS] = {0};
    cl_int error = CL_SUCCESS;
    const cl_ulong *tallies =
        clEnqueueMapBuffer(r->queue, r->tile[BUFFER_TALLIES], CL_TRUE, CL_MAP_READ, 0,
                           RT_TALLY_COMPONENTS * count * sizeof *tallies, 0, NULL, NULL, &error);
    if (!RT_CL_MADE(error, "clEnqueueMapBuffer", status))
        return false;
    for (size_t c = 0; c < RT_TALLY_COMPONENTS; ++c)
        for (size_t i = 0; i < count; ++i)
            sums[c] += tallies[c * count + i];
    if (!RT_CL(clEnqueueUnmapMemObject(r->queue, r->tile[BUFFER_TALLIES], (void *)tallies, 0, NULL,
                                       NULL),
               status))
        return false;
    r->times.rays.shadow = sums[RT_TALLY_SHADOW];
    r->times.rays.occlusion = sums[RT_TALLY_AMBIENT];
    r->times.rays.cut = sums[RT_TALLY_CUT];
    r->times.rays.cut_light = (double)sums[RT_TALLY_CUT_PART] * (double)RT_CUT_UNIT;
    r->times.rays.ended = sums[RT_TALLY_ENDED];
    return true;
}
