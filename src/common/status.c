#include "common/status.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

/* Makes room for `extra` more bytes and a terminator. Memory may be what has run out, so a message
 * that finds no room is dropped; the code and the count still tell that there was one. */
static bool reserve(rt_status *status, size_t extra)
{
    const size_t needed = status->length + extra + 1;
    if (needed <= status->capacity)
        return true;
    const size_t capacity = needed < 512 ? 512 : 2 * needed;
    char *text = realloc(status->text, capacity);
    if (!text)
        return false;
    status->text = text;
    status->capacity = capacity;
    return true;
}

/* What files say must not steer a terminal: control characters become question marks. */
static void make_printable(char *text, size_t length)
{
    for (size_t i = 0; i < length; ++i) {
        const unsigned char c = (unsigned char)text[i];
        if ((c < 0x20 && c != '\n' && c != '\t') || c == 0x7f)
            text[i] = '?';
    }
}

static void append(rt_status *status, const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    /* The callers start the list. NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized) */
    const int length = vsnprintf(NULL, 0, format, arguments);
    if (length >= 0 && reserve(status, (size_t)length + 1)) {
        char *end = status->text + status->length;
        vsnprintf(end, (size_t)length + 1, format, again);
        end[length] = '\n';
        end[length + 1] = '\0';
        make_printable(end, (size_t)length);
        status->length += (size_t)length + 1;
    }
    va_end(again);
}

bool rt_status_fail(rt_status *status, enum rt_code code, const char *format, ...)
{
    if (status->code == RT_OK)
        status->code = code;
    if (status->errors++ < RT_STATUS_SHOWN) {
        va_list arguments;
        va_start(arguments, format);
        append(status, format, arguments);
        va_end(arguments);
    }
    return false;
}

void rt_status_warn(rt_status *status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    append(status, format, arguments);
    va_end(arguments);
}

bool rt_status_no_memory(rt_status *status, const char *what)
{
    return rt_status_fail(status, RT_ERROR_DEVICE, "rt: out of memory for %s", what);
}

void rt_status_print(rt_status *status, FILE *out)
{
    if (status->text)
        fputs(status->text, out);
    if (status->errors > RT_STATUS_SHOWN)
        fprintf(out, "rt: %zu more errors\n", status->errors - RT_STATUS_SHOWN);
    status->length = 0;
    if (status->text)
        status->text[0] = '\0';
}

void rt_status_clear(rt_status *status)
{
    free(status->text);
    *status = RT_STATUS_INIT;
}
