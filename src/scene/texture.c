#define _GNU_SOURCE
#include "scene/texture.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/array.h"
#include "common/file.h"
#include "image/stb_read.h"

#define NO_MEMORY "out of memory"

static bool fail(char reason[RT_TEXTURE_REASON_SIZE], const char *text)
{
    snprintf(reason, RT_TEXTURE_REASON_SIZE, "%s", text);
    return false;
}

/* Why stb_image refuses a picture, in the middle of a sentence. */
static bool fail_picture(char reason[RT_TEXTURE_REASON_SIZE])
{
    snprintf(reason, RT_TEXTURE_REASON_SIZE, "no picture in png, jpg or bmp (%s)",
             stbi_failure_reason());
    return false;
}

/* Makes room for a texture of so many texels: two arrays of textures grow in step. */
static bool reserve(rt_scene *scene, size_t texels)
{
    size_t capacity = scene->texture_capacity;
    bool grown = RT_ARRAY_GROW(scene->textures, scene->texture_count, &capacity);
    capacity = scene->texture_capacity;
    grown = grown && RT_ARRAY_GROW(scene->texture_files, scene->texture_count, &capacity);
    if (grown)
        scene->texture_capacity = capacity;
    return grown && rt_array_reserve(&scene->texels, scene->texel_count + texels,
                                     &scene->texel_capacity, sizeof *scene->texels);
}

/* Decodes a file's bytes to texels at the end of the scene's. */
static bool decode(rt_scene *scene, const rt_file_text *bytes, rt_texture *texture,
                   char reason[RT_TEXTURE_REASON_SIZE])
{
    const stbi_uc *data = (const stbi_uc *)bytes->bytes;
    int width = 0, height = 0, components = 0;
    if (bytes->length > INT_MAX)
        return fail(reason, "the file is larger than 2 GiB");
    if (!stbi_info_from_memory(data, (int)bytes->length, &width, &height, &components))
        return fail_picture(reason);
    /* Asked before the picture is decoded: its header may claim any size. */
    if ((int64_t)width * height > RT_TEXELS_MAX - (int64_t)scene->texel_count) {
        snprintf(reason, RT_TEXTURE_REASON_SIZE,
                 "%dx%d; all textures together have %lld pixels at most", width, height,
                 (long long)RT_TEXELS_MAX);
        return false;
    }
    stbi_uc *pixels =
        stbi_load_from_memory(data, (int)bytes->length, &width, &height, &components, 3);
    if (!pixels)
        return fail_picture(reason);
    const size_t count = (size_t)width * (size_t)height;
    const bool good = reserve(scene, count);
    for (size_t i = 0; good && i < count; ++i)
        scene->texels[scene->texel_count + i] =
            pixels[3 * i] | (uint32_t)pixels[3 * i + 1] << 8 | (uint32_t)pixels[3 * i + 2] << 16;
    stbi_image_free(pixels);
    *texture = (rt_texture){.first = (int)scene->texel_count, .width = width, .height = height};
    return good || fail(reason, NO_MEMORY);
}

bool rt_texture_load(rt_scene *scene, const char *path, int32_t *index,
                     char reason[RT_TEXTURE_REASON_SIZE])
{
    char *file = realpath(path, NULL);
    if (!file)
        return fail(reason, strerror(errno));
    for (size_t i = 0; i < scene->texture_count; ++i)
        if (strcmp(scene->texture_files[i], file) == 0) {
            free(file);
            *index = (int32_t)i;
            return true;
        }
    rt_file_text bytes;
    rt_texture texture;
    const char *unreadable = rt_file_read(file, &bytes);
    const bool good =
        unreadable ? fail(reason, unreadable) : decode(scene, &bytes, &texture, reason);
    rt_file_free(&bytes);
    if (!good) {
        free(file);
        return false;
    }
    *index = (int32_t)scene->texture_count;
    scene->texel_count += (size_t)texture.width * (size_t)texture.height;
    scene->texture_files[scene->texture_count] = file;
    scene->textures[scene->texture_count++] = texture;
    return true;
}
