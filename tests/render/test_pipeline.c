/* The stages that a scene calls for, and none beside; pictures that do not depend on how they come
 * about: tiles, lanes, everything compiled in; light that is neither made nor lost. */
#define _GNU_SOURCE
#include "support/support.h"

#include <glob.h>
#include <math.h>
#include <string.h>

#include "reference/scalar.h"
#include "render/programs.h"

#define WALK                                                                                       \
    (rt_walk)                                                                                      \
    {                                                                                              \
        .lanes = 1, .packet = 1, .stack_size = 64, .accuracy = RT_ACCURACY_STANDARD                \
    }

/* A scene of every effect but a picture. */
static const char everything[] =
    "image width 72 height 40 samples 2 filter tent\n"
    "camera from 0 1.2 4 at 0 0.5 0 vfov 45 aperture 0.3 focus 4\n"
    "background 0.3 0.4 0.6 top 0.7 0.8 1\nambient 0.3 0.3 0.3\n"
    "fog 0.7 0.7 0.75 density 0.08\nocclusion samples 3 distance 1\nshadows on\ndepth 4\n"
    "light point at 3 5 3 color 0.8 0.8 0.8\n"
    "light point at -3 4 2 color 0.3 0.3 0.2 radius 0.5 samples 5\n"
    "material floor ka 0.9 0.9 0.9 kd 0.9 0.9 0.9 checker 0.2 0.2 0.25 cell 0.5 reflect 0.1\n"
    "material glass ks 0.5 0.5 0.5 shininess 100 transmit 0.9 reflect 0.1 absorb 0.1 0.5 0.2\n"
    "triangle a -9 0 -9 b -9 0 9 c 9 0 9 material floor\n"
    "triangle a -9 0 -9 b 9 0 9 c 9 0 -9 material floor\n"
    "sphere center 0 0.5 0 radius 0.5 material glass\n"
    "sphere center 1.1 0.5 -0.6 radius 0.5 material glass\n";

static const char plain[] = "image width 40 height 24\nambient 0.5 0.5 0.5\n"
                            "light point at 3 5 3\nmaterial m ka 1 0 0 kd 1 1 1\n"
                            "sphere center 0 0 -3 radius 1 material m\n";

/* The programs that a scene's effects build; with any hit as the renderer says it. */
static void build(rt_programs *programs, const rt_effects *effects, bool with_any_hit,
                  cl_context *context)
{
    const rt_device *device = test_device();
    rt_status status = RT_STATUS_INIT;
    const rt_walk walk = WALK;
    cl_int error = CL_SUCCESS;
    *context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &error);
    assert_int_equal(error, CL_SUCCESS);
    assert_good(
        rt_programs_build(programs, *context, device, effects, &walk, with_any_hit, NULL, &status),
        &status);
}

/* The kernels' names between semicolons, one at each end too. */
static void kernel_names(const rt_programs *programs, char *names, size_t size)
{
    strcpy(names, ";");
    for (int part = 0; part < RT_PART_COUNT; ++part) {
        const size_t length = strlen(names);
        if (!programs->parts[part])
            continue;
        assert_int_equal(clGetProgramInfo(programs->parts[part], CL_PROGRAM_KERNEL_NAMES,
                                          size - length - 1, names + length, NULL),
                         CL_SUCCESS);
        strcat(names, ";");
    }
}

static cl_uint argument_count(const rt_programs *programs, const char *name)
{
    cl_uint count = 0;
    cl_int error = CL_INVALID_KERNEL_NAME;
    cl_kernel kernel = NULL;
    for (int part = 0; part < RT_PART_COUNT && error != CL_SUCCESS; ++part)
        if (programs->parts[part])
            kernel = clCreateKernel(programs->parts[part], name, &error);
    assert_int_equal(error, CL_SUCCESS);
    assert_int_equal(clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof count, &count, NULL),
                     CL_SUCCESS);
    clReleaseKernel(kernel);
    return count;
}

/* The kernels that a scene with one effect has beside those of Phong alone, and that their
 * parameters are the same in each. */
