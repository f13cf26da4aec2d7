#include "image/exr.h"

#include <limits.h>
#include <openexr.h>
#include <stdlib.h>
#include <string.h>

#include "common/array.h"

/* The library's own default, written out so that it stays. */
#define ZIP_LEVEL 4
#define COMPONENTS 3

/* The file in memory, since the library comes back to fill in where its chunks are. */
typedef struct memory {
    uint8_t *bytes; /* owned */
    size_t length, capacity;
} memory;

static int64_t put(exr_const_context_t context, void *user, const void *bytes, uint64_t size,
                   uint64_t offset, exr_stream_error_func_ptr_t error)
{
    memory *m = user;
    (void)context;
    (void)error;
    const size_t end = (size_t)(offset + size);
    if (!rt_array_reserve(&m->bytes, end, &m->capacity, 1))
        return -1;
    if (offset > m->length)
        memset(m->bytes + m->length, 0, (size_t)offset - m->length);
    memcpy(m->bytes + offset, bytes, size);
    m->length = end > m->length ? end : m->length;
    return (int64_t)size;
}

/* What fails is told of by the caller. */
static void say_nothing(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context;
    (void)code;
    (void)message;
}

static bool good(exr_result_t result)
{
    return result == EXR_ERR_SUCCESS;
}

static bool put_head(exr_context_t file, const rt_image_pixels *picture)
{
    static const char *const names[COMPONENTS] = {"B", "G", "R"};
    int part = 0;
    bool is_good = good(exr_add_part(file, NULL, EXR_STORAGE_SCANLINE, &part)) &&
                   good(exr_initialize_required_attr_simple(file, part, picture->width,
                                                            picture->height, EXR_COMPRESSION_ZIP));
    for (int i = 0; i < COMPONENTS && is_good; ++i)
        is_good = good(exr_add_channel(file, part, names[i], EXR_PIXEL_FLOAT,
                                       EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    return is_good && good(exr_write_header(file));
}

/* Where each channel has its numbers from row y on. */
static void point_at(exr_encode_pipeline_t *pipeline, const rt_image_pixels *picture, int y)
{
    const float *row =
        (const float *)picture->pixels + COMPONENTS * (size_t)picture->width * (size_t)y;
    for (int i = 0; i < pipeline->channel_count; ++i) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        const char *names = "RGB";
        channel->encode_from_ptr =
            (const uint8_t *)(row + (strchr(names, channel->channel_name[0]) - names));
        channel->user_pixel_stride = COMPONENTS * (int)sizeof(float);
        channel->user_line_stride = channel->user_pixel_stride * picture->width;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
}

static bool put_rows(exr_context_t file, const rt_image_pixels *picture)
{
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    int32_t rows = 0; /* in a chunk */
    bool is_good = good(exr_get_scanlines_per_chunk(file, 0, &rows));
    for (int y = 0; y < picture->height && is_good; y += rows) {
        exr_chunk_info_t chunk;
        is_good = good(exr_write_scanline_chunk_info(file, 0, y, &chunk)) &&
                  good(y == 0 ? exr_encoding_initialize(file, 0, &chunk, &pipeline)
                              : exr_encoding_update(file, 0, &chunk, &pipeline));
        if (is_good)
            point_at(&pipeline, picture, y);
        is_good = is_good &&
                  (y > 0 || good(exr_encoding_choose_default_routines(file, 0, &pipeline))) &&
                  good(exr_encoding_run(file, 0, &pipeline));
    }
    exr_encoding_destroy(file, &pipeline);
    return is_good;
}

static void give(rt_image_take *take, void *sink, const memory *m)
{
    for (size_t at = 0; at < m->length;) {
        const size_t left = m->length - at, part = left < INT_MAX ? left : INT_MAX;
        take(sink, m->bytes + at, (int)part);
        at += part;
    }
}

int rt_exr_encode(rt_image_take *take, void *sink, const rt_image_pixels *picture)
{
    memory m = {0};
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = say_nothing;
    how.user_data = &m;
    how.write_fn = put;
    how.zip_level = ZIP_LEVEL;
    exr_context_t file = NULL;
    bool is_good = good(exr_start_write(&file, "the picture", EXR_WRITE_FILE_DIRECTLY, &how));
    is_good = is_good && put_head(file, picture) && put_rows(file, picture);
    /* It writes where the chunks are. */
    is_good = good(exr_finish(&file)) && is_good;
    if (is_good)
        give(take, sink, &m);
    free(m.bytes);
    return is_good;
}
