/* What went wrong, and where. Every function that can fail takes an rt_status, returns true on
 * success and false after it has added at least one message. Only main turns it into an exit. */
#ifndef RT_COMMON_STATUS_H
#define RT_COMMON_STATUS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* The process's exit codes (src/cli/README.md, "Exit codes"). */
enum rt_code {
    RT_OK = 0,
    RT_ERROR_SCENE = 1,
    RT_ERROR_USAGE = 2,
    RT_ERROR_DEVICE = 3,
    RT_ERROR_OUTPUT = 4,
    RT_DIFFERENT = 5,
    RT_INTERRUPTED = 130
};

/* Messages kept; later ones are only counted. */
#define RT_STATUS_SHOWN 20

typedef struct rt_status {
    enum rt_code code; /* of the first error; RT_OK when there is none */
    size_t errors;     /* errors added, those not kept included */
    char *text;        /* owned: messages and warnings, each ended by a newline; may be NULL */
    size_t length, capacity;
} rt_status;

#define RT_STATUS_INIT ((rt_status){RT_OK, 0, NULL, 0, 0})

/* Adds an error; always returns false, so that a caller can return what this returns. */
bool rt_status_fail(rt_status *status, enum rt_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Adds a warning: text without an effect on the code. */
void rt_status_warn(rt_status *status, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Adds the error for memory that could not be had; false. `what` names what it was for. */
bool rt_status_no_memory(rt_status *status, const char *what);

/* Prints the messages kept, and how many errors there are besides, and forgets their text; the code
 * and the count of errors stay. */
void rt_status_print(rt_status *status, FILE *out);

/* Releases the text and makes the status empty again. */
void rt_status_clear(rt_status *status);

#endif
