/* OpenEXR files, read by hand from what the format's description says: another code than wrote
 * them. */
#include "support/support.h"

#include <libdeflate.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/formats.h"

#define ROWS_A_CHUNK 16 /* of ZIP */

static uint32_t word_at(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
           (uint32_t)bytes[3] << 24;
}

static uint8_t *write_exr(const rt_image *image, const rt_encoding *encoding, size_t *length)
{
    rt_status status = RT_STATUS_INIT;
    rt_output output;
    const char *path = test_path("a.exr");
    assert_good(rt_output_open(&output, path, &status), &status);
    assert_good(rt_image_write(image, rt_image_format_of(path), encoding, &output, &status),
                &status);
    assert_good(rt_output_commit(&output, &status), &status);
    uint8_t *bytes = (uint8_t *)test_read_file(path, length);
    assert_non_null(bytes);
    return bytes;
}

/* The value of an attribute, or NULL; *end is behind the header. */
static const uint8_t *find(const uint8_t *file, const char *name, const uint8_t **end)
{
    const uint8_t *at = file + 8, *value = NULL;
    while (*at) {
        const char *attribute = (const char *)at, *type = attribute + strlen(attribute) + 1;
        const uint8_t *size = (const uint8_t *)type + strlen(type) + 1;
        if (strcmp(attribute, name) == 0)
            value = size + 4;
        at = size + 4 + word_at(size);
    }
    *end = at + 1;
    return value;
}

/* ZIP: the differences of neighbours from 128, of the even bytes first, then of the odd ones. */
static void unpack(const uint8_t *chunk, size_t size, uint8_t *out, size_t length)
{
    if (size == length) {
        memcpy(out, chunk, length);
        return;
    }
    uint8_t *bytes = malloc(length);
    struct libdeflate_decompressor *decompressor = libdeflate_alloc_decompressor();
    assert_true(bytes && decompressor);
    assert_int_equal(libdeflate_zlib_decompress(decompressor, chunk, size, bytes, length, NULL),
                     LIBDEFLATE_SUCCESS);
    libdeflate_free_decompressor(decompressor);
    for (size_t i = 1; i < length; ++i)
        bytes[i] = (uint8_t)(bytes[i - 1] + bytes[i] - 128);
    for (size_t i = 0; i < length; ++i)
        out[i] = bytes[i / 2 + (i % 2) * ((length + 1) / 2)];
    free(bytes);
}

/* Every number is the picture's to the bit. */
static void assert_holds(const uint8_t *file, size_t length, const rt_image *image)
{
    const uint8_t *table = NULL;
    (void)find(file, "", &table);
    const int chunks = (image->height + ROWS_A_CHUNK - 1) / ROWS_A_CHUNK;
    const size_t row = (size_t)image->width * 3 * sizeof(float);
    uint8_t *rows = malloc(row * ROWS_A_CHUNK);
    assert_non_null(rows);
    for (int k = 0; k < chunks; ++k) {
        const size_t at = word_at(table + 8 * k);
        const int y0 = k * ROWS_A_CHUNK, left = image->height - y0;
        const size_t count = (size_t)(left < ROWS_A_CHUNK ? left : ROWS_A_CHUNK);
        assert_true(at + 8 <= length && at + 8 + word_at(file + at + 4) <= length);
        assert_int_equal(word_at(file + at), y0);
        unpack(file + at + 8, word_at(file + at + 4), rows, count * row);
        for (size_t y = 0; y < count; ++y)
            for (size_t c = 0; c < 3; ++c) /* B, G, R */
                for (size_t x = 0; x < (size_t)image->width; ++x) {
                    const size_t place = y * row + (c * (size_t)image->width + x) * sizeof(float);
                    const size_t pixel = ((size_t)y0 + y) * (size_t)image->width + x;
                    uint32_t expected;
                    memcpy(&expected, &image->rgb[3 * pixel + 2 - c], sizeof expected);
                    assert_int_equal(word_at(rows + place), expected);
                }
    }
    free(rows);
}

static void fill(rt_image *image, int width, int height)
{
    static const float odd[] = {NAN, INFINITY, -INFINITY, -0.0f, -1.0f, 1e30f, 1e-30f, 7.5f};
    rt_status status = RT_STATUS_INIT;
    test_random random = {11};
    assert_good(rt_image_init(image, width, height, false, &status), &status);
    for (int i = 0; i < 3 * width * height; ++i)
        image->rgb[i] = i % 9 == 4 ? odd[test_random_bits(&random) % 8]
                        : i % 2    ? 0.25f
                                   : test_random_float(&random, -0.1f, 2.0f);
}

static void files_hold_every_bit(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {5, 3}, {3, 16}, {2, 17}, {64, 48}, {257, 131}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; ++s) {
        rt_image image;
        size_t length = 0;
        fill(&image, sizes[s][0], sizes[s][1]);
        uint8_t *file = write_exr(&image, &(rt_encoding){RT_TRANSFER_LINEAR, 0.0f}, &length);
        assert_holds(file, length, &image);
        free(file);
        rt_image_clear(&image);
    }
}

static void the_head_says_what_it_is(void **state)
{
    (void)state;
    rt_image image;
    size_t length = 0;
    const uint8_t *end = NULL;
    fill(&image, 40, 30);
    uint8_t *file = write_exr(&image, &(rt_encoding){RT_TRANSFER_LINEAR, 0.0f}, &length);
    assert_int_equal(word_at(file), 20000630);
    assert_int_equal(word_at(file + 4), 2); /* the version, of scan lines */
    assert_int_equal(find(file, "compression", &end)[0], 3);
    const uint8_t *window = find(file, "dataWindow", &end);
    assert_true(word_at(window) == 0 && word_at(window + 4) == 0);
    assert_int_equal(word_at(window + 8), 39);
    assert_int_equal(word_at(window + 12), 29);
    const uint8_t *channels = find(file, "channels", &end);
    for (int c = 0; c < 3; ++c) {
        const uint8_t *channel = channels + 18 * c;
        assert_int_equal(channel[0], "BGR"[c]);
        assert_int_equal(word_at(channel + 2), 2); /* float */
    }
    assert_null(find(file, "capDate", &end));
    free(file);
    rt_image_clear(&image);
}

/* Whatever integers are to be like, floats are as they are, and the bytes the same each time. */
static void floats_have_no_encoding(void **state)
{
    (void)state;
    rt_image image;
    size_t length = 0, other_length = 0;
    fill(&image, 40, 30);
    uint8_t *file = write_exr(&image, &(rt_encoding){RT_TRANSFER_LINEAR, 0.0f}, &length);
    uint8_t *other = write_exr(&image, &(rt_encoding){RT_TRANSFER_SRGB, 3.0f}, &other_length);
    assert_int_equal(length, other_length);
    assert_memory_equal(file, other, length);
    free(file);
    free(other);
    rt_image_clear(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_hold_every_bit),
        cmocka_unit_test(the_head_says_what_it_is),
        cmocka_unit_test(floats_have_no_encoding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
