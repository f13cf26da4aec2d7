#define _GNU_SOURCE
#include "study/study_json.h"

#include <stdlib.h>
#include <string.h>

#include "common/json.h"
#include "study/fields.h"
#include "study/report_text.h"

/* What stands for a level where the reference is meant. */
#define REFERENCE "reference"

/* Of a count of samples: study->sampling. */
static const rt_field sampling_fields[] = {{"reference_against_converged", RT_FIELD_ERROR, 0},
                                           {NULL, RT_FIELD_INT, 0}};

static const char *name_of(enum rt_accuracy level)
{
    return level == RT_ACCURACY_COUNT ? REFERENCE : rt_accuracy_name(level);
}

static json_t *device_json(const rt_study_device *device)
{
    json_t *lacking = json_array();
    for (int i = 0; i < RT_ACCURACY_COUNT; ++i)
        if (device->lacks[i])
            json_array_append_new(lacking, json_string(rt_accuracy_name((enum rt_accuracy)i)));
    json_t *json = json_pack("{s:s,s:s,s:s,s:o}", "name", device->name, "platform",
                             device->platform, "driver", device->driver, "levels_lacking", lacking);
    rt_fields_write(json, rt_study_device_fields, device);
    return json;
}

static json_t *entry_json(const rt_study_entry *entry)
{
    json_t *json = json_pack("{s:s}", "level", rt_accuracy_name(entry->level));
    rt_fields_write(json, rt_study_entry_fields, entry);
    return json;
}

static json_t *cell_json(const rt_study *study, size_t sample, size_t entry)
{
    const rt_study_entry *e = &study->entries[entry];
    json_t *json = json_pack("{s:i,s:s,s:i}", "device", (int)e->device, "level",
                             rt_accuracy_name(e->level), "samples", study->plan.samples[sample]);
    rt_fields_write(json, rt_study_cell_fields, rt_study_cell_at(study, sample, entry));
    return json;
}

static json_t *count_json(const rt_study *study, size_t sample)
{
    json_t *json = json_pack("{s:i,s:i}", "samples", study->plan.samples[sample], "rounds",
                             study->rounds[sample]);
    rt_fields_write(json, sampling_fields, &study->sampling[sample]);
    return json;
}

static json_t *json_of(const rt_study *study, const char *verdict)
{
    json_t *devices = json_array(), *entries = json_array(), *counts = json_array();
    json_t *cells = json_array();
    for (size_t i = 0; i < study->device_count; ++i)
        json_array_append_new(devices, device_json(&study->devices[i]));
    for (size_t i = 0; i < study->entry_count; ++i)
        json_array_append_new(entries, entry_json(&study->entries[i]));
    for (size_t i = 0; i < study->plan.sample_count; ++i) {
        json_array_append_new(counts, count_json(study, i));
        for (size_t k = 0; k < study->entry_count; ++k)
            json_array_append_new(cells, cell_json(study, i, k));
    }
    json_t *json =
        json_pack("{s:s,s:s,s:s,s:s,s:[s,s],s:s?,s:o,s:o,s:o,s:o}", "scene", study->scene,
                  "verdict", verdict, "base", rt_accuracy_name(study->base), "reference_level",
                  rt_accuracy_name(study->reference_level), "shown", name_of(study->shown[0]),
                  name_of(study->shown[1]), "no_edge_rays_because", rt_study_no_edges(study->edges),
                  "devices", devices, "counts", counts, "same_rays", entries, "pictures", cells);
    if (json)
        rt_fields_write(json, rt_study_fields, study);
    return json;
}

bool rt_study_write_json(const rt_study *study, rt_output *output, rt_status *status)
{
    char *verdict = rt_study_headline(study);
    json_t *root = verdict ? json_of(study, verdict) : NULL;
    free(verdict);
    return rt_json_write(root, RT_JSON_DIGITS_EXACT, "--study", output, status);
}

/* ---- The way back. Each is false, with a message, for what has not been written so. ---- */

typedef struct reading {
    rt_study *study;
    const char *path;
    rt_status *status;
} reading;

static bool wrong(const reading *r, const char *where, const char *what)
{
    return rt_status_fail(r->status, RT_ERROR_SCENE,
                          "%s: error: this is not a report of --study: %s%s%s", r->path, where,
                          *where ? ": " : "", what);
}

static bool read_fields(const reading *r, const json_t *json, const rt_field *fields, void *base,
                        const char *where)
{
    const char *missing = rt_fields_read(json, fields, base);
    return !missing || wrong(r, where, missing);
}

static bool read_level(const reading *r, const json_t *name, bool or_reference,
                       enum rt_accuracy *level)
{
    const char *text = json_string_value(name);
    if (text && or_reference && strcmp(text, REFERENCE) == 0) {
        *level = RT_ACCURACY_COUNT;
        return true;
    }
    return (text && rt_accuracy_of_name(text, level)) || wrong(r, "", "a level");
}

static bool read_text(const reading *r, const json_t *json, const char *key, char **text)
{
    const char *value = json_string_value(json_object_get(json, key));
    if (!value)
        return wrong(r, "", key);
    *text = strdup(value);
    return *text || rt_status_no_memory(r->status, "the study");
}

static bool read_device(const reading *r, const json_t *json, rt_study_device *device)
{
    const json_t *lacking = json_object_get(json, "levels_lacking");
    for (size_t i = 0; i < json_array_size(lacking); ++i) {
        enum rt_accuracy level = RT_ACCURACY_FAST;
        if (!read_level(r, json_array_get(lacking, i), false, &level))
            return false;
        device->lacks[level] = true;
    }
    return read_text(r, json, "name", &device->name) &&
           read_text(r, json, "platform", &device->platform) &&
           read_text(r, json, "driver", &device->driver) &&
           read_fields(r, json, rt_study_device_fields, device, "devices");
}

