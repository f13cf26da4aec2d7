/* Every estimator converges to the truth: the rows of README.md's table, and wrong samplers that
 * they notice. What N is, a row's scene says: rays a pixel, or shadow and occlusion rays under a
 * single one. */
#include "support/mutants.h"
#include "truth/truth.h"
#include "truth/worlds.h"

#define IMAGE "image width 32 height 32 "
#define PIXEL IMAGE "samples N\n"
#define TENT IMAGE "samples N filter tent\n"
#define ONE_RAY IMAGE "\n"
/* As much as stairs have steps. */
#define STAIRS "ambient 24 24 24\n"
#define WHITE "ambient 1 1 1\nmaterial white ka 1 1 1\n"
#define LIT "material white kd 1 1 1\n"
#define OPEN "occlusion samples N distance 26\n"
#define SKY(depth) "background 0.5 0.5 0.5\ndepth " #depth "\n"
#define GLASS SKY(1000) "material glass transmit 1 ior 1.5\n"
/* A disk of half the aperture on the floor. */
#define BLUR(aperture) "aperture " #aperture " focus 50"

#define PICTURES(...)                                                                              \
    .angles = {__VA_ARGS__}, .pictures = sizeof((double[]){__VA_ARGS__}) / sizeof(double)

static const truth_row effects[] = {
    {.name = "pixel: edges, box filter",
     .text = PIXEL STAIRS,
     .add = truth_add_stairs,
     .mean = truth_stairs_mean,
     PICTURES(17, 0, 45, 90, 135),
     .in_short = true},
    {.name = "pixel: edges, tent filter",
     .text = TENT STAIRS,
     .add = truth_add_stairs,
     .mean = truth_stairs_mean,
     PICTURES(17, 45, 135)},
    {.name = "lens: edges",
     .text = PIXEL STAIRS,
     .eye = BLUR(12),
     .add = truth_add_stairs,
     .mean = truth_stairs_mean,
     PICTURES(17, 0, 135)},
    {.name = "lens: a small ball",
     .text = PIXEL WHITE TRUTH_POINT,
     .eye = BLUR(16),
     .light = truth_point},
    {.name = "light: umbra and penumbra",
     .text = ONE_RAY LIT,
     .lamp = "radius 5 samples N",
     .add = truth_add_lit_floor,
     .light = truth_lit_floor,
     PICTURES(25, 0, 90),
     .in_short = true},
    {.name = "occlusion: a wall",
     .text = ONE_RAY WHITE OPEN,
     .add = truth_add_wall,
     .light = truth_wall,
     PICTURES(33, 0, 90)},
    {.name = "occlusion: a corner",
     .text = ONE_RAY WHITE OPEN,
     .add = truth_add_corner,
     .light = truth_corner,
     PICTURES(45, 200)},
    {.name = "occlusion: a ball on the floor",
     .text = ONE_RAY WHITE OPEN,
     .add = truth_add_ball_on_floor,
     .light = truth_ball_on_floor},
    {.name = "texture, magnified",
     .text = PIXEL WHITE,
     .add = truth_add_large_texels,
     .light = truth_large_texels},
    {.name = "texture, minified",
     .text = PIXEL WHITE,
     .add = truth_add_small_texels,
     .light = truth_small_texels},
    {.name = "glass: 30 panes before a floor",
     .text = PIXEL WHITE "depth 1000\nmaterial glass transmit 1 ior 1.5\n",
     .add = truth_add_panes_on_white,
     .light = truth_panes_on_white,
     .most = 16},
    {.name = "glass: a ball under a gradient",
     .text = PIXEL "background 0 0 0 top 1 1 1\nmaterial glass transmit 1 ior 1.5\n" TRUTH_BALL,
     .light = truth_ball_in_sky},
    {.name = "fog",
     .text = PIXEL WHITE "fog 0.2 0.2 0.2 density 0.01\n",
     .add = truth_add_floor,
     .light = truth_foggy_floor},
    {.name = "absorption: a ball", .text = PIXEL TRUTH_ABSORBING, .light = truth_absorbing},
    {.name = "absorption: a ball with a bubble",
     .text = PIXEL TRUTH_ABSORBING TRUTH_BUBBLE,
     .light = truth_bubble},
    {.name = "absorption: the eye in glass", .text = PIXEL TRUTH_IN_GLASS, .light = truth_in_glass},
};

static const truth_row pixel_and_lens = {.name = "pixel x lens: edges",
                                         .text = PIXEL STAIRS,
                                         .eye = BLUR(2),
                                         .add = truth_add_stairs,
                                         .mean = truth_stairs_mean,
                                         PICTURES(17, 0, 135)};

