/* The figures of a study as tables of fields, which JSON is written and read by, and
 * comma-separated values are written by. */
#ifndef RT_STUDY_FIELDS_H
#define RT_STUDY_FIELDS_H

#include <jansson.h>
#include <stdio.h>

#include "study/result.h"

enum rt_field_type {
    RT_FIELD_INT,
    RT_FIELD_COUNT,  /* size_t */
    RT_FIELD_NUMBER, /* double; null in JSON and nothing in CSV where it is not finite */
    RT_FIELD_FLAG,
    RT_FIELD_SPREAD, /* rt_spread */
    RT_FIELD_ERROR   /* rt_study_error */
};

typedef struct rt_field {
    const char *name; /* in JSON "seconds/kernel" is the member "kernel" of an object "seconds" */
    enum rt_field_type type;
    size_t offset;
} rt_field;

/* A struct's, ended by one without a name. */
extern const rt_field rt_study_fields[], rt_study_device_fields[], rt_study_entry_fields[],
    rt_study_cell_fields[];

/* Adds the fields of the struct at `base` to an object. */
void rt_fields_write(json_t *object, const rt_field *fields, const void *base);

/* Fills them in. Returns NULL, or the name of the first that is missing or not of its type. */
const char *rt_fields_read(const json_t *object, const rt_field *fields, void *base);

/* Each behind a comma; names have '_' for '/'. */
void rt_fields_print_names(const rt_field *fields, FILE *out);
void rt_fields_print(const rt_field *fields, const void *base, FILE *out);

#endif