static void what_each_effect_adds(void **state)
{
    (void)state;
    static const struct {
        enum rt_effect effect;
        const char *kernels[3]; /* up to a NULL */
    } cases[] = {
        {RT_EFFECT_COUNT, {NULL}},
        {RT_EFFECT_SMOOTH, {NULL}},
        {RT_EFFECT_CHECKER, {NULL}},
        {RT_EFFECT_TEXTURE, {NULL}},
        {RT_EFFECT_HARD_SHADOWS, {"rt_shadow_rays", "rt_tally", NULL}},
        {RT_EFFECT_SOFT_SHADOWS, {"rt_shadow_rays", "rt_tally", NULL}},
        {RT_EFFECT_AMBIENT_OCCLUSION, {"rt_ambient_rays", "rt_tally", NULL}},
        {RT_EFFECT_REFLECT, {"rt_next", "rt_count", "rt_pack"}},
        {RT_EFFECT_REFRACT, {"rt_next", "rt_count", "rt_pack"}},
        {RT_EFFECT_FOG, {NULL}},
        {RT_EFFECT_GRADIENT, {NULL}},
        {RT_EFFECT_ANTIALIAS, {NULL}},
        {RT_EFFECT_LENS, {NULL}},
    };
    static const char *const always[] = {"rt_camera", "rt_trace", "rt_shade", "rt_resolve",
                                         "rt_resolve_hits"};
    cl_uint counts[sizeof always / sizeof *always];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        rt_effects effects = {.has_kind = {true, true}, .exponent_bits = 8};
        const bool probes = cases[i].effect == RT_EFFECT_HARD_SHADOWS ||
                            cases[i].effect == RT_EFFECT_SOFT_SHADOWS ||
                            cases[i].effect == RT_EFFECT_AMBIENT_OCCLUSION;
        if (cases[i].effect < RT_EFFECT_COUNT)
            effects.on[cases[i].effect] = true;
        cl_context context;
        rt_programs programs;
        char names[1024], name[64];
        build(&programs, &effects, probes, &context);
        kernel_names(&programs, names, sizeof names);
        size_t expected = sizeof always / sizeof *always + probes, found = 0;
        for (size_t k = 0; k < 3 && cases[i].kernels[k]; ++k) {
            snprintf(name, sizeof name, ";%s;", cases[i].kernels[k]);
            assert_non_null(strstr(names, name));
            ++expected;
        }
        for (const char *at = names + 1; *at; ++at)
            found += *at == ';';
        assert_int_equal(found, expected);
        for (size_t k = 0; k < sizeof always / sizeof *always; ++k) {
            if (i == 0)
                counts[k] = argument_count(&programs, always[k]);
            assert_int_equal(argument_count(&programs, always[k]), counts[k]);
        }
        rt_programs_release(&programs);
        clReleaseContext(context);
    }
}

