/* Files in every format that stb_image knows, read back by another library than wrote them. */
#include "support/support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/formats.h"

/* A reader of its own, for all formats: the program's knows those of textures. */
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_FAILURE_USERMSG
/* Told of at the end of the file, so it stays. */
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include <stb_image.h>
#pragma GCC diagnostic pop

/* A 5x3 picture with a different value everywhere, all exact 8-bit steps. */
static void make(rt_image *image, bool with_hits)
{
    rt_status status = RT_STATUS_INIT;
    assert_good(rt_image_init(image, 5, 3, with_hits, &status), &status);
    for (int i = 0; i < 45; ++i)
        image->rgb[i] = (float)(5 * i + 3) / 255.0f;
    for (int i = 0; with_hits && i < 15; ++i)
        image->hits[i] = (rt_hit){i - 1, (float)i, 0.5f, 0.25f};
}

static void formats_by_extension(void **state)
{
    (void)state;
    static const char *const paths[][2] = {
        {"a.png", "png"}, {"a.b/c.PNG", "png"}, {"a.jpeg", "jpg"}, {"a.JPG", "jpg"},
        {"x.tga", "tga"}, {"x.bmp", "bmp"},     {"x.hdr", "hdr"},  {"-", "png"},
        {"x.exr", "exr"}, {"x.png16", NULL},    {"png", NULL},     {"a.png/b", NULL},
        {"a.gif", NULL},  {"a.", NULL}};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; ++i) {
        const rt_image_format *format = rt_image_format_of(paths[i][0]);
        if (paths[i][1])
            assert_string_equal(format->name, paths[i][1]);
        else
            assert_null(format);
    }
    char list[64], cut[8];
    rt_image_formats_list(".", list, sizeof list);
    assert_string_equal(list, ".png, .bmp, .tga, .jpg, .hdr or .exr");
    rt_image_formats_list("", cut, sizeof cut);
    assert_string_equal(cut, "png, bm");
    rt_image_formats_list_names(list, sizeof list);
    assert_string_equal(list, "png, bmp, tga, jpg, hdr, exr or png16");
    assert_string_equal(rt_image_format_named("PNG16")->name, "png16");
    assert_null(rt_image_format_named("jpeg"));
}

static const rt_encoding linear = {RT_TRANSFER_LINEAR, 0.0f}, srgb = {RT_TRANSFER_SRGB, 0.0f};

static const char *write_by(const rt_image *image, const char *name, const rt_image_format *format,
                            const rt_encoding *encoding)
{
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    const char *path = test_path(name);
    assert_good(rt_output_open(&output, path, &status), &status);
    assert_good(rt_image_write(image, format, encoding, &output, &status), &status);
    assert_good(rt_output_commit(&output, &status), &status);
    return path;
}

static const char *write_as(const rt_image *image, const char *name)
{
    return write_by(image, name, rt_image_format_of(name), &linear);
}

static void files_hold_the_picture(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int tolerance;
    } files[] = {{"a.png", 0}, {"a.bmp", 0}, {"a.tga", 0}, {"a.jpg", 12}};
    rt_image image;
    make(&image, false);
    for (size_t f = 0; f < sizeof files / sizeof *files; ++f) {
        int width = 0, height = 0, components = 0;
        unsigned char *pixels =
            stbi_load(write_as(&image, files[f].name), &width, &height, &components, 3);
        if (!pixels)
            fail_msg("%s: %s", files[f].name, stbi_failure_reason());
        assert_int_equal(width, 5);
        assert_int_equal(height, 3);
        for (int i = 0; i < 45; ++i)
            assert_near(pixels[i], 5 * i + 3, files[f].tolerance);
        stbi_image_free(pixels);
    }
    rt_image_clear(&image);
}

/* Sizes around the blocks that are quantised at a time, with values of every kind. */
static void png_is_lossless_at_every_size(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 64}, {21, 1}, {22, 1}, {64, 3}, {257, 131}};
    static const float odd[] = {NAN, INFINITY, -INFINITY, -0.0f, -1.0f, 1.5f, 1e30f, 1e-30f};
    test_random random = {7};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; ++s) {
        rt_image image;
        rt_status status = RT_STATUS_INIT;
        int width = 0, height = 0, components = 0;
        assert_good(rt_image_init(&image, sizes[s][0], sizes[s][1], false, &status), &status);
        const int count = 3 * image.width * image.height;
        for (int i = 0; i < count; ++i)
            image.rgb[i] = i % 5 == 4 ? odd[test_random_bits(&random) % 8]
                                      : test_random_float(&random, -0.1f, 1.1f);
        unsigned char *pixels =
            stbi_load(write_as(&image, "b.png"), &width, &height, &components, 3);
        assert_non_null(pixels);
        assert_true(width == image.width && height == image.height && components == 3);
        for (int i = 0; i < count; ++i)
            assert_int_equal(pixels[i], rt_image_step(image.rgb[i]));
        stbi_image_free(pixels);
        rt_image_clear(&image);
    }
}

/* 16 bits, both bytes of which count. */
static void png16_is_lossless_at_every_size(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {1, 64}, {21, 1}, {64, 3}, {257, 131}};
    test_random random = {8};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; ++s) {
        rt_image image;
        rt_status status = RT_STATUS_INIT;
        int width = 0, height = 0, components = 0;
        assert_good(rt_image_init(&image, sizes[s][0], sizes[s][1], false, &status), &status);
        const int count = 3 * image.width * image.height;
        for (int i = 0; i < count; ++i)
            image.rgb[i] = test_random_float(&random, 0.0f, 1.0f);
        const char *path = write_by(&image, "c.png", rt_image_format_named("png16"), &linear);
        assert_true(stbi_is_16_bit(path));
        unsigned short *pixels = stbi_load_16(path, &width, &height, &components, 3);
        assert_non_null(pixels);
        assert_true(width == image.width && height == image.height && components == 3);
        for (int i = 0; i < count; ++i)
            assert_int_equal(pixels[i], (int)floor(65535.0 * (double)image.rgb[i] + 0.5));
        stbi_image_free(pixels);
        rt_image_clear(&image);
    }
}

