/* Embree 3 as the other tracer: the same triangles, spheres and rays, in the layouts it likes. */
#ifndef BENCH_EMBREE_H
#define BENCH_EMBREE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "bench/meshes.h"
#include "bench/rays.h"
#include "common/status.h"
#include "image/image.h"

enum bench_call { BENCH_INTERSECT1, BENCH_INTERSECT16, BENCH_OCCLUDED1, BENCH_OCCLUDED16 };

typedef struct bench_embree bench_embree;

/* Builds the tree at Embree's default quality with `threads` threads; `rays` is the most that a
 * trace will take. Returns NULL after an error. */
bench_embree *bench_embree_new(const bench_input *input, bool is_robust, int threads, size_t rays,
                               rt_status *status);
void bench_embree_free(bench_embree *embree);

/* Seconds that rtcCommitScene took, and bytes that Embree holds (its copies of the vertices and
 * indices not among them). */
double bench_embree_build_seconds(const bench_embree *embree);
size_t bench_embree_bytes(const bench_embree *embree);

/* The rays in packets of 16, a 4x4 block of pixels each. */
typedef struct bench_packets {
    const bench_rays *rays;
    struct bench_packet *packets; /* owned */
} bench_packets;

bool bench_packets_make(bench_packets *packets, const bench_rays *rays, rt_status *status);
void bench_packets_clear(bench_packets *packets);

/* Traces all rays and tells the wall seconds from the moment when all threads stand ready to the
 * moment when the last is done. */
bool bench_embree_trace(bench_embree *embree, const bench_packets *packets, enum bench_call call,
                        bool is_coherent, double *seconds, rt_status *status);

/* What the latest trace found, in the order of the rays: hit records (t of a miss is not set) after
 * an intersect call, and a byte a ray, 1 for a hit, after any. */
void bench_embree_hits(const bench_embree *embree, rt_hit *hits);
void bench_embree_is_hit(const bench_embree *embree, uint8_t *is_hit);

#endif
