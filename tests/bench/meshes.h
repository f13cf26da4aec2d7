/* Inputs that are the same on every machine and in every run: meshes and spheres by formula. */
#ifndef BENCH_MESHES_H
#define BENCH_MESHES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/scene.h"

/* The light of every input. */
#define BENCH_LIGHT_X 4.0f
#define BENCH_LIGHT_Y 5.0f
#define BENCH_LIGHT_Z 6.0f

typedef struct bench_input {
    char label[32];    /* "81920 triangles" */
    rt_scene scene;    /* with camera, light and materials */
    float *vertices;   /* owned: the same triangles with shared vertices, x y z each; NULL for */
    uint32_t *indices; /* spheres. Three indices a triangle, in the scene's order. */
    size_t vertex_count;
} bench_input;

/* A sphere of 20 * frequency^2 triangles, displaced by a few sine waves. 2^level gives the counts
 * of `level` subdivisions of the icosahedron. The picture is size x size. */
bool bench_input_icosphere(bench_input *input, unsigned frequency, int size, rt_status *status);

/* The frequency whose triangle count comes nearest. */
unsigned bench_frequency(size_t triangles);

/* `count` spheres of different sizes spread through a ball; one unit sphere for a count of 1. */
bool bench_input_spheres(bench_input *input, size_t count, int size, rt_status *status);

void bench_input_clear(bench_input *input);

/* A number in [0, 1) that depends on its arguments alone. */
double bench_random(uint64_t index, uint64_t stream);

#endif
