/* The scene: what is seen, from where, in which light. Plain arrays that a device can take as they
 * are (kernels/layout.h); all numbers are fp32 and count as exact. */
#ifndef RT_SCENE_SCENE_H
#define RT_SCENE_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "common/accuracy.h"
#include "common/status.h"
#include "image/encoding.h"
#include "kernels/layout.h"
#include "scene/primitive.h"
#include "scene/triangle.h"

#define RT_IMAGE_SIDE_MAX 65535
/* 16384 x 16384: pixel counts and byte counts of a picture stay within 32 bits unsigned. */
#define RT_IMAGE_PIXELS_MAX (INT64_C(1) << 28)
#define RT_SHININESS_MAX 1e6f
/* Rays a pixel, shadow rays a point, occlusion rays a point. */
#define RT_SAMPLES_MAX 4096
#define RT_DEPTH_MAX 65536
/* Of all textures together: 1 GiB, and every index and byte count is within 32 bits. */
#define RT_TEXELS_MAX (INT64_C(1) << 28)

typedef struct rt_vec3 {
    float x, y, z;
} rt_vec3;

/* Where a statement stands, for `--explain` and messages; line 0 where none called for it. */
typedef struct rt_place {
    const char *file; /* owned by the scene */
    int line;
} rt_place;

typedef struct rt_camera {
    rt_vec3 from, at, up;
    float vfov;     /* degrees, whole angle from bottom to top, in (0, 180) */
    float aperture; /* diameter of the lens; 0 for a pinhole */
    float focus;    /* distance along the view of what is sharp; 0 for that of `at` */
} rt_camera;

enum rt_cull { RT_CULL_NONE, RT_CULL_BACK, RT_CULL_FRONT };
enum rt_winding { RT_WINDING_CCW, RT_WINDING_CW };
enum rt_filter { RT_FILTER_BOX, RT_FILTER_TENT };

typedef struct rt_scene {
    int width, height; /* pixels */
    enum rt_accuracy accuracy;
    /* All lengths and coordinates below are the file's times 2^unit_exponent, which is 0 but for
     * very small and very large scenes; what is per length is divided by it. t of rays that a
     * caller brings, and of hit records, is the file's. */
    int unit_exponent;
    int samples; /* rays a pixel, 1 up */
    enum rt_filter filter;
    uint32_t seed;        /* of the sample points: another one gives other noise */
    rt_encoding encoding; /* of the picture's file */
    int depth;            /* mirror and refracted rays in a row, at most */
    rt_camera camera;
    rt_vec3 background, ambient;
    bool has_gradient;      /* the background goes from `background` to `background_top` */
    rt_vec3 background_top; /* opposite to and along the camera's `up` */
    rt_vec3 fog;
    float fog_density;     /* per unit of length; 0 for none */
    int occlusion_samples; /* 0 for none */
    float occlusion_distance;
    enum rt_cull cull;
    enum rt_winding winding;
    /* The statements that call for effects; the first one for smooth normals. */
    rt_place cull_place, smooth_place, image_place, camera_place, background_place, fog_place;
    rt_place occlusion_place;

    /* Each kind's primitives by number, and the same by name: spheres, sphere_materials,
     * sphere_count, sphere_capacity. Primitive indices go through the kinds one after another. */
    union {
        rt_primitives kinds[RT_KIND_COUNT];
        struct {
#define RT_KIND_BY_NAME(name, names, NAMES)                                                        \
    rt_##name *names;                                                                              \
    int32_t *name##_materials;                                                                     \
    size_t name##_count, name##_capacity;
            RT_KINDS(RT_KIND_BY_NAME)
        };
    };

    /* All arrays are owned. */
    rt_light *lights;
    rt_place *light_places; /* of what calls for the shadow of each, or of the light */
    rt_material *materials;
    rt_place *material_places;
    int32_t *triangle_normals; /* record in `normals`, or -1 */
    float *normals;            /* RT_NORMAL_COMPONENTS a record: na, nb, nc */
    int32_t *triangle_uvs;     /* record in `uvs`, or -1 */
    float *uvs;                /* RT_UV_COMPONENTS a record */
    rt_texture *textures;
    char **texture_files; /* the path of each, without links and dots */
    uint32_t *texels;     /* of all textures */
    size_t light_count, light_capacity;
    size_t material_count, material_capacity;
    size_t triangle_record_capacity;      /* of triangle_normals and triangle_uvs */
    size_t normal_count, normal_capacity; /* records */
    size_t uv_count, uv_capacity;         /* records */
    size_t texture_count, texture_capacity;
    size_t texel_count, texel_capacity;

    char **files; /* names of the files read, in order of opening: what places point to */
    size_t file_count, file_capacity;
} rt_scene;

/* An empty scene with the defaults of the format: 512x512, eye at the origin looking along -z,
 * vfov 90, everything black. */
void rt_scene_init(rt_scene *scene);
void rt_scene_clear(rt_scene *scene);

/* Each adds one element and returns false, with the status set, when memory or the 2^31 - 1
 * primitives that an index can name run out. `normals` is NULL or nine floats. Lights and materials
 * have no place until one is set. */
bool rt_scene_add_light(rt_scene *scene, const rt_light *light, rt_status *status);
bool rt_scene_add_material(rt_scene *scene, const rt_material *material, rt_status *status);
bool rt_scene_add_primitive(rt_scene *scene, enum rt_kind kind, const void *primitive,
                            int32_t material, rt_status *status);
bool rt_scene_add_sphere(rt_scene *scene, const rt_sphere *sphere, int32_t material,
                         rt_status *status);
bool rt_scene_add_triangle(rt_scene *scene, const rt_triangle *triangle, const float *normals,
                           int32_t material, rt_status *status);

/* Gives the triangle added last its texture coordinates: RT_UV_COMPONENTS floats. */
bool rt_scene_set_uvs(rt_scene *scene, const float *uvs, rt_status *status);

/* Makes room at once for so many triangles more, and records of normals. */
bool rt_scene_reserve_triangles(rt_scene *scene, size_t triangles, size_t normals,
                                rt_status *status);

/* Primitives of all kinds together, and those of the kinds before one. */
size_t rt_scene_primitive_count(const rt_scene *scene);
size_t rt_scene_primitives_before(const rt_scene *scene, enum rt_kind kind);
/* The kind of the primitive of an index, which is made the place among those of its kind. */
static inline enum rt_kind rt_scene_kind_of(const rt_scene *scene, size_t *index)
{
    int kind = 0;
    for (; kind < RT_KIND_COUNT - 1 && *index >= scene->kinds[kind].count; ++kind)
        *index -= scene->kinds[kind].count;
    return (enum rt_kind)kind;
}

/* Brings a scene that is complete to a unit of length (unit_exponent) in which the arithmetic of
 * float has room: largest coordinate of primitives and eye from 2^-10 to 2^38. Exact, but for what
 * is 2^126 times smaller than the largest. A scene read from a file has been through it. */
void rt_scene_choose_unit(rt_scene *scene);

/* Once more of a scene that is complete: tells the lights that a primitive passes through (gap). */
void rt_scene_settle_lights(rt_scene *scene);

/* A material for the given coefficients (ka, kd, ks: r g b each). */
rt_material rt_material_make(const float ka[3], const float kd[3], const float ks[3],
                             float shininess);

/* +1 or -1: the only sign of the Moller-Trumbore determinant that is a hit; 0: both are. */
int rt_scene_cull_sign(const rt_scene *scene);

#endif