static const truth_row pairs[] = {
    {.name = "pixel x light: edges in a penumbra",
     .text = PIXEL,
     .lamp = "color 24 24 24 radius 5 samples 1",
     .add = truth_add_lit_stairs,
     .light = truth_lit_stairs,
     PICTURES(25, 60)},
    {.name = "lens x light: a penumbra out of focus",
     .text = PIXEL LIT,
     .eye = BLUR(12),
     .lamp = "radius 2 samples 1",
     .add = truth_add_lit_floor,
     .light = truth_lit_floor,
     PICTURES(25, 60)},
    {.name = "light x occlusion: a penumbra at a wall",
     .text = ONE_RAY OPEN "ambient 1 1 1\nmaterial white ka 1 1 1 kd 1 1 1\n",
     .lamp = "radius 5 samples N",
     .add = truth_add_lit_wall,
     .light = truth_lit_wall,
     PICTURES(25, 60)},
    {.name = "mirror x pixel: edges",
     .text = PIXEL STAIRS,
     .mirror = 0.75,
     .add = truth_add_stairs,
     .mean = truth_stairs_mean,
     PICTURES(17, 0, 135)},
    {.name = "mirror x lens: edges",
     .text = PIXEL STAIRS,
     .eye = BLUR(12),
     .mirror = 0.75,
     .add = truth_add_stairs,
     .mean = truth_stairs_mean,
     PICTURES(17, 0)},
    {.name = "mirror x light: umbra and penumbra",
     .text = ONE_RAY LIT,
     .lamp = "radius 5 samples N",
     .mirror = 0.75,
     .add = truth_add_lit_floor,
     .light = truth_lit_floor,
     PICTURES(25, 60)},
    {.name = "mirror x occlusion: a wall",
     .text = ONE_RAY WHITE OPEN,
     .mirror = 0.75,
     .add = truth_add_wall,
     .light = truth_wall,
     PICTURES(33, 90)},
};

/* Under a sky of 0.5 all around, what neither absorbs nor shines cannot be seen. */
#define FURNACE .light = truth_furnace, .lawful = 0.001, .steps = 2

static const truth_row furnaces[] = {
    {.name = "furnace: a ball of glass", .text = PIXEL GLASS TRUTH_BALL, FURNACE},
    {.name = "furnace: a ball, glass and mirror",
     .text = PIXEL SKY(1000) "material both transmit 0.7 reflect 0.3 ior 1.5\n"
                             "sphere center 0 0 0 radius 14 material both\n",
     FURNACE},
    {.name = "furnace: a cube of glass", .text = PIXEL GLASS, .add = truth_add_cube, FURNACE},
    {.name = "furnace: 16 shells of glass",
     .text = PIXEL GLASS,
     .add = truth_add_shells,
     .most = 256,
     FURNACE},
    {.name = "furnace: 30 panes", .text = PIXEL GLASS, .add = truth_add_panes, .most = 16, FURNACE},
    {.name = "furnace: 400 panes of ior 1.09",
     .text = PIXEL SKY(65536) "material glass transmit 1 ior 1.09\n",
     .add = truth_add_thin_panes,
     .most = 2,
     FURNACE},
};

/* In the short form on the reference alone: the device has it bit for bit (tests/kernels/), and
 * compiling for each row takes long. */
static bool holds(const truth_row *row)
{
    truth_figures device, reference;
    truth_measure(row, truth_draw_reference, &reference);
    bool good = truth_holds(row, &reference);
    if (truth_is_long()) {
        truth_measure(row, truth_draw_device, &device);
        good = truth_holds(row, &device) && good;
    }
    truth_tell(row, truth_is_long() ? &device : NULL, &reference);
    return good;
}

static void hold(const truth_row *rows, size_t count)
{
    int broken = 0;
    for (size_t i = 0; i < count; ++i)
        if (truth_is_wanted(&rows[i]))
            broken += !holds(&rows[i]);
    if (broken > 0)
        fail_msg("%d estimators do not hold", broken);
}

#define HOLD(rows) hold(rows, sizeof(rows) / sizeof *(rows))

static void effects_alone(void **state)
{
    (void)state;
    HOLD(effects);
}

static void pairs_of_effects(void **state)
{
    (void)state;
    hold(&pixel_and_lens, 1);
    HOLD(pairs);
}

static void mirrors_and_glass(void **state)
{
    (void)state;
    HOLD(furnaces);
}

/* On the device, which is right first. A few counts do, and no tree, which compiles faster. */
static void wrong_samplers_are_noticed(void **state)
{
    (void)state;
    static const test_mutant mutants[] = {MUTANT_NONE, MUTANT_LENS_WITH_PIXEL,
                                          MUTANT_LAST_CELLS_LEFT_OUT, MUTANT_WEIGHT_OF_ONE_MORE};
    if (truth_is_long())
        skip();
    for (size_t i = 0; i < sizeof mutants / sizeof *mutants; ++i) {
        truth_figures figures;
        if (mutants[i])
            test_mutate_kernels(mutants[i]);
        test_use_tree(false);
        truth_measure(&pixel_and_lens, truth_draw_device, &figures);
        test_use_tree(true);
        test_restore_kernels();
        if (truth_holds(&pixel_and_lens, &figures) != (mutants[i] == MUTANT_NONE))
            fail_msg("%s: bias %.1f at %d, of all %.1f, slope %.2f",
                     mutants[i] ? test_mutations[mutants[i]].name : "as built", figures.bias,
                     figures.bias_count, figures.all, figures.slope);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(effects_alone), cmocka_unit_test(pairs_of_effects),
        cmocka_unit_test(mirrors_and_glass), cmocka_unit_test(wrong_samplers_are_noticed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