static void phong_alone_launches_four_kernels(void **state)
{
    (void)state;
    rt_scene scene;
    rt_image image;
    rt_status status = RT_STATUS_INIT;
    test_scene(&scene, plain);
    assert_good(rt_image_init(&image, scene.width, scene.height, false, &status), &status);
    rt_renderer *renderer = test_renderer(&scene, &(rt_render_options){0});
    assert_good(rt_renderer_draw(renderer, &image, NULL, &status), &status);
    const rt_render_times *times = rt_renderer_times(renderer);
    for (int i = 0; i < RT_STAGE_COUNT; ++i) {
        const bool needed = i == RT_STAGE_CAMERA || i == RT_STAGE_TRACE || i == RT_STAGE_SHADE ||
                            i == RT_STAGE_RESOLVE;
        assert_int_equal(times->launches[i], needed ? 1 : 0);
    }
    assert_int_equal(times->rays.shadow + times->rays.occlusion + times->rays.reflection +
                         times->rays.refraction,
                     0);
    rt_renderer_free(renderer);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

/* One pixel whose paths are known: two lights' shadows and seven probes at its one hit; nine mirror
 * rays of weights from 1/2 to 2^-9; as many refracted ones through twelve panes. */
static void rays_are_counted(void **state)
{
    (void)state;
#define PANE(z) "triangle a -99 -99 " z " b 99 -99 " z " c 0 99 " z " material m\n"
    static const struct {
        const char *text;
        size_t shadow, occlusion, reflection, refraction;
    } cases[] = {
        {"light directional direction 0 0 -1 shadow on\nlight point at 1 1 1 shadow on\n"
         "light point at 1 1 1 shadow off\nocclusion samples 7 distance 1\n"
         "material m kd 1 1 1\n" PANE("-1"),
         2, 7, 0, 0},
        {"depth 9\nmaterial m reflect 0.5\n" PANE("-1") PANE("1"), 0, 0, 9, 0},
        {"depth 9\nmaterial m transmit 0.5 ior 1\n" PANE("-1") PANE("-2") PANE("-3") PANE("-4")
             PANE("-5") PANE("-6") PANE("-7") PANE("-8") PANE("-9") PANE("-10") PANE("-11")
                 PANE("-12"),
         0, 0, 0, 9},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        rt_scene scene;
        rt_image image;
        rt_status status = RT_STATUS_INIT;
        test_scene(&scene, cases[i].text);
        scene.width = scene.height = 1;
        assert_good(rt_image_init(&image, 1, 1, false, &status), &status);
        rt_renderer *renderer = test_renderer(&scene, &(rt_render_options){0});
        assert_good(rt_renderer_draw(renderer, &image, NULL, &status), &status);
        const rt_render_times *times = rt_renderer_times(renderer);
        assert_int_equal(times->rays.shadow, cases[i].shadow);
        assert_int_equal(times->rays.occlusion, cases[i].occlusion);
        assert_int_equal(times->rays.reflection, cases[i].reflection);
        assert_int_equal(times->rays.refraction, cases[i].refraction);
        rt_renderer_free(renderer);
        rt_image_clear(&image);
        rt_scene_clear(&scene);
    }
#undef PANE
}

/* The scalar path takes the same rays, one path after another. */
static void assert_as_many_rays(const char *path)
{
    rt_scene scene;
    rt_image image;
    rt_ray_counts expected;
    rt_status status = RT_STATUS_INIT;
    test_scene_file(&scene, path);
    scene.width = 48;
    scene.height = 27;
    assert_good(rt_image_init(&image, scene.width, scene.height, false, &status), &status);
    rt_renderer *renderer = test_renderer(&scene, &(rt_render_options){0});
    assert_good(rt_renderer_draw(renderer, &image, NULL, &status), &status);
    const rt_ray_counts rays = rt_renderer_times(renderer)->rays;
    assert_good(rt_scalar_float_render_counted(&scene, &image, &expected, NULL, &status), &status);
    assert_int_equal(rays.primary, expected.primary);
    assert_int_equal(rays.shadow, expected.shadow);
    assert_int_equal(rays.occlusion, expected.occlusion);
    assert_int_equal(rays.reflection, expected.reflection);
    assert_int_equal(rays.refraction, expected.refraction);
    assert_int_equal(rays.ended, expected.ended);
    assert_int_equal(rays.cut, expected.cut);
    /* The device's is a sum of whole parts. */
    assert_true(fabs(rays.cut_light - expected.cut_light) <=
                (double)RT_CUT_UNIT * (double)expected.cut + 1e-6 * expected.cut_light);
    assert_true(rt_ray_counts_total(&rays) > rays.primary);
    rt_renderer_free(renderer);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

static void rays_are_as_many_as_the_scalar_paths(void **state)
{
    (void)state;
    assert_as_many_rays("scenes/gallery.txt");
    assert_as_many_rays("scenes/panes.txt");
    assert_as_many_rays("scenes/soft.txt");
}

static void assert_same_pictures(const rt_image *a, const rt_image *b)
{
    const size_t pixels = (size_t)a->width * (size_t)a->height;
    assert_memory_equal(a->rgb, b->rgb, 3 * pixels * sizeof *a->rgb);
    assert_memory_equal(a->hits, b->hits, pixels * sizeof *a->hits);
}

/* Draws the scene in two ways and compares every bit. */
static void compare(const rt_scene *scene, const rt_render_options *a, const rt_render_options *b)
{
    rt_image first, second;
    test_draw(scene, a, &first);
    test_draw(scene, b, &second);
    assert_same_pictures(&first, &second);
    rt_image_clear(&first);
    rt_image_clear(&second);
}

static void tiles_and_lanes_do_not_show(void **state)
{
    (void)state;
    rt_scene scene;
    test_scene(&scene, everything);
    static const rt_render_options ways[] = {
        {.tile = 16}, {.tile = 33}, {.lanes = 1}, {.lanes = 4}};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; ++i)
        compare(&scene, NULL, &ways[i]);
    rt_scene_clear(&scene);
}

static void compare_with_all(rt_scene *scene)
{
    rt_effects all = rt_effects_of(scene);
    all.mode = RT_EFFECTS_ALL;
    compare(scene, NULL, &(rt_render_options){.effects = &all});
}

/* What is compiled in and off leaves no trace in the picture. */
static void all_effects_compiled_in(void **state)
{
    (void)state;
    rt_scene scene;
    static const char *const texts[] = {everything, plain};
    for (size_t i = 0; i < 2; ++i) {
        test_scene(&scene, texts[i]);
        compare_with_all(&scene);
        rt_scene_clear(&scene);
    }
    glob_t files;
    assert_int_equal(glob("scenes/*.txt", 0, NULL, &files), 0);
    for (size_t i = 0; i < files.gl_pathc; i += test_is_long() ? 1 : 3) {
        test_scene_file(&scene, files.gl_pathv[i]);
        scene.width = 64;
        scene.height = 48;
        scene.samples = scene.samples > 2 ? 2 : scene.samples;
        compare_with_all(&scene);
        rt_scene_clear(&scene);
    }
    globfree(&files);
}

/* At depth 0 a mirror shows its own colour and no ray goes on. */
static void depth_0(void **state)
{
    (void)state;
    rt_scene scene;
    rt_image image;
    test_scene(&scene, "image width 8 height 8\nbackground 1 1 1\nambient 1 1 1\ndepth 0\n"
                       "camera vfov 1\nmaterial m ka 0.25 0.5 0 reflect 1\n"
                       "sphere center 0 0 -3 radius 1 material m\n");
    assert_false(rt_effects_of(&scene).on[RT_EFFECT_REFLECT]);
    test_draw(&scene, NULL, &image);
    for (int i = 0; i < 64; ++i) {
        assert_near(image.rgb[3 * i], 0.25, 0.0);
        assert_near(image.rgb[3 * i + 1], 0.5, 0.0);
    }
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

/* Between two mirrors that face each other every ray goes on until the depth is used up, and no
 * further: what is left is dropped, not made up. */
static void rays_end_at_the_depth(void **state)
{
    (void)state;
    rt_scene scene;
    rt_image image;
    rt_status status = RT_STATUS_INIT;
    test_scene(&scene, "image width 8 height 8\ncamera vfov 1\nambient 1 1 1\ndepth 7\n"
                       "material m ka 0.125 0.125 0.125 reflect 1\n"
                       "triangle a -9 -9 -2 b 9 -9 -2 c 0 9 -2 material m\n"
                       "triangle a -9 -9 2 b 9 -9 2 c 0 9 2 material m\n");
    assert_good(rt_image_init(&image, 8, 8, false, &status), &status);
    rt_renderer *renderer = test_renderer(&scene, &(rt_render_options){0});
    assert_good(rt_renderer_draw(renderer, &image, NULL, &status), &status);
    const rt_render_times *times = rt_renderer_times(renderer);
    assert_int_equal(times->rays.reflection, 7 * 64);
    assert_int_equal(times->rays.refraction, 0);
    assert_int_equal(times->launches[RT_STAGE_NEXT_TRACE], 7);
    for (int i = 0; i < 3 * 64; ++i)
        assert_near(image.rgb[i], 8 * 0.125, 0.0);
    rt_renderer_free(renderer);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

/* In an even surround what reflects and transmits everything cannot be seen: light is neither made
 * nor lost but by the cut-off, which drops less than a step. */
static void a_white_furnace(void **state)
{
    (void)state;
    static const char *const materials[] = {"reflect 1", "transmit 1", "reflect 0.3 transmit 0.7",
                                            "transmit 1 ior 0.7"};
    for (size_t i = 0; i < sizeof materials / sizeof *materials; ++i) {
        rt_scene scene;
        rt_image image;
        char text[300];
        snprintf(text, sizeof text,
                 "image width 48 height 48\nbackground 1 1 1\ndepth 64\nmaterial m %s\n"
                 "sphere center 0 0 -2 radius 1 material m\n",
                 materials[i]);
        test_scene(&scene, text);
        test_draw(&scene, NULL, &image);
        for (int k = 0; k < 3 * 48 * 48; ++k)
            assert_near(image.rgb[k], 1.0, 2.0 / 255.0);
        rt_image_clear(&image);
        rt_scene_clear(&scene);
    }
}

/* A wall that hides one side of all that a point sees leaves half of the ambient light. */
static void half_a_space_is_half_the_light(void **state)
{
    (void)state;
    rt_scene scene;
    rt_image image;
    test_scene(&scene,
               "image width 8 height 8\ncamera from 0.001 5 0 at 0.001 0 0 up 0 0 1 vfov 0.001\n"
               "ambient 1 1 1\nocclusion samples 1024 distance 1e6\n"
               "material floor ka 1 1 1\nmaterial wall\n"
               "triangle a -9 0 -9 b 9 0 -9 c 0 0 9 material floor\n"
               "triangle a 0 -1 -4e5 b 0 -1 4e5 c 0 4e5 0 material wall\n");
    test_draw(&scene, NULL, &image);
    for (int i = 0; i < 64; ++i)
        assert_near(image.rgb[3 * i], 0.5, 0.02);
    rt_image_clear(&image);
    rt_scene_clear(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_each_effect_adds),
        cmocka_unit_test(phong_alone_launches_four_kernels),
        cmocka_unit_test(rays_are_counted),
        cmocka_unit_test(rays_are_as_many_as_the_scalar_paths),
        cmocka_unit_test(tiles_and_lanes_do_not_show),
        cmocka_unit_test(all_effects_compiled_in),
        cmocka_unit_test(depth_0),
        cmocka_unit_test(rays_end_at_the_depth),
        cmocka_unit_test(a_white_furnace),
        cmocka_unit_test(half_a_space_is_half_the_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
