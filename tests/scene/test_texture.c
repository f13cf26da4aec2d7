/* Pictures that become textures: their texels, each loaded once, and what is refused. */
#include "support/support.h"

#include <stdio.h>
#include <stb_image_write.h>
#include <stdlib.h>
#include <string.h>

#include "scene/texture.h"

/* 3x2, row by row from the top: red, green, blue / white, grey, black. */
static const unsigned char pixels[18] = {255, 0,   0,   0,  255, 0,   0, 0, 255,
                                         255, 255, 255, 64, 128, 192, 0, 0, 0};

static void to_file(void *context, void *data, int size)
{
    assert_int_equal(fwrite(data, 1, (size_t)size, context), size);
}

static const char *write_png(const char *name, int width, int height, int components,
                             const void *data)
{
    const char *path = test_path(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(
        stbi_write_png_to_func(to_file, file, width, height, components, data, width * components));
    assert_int_equal(fclose(file), 0);
    return path;
}

static const char *write_bmp(const char *name)
{
    const char *path = test_path(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(stbi_write_bmp_to_func(to_file, file, 3, 2, 3, pixels));
    assert_int_equal(fclose(file), 0);
    return path;
}

static void assert_texels(const rt_scene *s)
{
    static const uint32_t expected[6] = {0x0000ff, 0x00ff00, 0xff0000, 0xffffff, 0xc08040, 0};
    assert_memory_equal(s->texels, expected, sizeof expected);
    assert_true(s->textures[0].first == 0 && s->textures[0].width == 3 &&
                s->textures[0].height == 2);
}

static void texels_go_from_the_top(void **state)
{
    (void)state;
    char reason[RT_TEXTURE_REASON_SIZE];
    int32_t index = -1;
    rt_scene s;
    rt_scene_init(&s);
    assert_true(rt_texture_load(&s, write_png("a.png", 3, 2, 3, pixels), &index, reason));
    assert_int_equal(index, 0);
    assert_int_equal(s.texel_count, 6);
    assert_texels(&s);
    rt_scene_clear(&s);
    rt_scene_init(&s);
    assert_true(rt_texture_load(&s, write_bmp("a.bmp"), &index, reason));
    assert_texels(&s);
    rt_scene_clear(&s);
}

/* Grey becomes three equal components, and transparency is passed over. */
static void other_numbers_of_components(void **state)
{
    (void)state;
    static const unsigned char grey[2] = {7, 200}, clear[8] = {1, 2, 3, 0, 4, 5, 6, 255};
    char reason[RT_TEXTURE_REASON_SIZE];
    int32_t index = -1;
    rt_scene s;
    rt_scene_init(&s);
    assert_true(rt_texture_load(&s, write_png("grey.png", 2, 1, 1, grey), &index, reason));
    assert_true(rt_texture_load(&s, write_png("clear.png", 1, 2, 4, clear), &index, reason));
    static const uint32_t expected[4] = {0x070707, 0xc8c8c8, 0x030201, 0x060504};
    assert_int_equal(index, 1);
    assert_int_equal(s.texel_count, 4);
    assert_memory_equal(s.texels, expected, sizeof expected);
    assert_int_equal(s.textures[1].first, 2);
    rt_scene_clear(&s);
}

static void a_file_is_loaded_once(void **state)
{
    (void)state;
    write_png("a.png", 3, 2, 3, pixels);
    write_png("b.png", 3, 2, 3, pixels);
    rt_scene s;
    test_scene(&s, "material a texture \"a.png\"\nmaterial b texture \"./a.png\" filter nearest\n"
                   "material c texture \"b.png\" filter bilinear\nmaterial d\n");
    assert_int_equal(s.texture_count, 2);
    assert_int_equal(s.texel_count, 12);
    static const int textures[4] = {0, 0, 1, -1}, nearest[4] = {0, 1, 0, 0};
    for (int i = 0; i < 4; ++i) {
        assert_int_equal(s.materials[i].texture, textures[i]);
        assert_int_equal(s.materials[i].nearest, nearest[i]);
    }
    assert_int_equal(s.textures[1].first, 6);
    rt_scene_clear(&s);
}

static void assert_refused(const char *path, const char *why)
{
    char reason[RT_TEXTURE_REASON_SIZE];
    int32_t index = 77;
    rt_scene s;
    rt_scene_init(&s);
    assert_false(rt_texture_load(&s, path, &index, reason));
    if (!strstr(reason, why))
        fail_msg("'%s' is not in '%s'", why, reason);
    assert_int_equal(index, 77);
    assert_int_equal(s.texture_count + s.texel_count, 0);
    rt_scene_clear(&s);
}

static void what_is_refused(void **state)
{
    (void)state;
    assert_refused(test_path("nowhere.png"), "No such file or directory");
    assert_refused(test_folder(), "Is a directory");
    test_write_text(test_path("text.png"), "rt 1\n");
    assert_refused(test_path("text.png"), "no picture in png, jpg or bmp");
    test_write_text(test_path("empty.png"), "");
    assert_refused(test_path("empty.png"), "no picture in png, jpg or bmp");
    /* Cut off in the middle, with a good header. */
    size_t length = 0;
    char *bytes = test_read_file(write_png("cut.png", 3, 2, 3, pixels), &length);
    test_write_file(test_path("cut.png"), bytes, length / 2);
    assert_refused(test_path("cut.png"), "no picture in png, jpg or bmp");
    free(bytes);
    /* A header that claims 2^30 pixels is believed and refused before they are decoded. */
    bytes = test_read_file(write_png("huge.png", 3, 2, 1, pixels), &length);
    memcpy(bytes + 16, "\0\0\x80\0\0\0\x80\0", 8);
    test_write_file(test_path("huge.png"), bytes, length);
    assert_refused(test_path("huge.png"),
                   "32768x32768; all textures together have 268435456 pixels at most");
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texels_go_from_the_top),
        cmocka_unit_test(other_numbers_of_components),
        cmocka_unit_test(a_file_is_loaded_once),
        cmocka_unit_test(what_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
