#include "study/fields.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

/* Longer than any name. */
#define NAME_SIZE 80

#define FIELD(type, name, kind, member)                                                            \
    {                                                                                              \
        name, RT_FIELD_##kind, offsetof(type, member)                                              \
    }
#define END                                                                                        \
    {                                                                                              \
        NULL, RT_FIELD_INT, 0                                                                      \
    }

const rt_field rt_study_fields[] = {
    FIELD(rt_study, "width", INT, width),
    FIELD(rt_study, "height", INT, height),
    FIELD(rt_study, "repeats", INT, plan.repeats),
    FIELD(rt_study, "reference/is_scalar_path", FLAG, reference_is_scalar),
    FIELD(rt_study, "reference/device", COUNT, reference_device),
    FIELD(rt_study, "reference/converged_samples", INT, converged_samples),
    FIELD(rt_study, "reference/scalar_seconds_a_sample", NUMBER, reference_seconds),
    FIELD(rt_study, "edge_triangles", COUNT, edge_triangles),
    END};

const rt_field rt_study_device_fields[] = {
    FIELD(rt_study_device, "kernel_is_wall_time", FLAG, kernel_is_wall),
    FIELD(rt_study_device, "held_by_other_programs", NUMBER, held), END};

const rt_field rt_study_entry_fields[] = {
    FIELD(rt_study_entry, "device", COUNT, device),
    FIELD(rt_study_entry, "rays", COUNT, rays),
    FIELD(rt_study_entry, "hits", COUNT, hits),
    FIELD(rt_study_entry, "hit_index_disagreements", COUNT, disagreements),
    FIELD(rt_study_entry, "t_error_ulp/p50", NUMBER, t_p50),
    FIELD(rt_study_entry, "t_error_ulp/p99", NUMBER, t_p99),
    FIELD(rt_study_entry, "t_error_ulp/max", NUMBER, t_max),
    FIELD(rt_study_entry, "next_rays", COUNT, next_rays),
    FIELD(rt_study_entry, "self_hits", COUNT, self_hits),
    FIELD(rt_study_entry, "edge_rays", COUNT, edge_rays),
    FIELD(rt_study_entry, "leaks", COUNT, leaks),
    FIELD(rt_study_entry, "double_hits", COUNT, double_hits),
    END};

const rt_field rt_study_cell_fields[] = {
    FIELD(rt_study_cell, "picture_rays", COUNT, rays),
    FIELD(rt_study_cell, "seconds/program", NUMBER, program),
    FIELD(rt_study_cell, "seconds/upload", NUMBER, upload),
    FIELD(rt_study_cell, "seconds/kernel", SPREAD, kernel),
    FIELD(rt_study_cell, "seconds/readback", SPREAD, readback),
    FIELD(rt_study_cell, "seconds/wall", SPREAD, wall),
    FIELD(rt_study_cell, "kernel_ratio_to_base", SPREAD, ratio),
    FIELD(rt_study_cell, "kernel_ratio_to_first_device", SPREAD, ratio_to_first),
    FIELD(rt_study_cell, "against_same_samples", ERROR, arithmetic),
    FIELD(rt_study_cell, "visible_pixels", COUNT, visible),
    FIELD(rt_study_cell, "against_converged", ERROR, seen),
    FIELD(rt_study_cell, "dominated_arithmetic", FLAG, arithmetic_is_dominated),
    FIELD(rt_study_cell, "dominated_seen", FLAG, seen_is_dominated),
    END};

static const rt_field spread_fields[] = {FIELD(rt_spread, "q1", NUMBER, low),
                                         FIELD(rt_spread, "median", NUMBER, median),
                                         FIELD(rt_spread, "q3", NUMBER, high), END};

static const rt_field error_fields[] = {
    FIELD(rt_study_error, "pixels_over_0", COUNT, over_0),
    FIELD(rt_study_error, "pixels_over_1", COUNT, over_1),
    FIELD(rt_study_error, "pixels_over_8", COUNT, over_8),
    FIELD(rt_study_error, "max_steps", INT, max_step),
    FIELD(rt_study_error, "rms_steps", NUMBER, rms),
    FIELD(rt_study_error, "non_finite_pixels", COUNT, non_finite),
    END};

/* The fields that a field is made of, or NULL. */
static const rt_field *parts_of(const rt_field *field)
{
    return field->type == RT_FIELD_SPREAD  ? spread_fields
           : field->type == RT_FIELD_ERROR ? error_fields
                                           : NULL;
}