/* The steps of sRGB reach the file, in all formats of integers. */
static void integers_are_encoded(void **state)
{
    (void)state;
    static const char *const names[] = {"d.png", "d.bmp", "d.tga", "d.jpg"};
    rt_image image;
    rt_status status = RT_STATUS_INIT;
    int width = 0, height = 0, components = 0;
    assert_good(rt_image_init(&image, 16, 16, false, &status), &status);
    for (int i = 0; i < 3 * 256; ++i)
        image.rgb[i] = 0.18f;
    for (size_t f = 0; f < 4; ++f) {
        const char *path = write_by(&image, names[f], rt_image_format_of(names[f]), &srgb);
        unsigned char *pixels = stbi_load(path, &width, &height, &components, 3);
        assert_non_null(pixels);
        for (int i = 0; i < 3 * 256; ++i)
            assert_near(pixels[i], 118, f == 3);
        stbi_image_free(pixels);
    }
    const char *path = write_by(&image, "d.png", rt_image_format_named("png16"), &srgb);
    unsigned short *pixels = stbi_load_16(path, &width, &height, &components, 3);
    assert_non_null(pixels);
    assert_int_equal(pixels[0], 30235);
    stbi_image_free(pixels);
    rt_image_clear(&image);
}

/* The bytes from IHDR's bit depth to the picture, and the last: checksums as everywhere. */
static void png_says_what_its_integers_are(void **state)
{
    (void)state;
    static const unsigned char of_linear[] = {0, 0, 0,    4,    'g',  'A',  'M',  'A',
                                              0, 1, 0x86, 0xa0, 0x31, 0xe8, 0x96, 0x5f};
    static const unsigned char of_srgb[] = {
        0, 0, 0,   1,   's', 'R', 'G', 'B', 0,    0xae, 0xce, 0x1c, 0xe9, 0,   0,
        0, 4, 'g', 'A', 'M', 'A', 0,   0,   0xb1, 0x8f, 0x0b, 0xfc, 0x61, 0x05};
    static const unsigned char of_end[] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    static const struct {
        const char *format;
        const rt_encoding *encoding;
        const unsigned char *chunks;
        size_t length;
        int bits;
    } files[] = {{"png", &linear, of_linear, sizeof of_linear, 8},
                 {"png", &srgb, of_srgb, sizeof of_srgb, 8},
                 {"png16", &linear, of_linear, sizeof of_linear, 16},
                 {"png16", &srgb, of_srgb, sizeof of_srgb, 16}};
    rt_image image;
    make(&image, false);
    for (size_t f = 0; f < sizeof files / sizeof *files; ++f) {
        size_t length = 0;
        char *bytes = test_read_file(
            write_by(&image, "e.png", rt_image_format_named(files[f].format), files[f].encoding),
            &length);
        assert_int_equal(bytes[24], files[f].bits);
        assert_int_equal(bytes[25], 2); /* red, green, blue */
        assert_memory_equal(bytes + 33, files[f].chunks, files[f].length);
        assert_memory_equal(bytes + 33 + files[f].length + 4, "IDAT", 4);
        assert_memory_equal(bytes + length - sizeof of_end, of_end, sizeof of_end);
        free(bytes);
    }
    rt_image_clear(&image);
}

static void hdr_keeps_what_is_above_one(void **state)
{
    (void)state;
    rt_image image;
    make(&image, false);
    image.rgb[0] = 7.5f;
    int width = 0, height = 0, components = 0;
    float *pixels = stbi_loadf(write_as(&image, "a.hdr"), &width, &height, &components, 3);
    assert_non_null(pixels);
    assert_int_equal(width * height, 15);
    /* RGBE: 8 bits of mantissa below the largest component. */
    for (int i = 0; i < 45; ++i)
        assert_near(pixels[i], image.rgb[i], i < 3 ? 8.0 / 256 : 2.0 / 256);
    stbi_image_free(pixels);
    rt_image_clear(&image);
}

static void hit_records_are_little_endian(void **state)
{
    (void)state;
    rt_image image;
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    make(&image, true);
    const char *path = test_path("a.hits");
    assert_good(rt_output_open(&output, path, &status), &status);
    assert_good(rt_image_write_hits(&image, &output, &status), &status);
    assert_good(rt_output_commit(&output, &status), &status);
    size_t length = 0;
    char *bytes = test_read_file(path, &length);
    assert_int_equal(length, 15 * 16);
    /* Pixel 2,0: primitive 1, t 2, u 0.5, v 0.25. */
    const unsigned char expected[16] = {1, 0, 0, 0, 0, 0, 0, 0x40, 0, 0, 0, 0x3f, 0, 0, 0x80, 0x3e};
    assert_memory_equal(bytes + 32, expected, 16);
    const unsigned char miss[4] = {0xff, 0xff, 0xff, 0xff};
    assert_memory_equal(bytes, miss, 4);
    free(bytes);
    rt_image_clear(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formats_by_extension),
        cmocka_unit_test(files_hold_the_picture),
        cmocka_unit_test(png_is_lossless_at_every_size),
        cmocka_unit_test(png16_is_lossless_at_every_size),
        cmocka_unit_test(integers_are_encoded),
        cmocka_unit_test(png_says_what_its_integers_are),
        cmocka_unit_test(hdr_keeps_what_is_above_one),
        cmocka_unit_test(hit_records_are_little_endian),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