static bool read_devices(const reading *r, const json_t *array)
{
    rt_study *study = r->study;
    const size_t count = json_array_size(array);
    if (count < 1 || count > RT_STUDY_DEVICES_MOST)
        return wrong(r, "", "devices");
    study->devices = calloc(count, sizeof *study->devices);
    if (!study->devices)
        return rt_status_no_memory(r->status, "the study");
    study->device_count = count;
    for (size_t i = 0; i < count; ++i)
        if (!read_device(r, json_array_get(array, i), &study->devices[i]))
            return false;
    return true;
}

static bool read_entries(const reading *r, const json_t *array)
{
    rt_study *study = r->study;
    const size_t count = json_array_size(array);
    if (count < 1 || count > RT_STUDY_ENTRIES_MOST)
        return wrong(r, "", "same_rays");
    study->entry_count = count;
    for (size_t i = 0; i < count; ++i) {
        const json_t *json = json_array_get(array, i);
        rt_study_entry *entry = &study->entries[i];
        if (!read_level(r, json_object_get(json, "level"), false, &entry->level) ||
            !read_fields(r, json, rt_study_entry_fields, entry, "same_rays"))
            return false;
        if (entry->device >= study->device_count ||
            rt_study_find(study, entry->device, entry->level) != i)
            return wrong(r, "same_rays", "device");
        study->plan.levels[entry->level] = true;
    }
    for (size_t i = 0; i < count; ++i)
        if (rt_study_base_of(study, i) == count)
            return wrong(r, "", "base");
    return true;
}

static bool read_counts(const reading *r, const json_t *array)
{
    static const rt_field numbers[] = {{"samples", RT_FIELD_INT, 0},
                                       {"rounds", RT_FIELD_INT, sizeof(int)},
                                       {NULL, RT_FIELD_INT, 0}};
    rt_study *study = r->study;
    const size_t count = json_array_size(array);
    if (count < 1 || count > RT_STUDY_SAMPLES_LISTED)
        return wrong(r, "", "counts");
    study->plan.sample_count = count;
    for (size_t i = 0; i < count; ++i) {
        int both[2];
        const json_t *json = json_array_get(array, i);
        if (!read_fields(r, json, numbers, both, "counts") ||
            !read_fields(r, json, sampling_fields, &study->sampling[i], "counts"))
            return false;
        study->plan.samples[i] = both[0];
        study->rounds[i] = both[1];
    }
    return true;
}

static bool read_cells(const reading *r, const json_t *array)
{
    rt_study *study = r->study;
    const size_t count = rt_study_cell_count(study);
    if (json_array_size(array) != count)
        return wrong(r, "", "pictures");
    if (!rt_study_make_cells(study, r->status))
        return false;
    for (size_t i = 0; i < count; ++i)
        if (!read_fields(r, json_array_get(array, i), rt_study_cell_fields, &study->cells[i],
                         "pictures"))
            return false;
    return true;
}

static bool read_edges(const reading *r, const json_t *reason)
{
    for (int i = 0; i < RT_EDGES_COUNT; ++i) {
        const char *text = rt_study_no_edges((enum rt_study_edges)i);
        if (text ? json_is_string(reason) && strcmp(json_string_value(reason), text) == 0
                 : json_is_null(reason)) {
            r->study->edges = (enum rt_study_edges)i;
            return true;
        }
    }
    return wrong(r, "", "no_edge_rays_because");
}

static bool read_root(const reading *r, const json_t *root)
{
    rt_study *study = r->study;
    const json_t *shown = json_object_get(root, "shown");
    if (!read_text(r, root, "scene", &study->scene) ||
        !read_fields(r, root, rt_study_fields, study, "") ||
        !read_level(r, json_object_get(root, "base"), false, &study->base) ||
        !read_level(r, json_object_get(root, "reference_level"), false, &study->reference_level) ||
        !read_level(r, json_array_get(shown, 0), true, &study->shown[0]) ||
        !read_level(r, json_array_get(shown, 1), true, &study->shown[1]) ||
        !read_edges(r, json_object_get(root, "no_edge_rays_because")) ||
        !read_devices(r, json_object_get(root, "devices")) ||
        !read_counts(r, json_object_get(root, "counts")) ||
        !read_entries(r, json_object_get(root, "same_rays")) ||
        !read_cells(r, json_object_get(root, "pictures")))
        return false;
    return (study->reference_device < study->device_count && study->width > 0 &&
            study->height > 0) ||
           wrong(r, "", "reference/device, width or height");
}

bool rt_study_read_json(rt_study *study, const char *path, rt_status *status)
{
    rt_file_text text;
    json_error_t error;
    *study = (rt_study){0};
    const char *reason = rt_file_read(path, &text);
    if (reason)
        return rt_status_fail(status, RT_ERROR_SCENE, "%s: error: %s", path, reason);
    json_t *root = json_loadb(text.bytes, text.length, JSON_REJECT_DUPLICATES, &error);
    rt_file_free(&text);
    if (!root)
        return rt_status_fail(status, RT_ERROR_SCENE, "%s:%d:%d: error: %s", path, error.line,
                              error.column, error.text);
    const reading r = {study, path, status};
    const bool good = read_root(&r, root);
    json_decref(root);
    if (!good)
        rt_study_clear(study);
    return good;
}