static json_t *value_of(const rt_field *field, const char *at)
{
    const rt_field *parts = parts_of(field);
    json_t *value = NULL;
    if (parts) {
        value = json_object();
        rt_fields_write(value, parts, at);
    } else if (field->type == RT_FIELD_INT) {
        value = json_integer(*(const int *)(const void *)at);
    } else if (field->type == RT_FIELD_COUNT) {
        value = json_integer((json_int_t) * (const size_t *)(const void *)at);
    } else if (field->type == RT_FIELD_FLAG) {
        value = json_boolean(*(const bool *)(const void *)at);
    } else {
        const double number = *(const double *)(const void *)at;
        value = isfinite(number) ? json_real(number) : json_null();
    }
    return value;
}

/* A name without what is behind its '/', if it has one; returns what is, or all of it. */
static const char *split(const char *name, char group[NAME_SIZE])
{
    const char *slash = strchr(name, '/');
    snprintf(group, NAME_SIZE, "%.*s", slash ? (int)(slash - name) : 0, name);
    return slash ? slash + 1 : name;
}

void rt_fields_write(json_t *object, const rt_field *fields, const void *base)
{
    for (const rt_field *f = fields; f->name; ++f) {
        char group[NAME_SIZE];
        const char *last = split(f->name, group);
        if (*group && !json_object_get(object, group))
            json_object_set_new(object, group, json_object());
        json_object_set_new(*group ? json_object_get(object, group) : object, last,
                            value_of(f, (const char *)base + f->offset));
    }
}

static bool read_value(const json_t *value, const rt_field *field, char *at)
{
    const rt_field *parts = parts_of(field);
    const json_int_t whole = json_integer_value(value);
    if (parts)
        return json_is_object(value) && !rt_fields_read(value, parts, at);
    switch (field->type) {
    case RT_FIELD_INT:
        *(int *)(void *)at = (int)whole;
        return json_is_integer(value) && whole >= 0 && whole <= INT_MAX;
    case RT_FIELD_COUNT:
        *(size_t *)(void *)at = (size_t)whole;
        return json_is_integer(value) && whole >= 0;
    case RT_FIELD_FLAG:
        *(bool *)(void *)at = json_is_true(value);
        return json_is_boolean(value);
    default:
        *(double *)(void *)at = json_is_null(value) ? NAN : json_number_value(value);
        return json_is_number(value) || json_is_null(value);
    }
}

const char *rt_fields_read(const json_t *object, const rt_field *fields, void *base)
{
    for (const rt_field *f = fields; f->name; ++f) {
        char group[NAME_SIZE];
        const char *last = split(f->name, group);
        const json_t *holder = *group ? json_object_get(object, group) : object;
        if (!read_value(json_object_get(holder, last), f, (char *)base + f->offset))
            return f->name;
    }
    return NULL;
}

static void print_name(const char *before, const char *name, FILE *out)
{
    fputc(',', out);
    fputs(before, out);
    fputs(*before ? "_" : "", out);
    for (; *name; ++name)
        fputc(*name == '/' ? '_' : *name, out);
}

void rt_fields_print_names(const rt_field *fields, FILE *out)
{
    for (const rt_field *f = fields; f->name; ++f) {
        const rt_field *parts = parts_of(f);
        char group[NAME_SIZE];
        snprintf(group, sizeof group, "%s", f->name);
        for (char *slash; (slash = strchr(group, '/'));)
            *slash = '_';
        if (!parts)
            print_name("", f->name, out);
        for (const rt_field *part = parts; part && part->name; ++part)
            print_name(group, part->name, out);
    }
}

void rt_fields_print(const rt_field *fields, const void *base, FILE *out)
{
    for (const rt_field *f = fields; f->name; ++f) {
        const void *at = (const char *)base + f->offset;
        const rt_field *parts = parts_of(f);
        if (parts) {
            rt_fields_print(parts, at, out);
            continue;
        }
        fputc(',', out);
        if (f->type == RT_FIELD_INT)
            fprintf(out, "%d", *(const int *)at);
        else if (f->type == RT_FIELD_COUNT)
            fprintf(out, "%zu", *(const size_t *)at);
        else if (f->type == RT_FIELD_FLAG)
            fprintf(out, "%d", *(const bool *)at);
        else if (isfinite(*(const double *)at))
            fprintf(out, "%.9g", *(const double *)at);
    }
}
