/* What --explain prints, and its JSON. */
#define _GNU_SOURCE
#include <stdlib.h>
#include <string.h>

#include "common/json.h"
#include "study/explain.h"

#define MILLI 1e3

/* Where nothing but noise lies between the quartiles of a difference. */
static bool is_noise(const rt_spread *q)
{
    return !(q->low > 0.0 || q->high < 0.0);
}

static void print_cost(const rt_explain_cost *c, FILE *out)
{
    char stages[32] = "part of others";
    if (c->has_stages)
        snprintf(stages, sizeof stages, "%.3f", MILLI * c->stages.median);
    fprintf(out, "  %14s %10.3f %10.3f  ", stages, MILLI * c->with.median,
            MILLI * c->without.median);
    const rt_spread *d = &c->difference;
    if (is_noise(d))
        fprintf(out, "no measurable cost (%+.3f to %+.3f)", MILLI * d->low, MILLI * d->high);
    else
        fprintf(out, "%+.3f (%+.3f to %+.3f)", MILLI * d->median, MILLI * d->low, MILLI * d->high);
}

static int place_width(const rt_effects *effects)
{
    int width = (int)strlen("called for by");
    for (int i = 0; i < RT_EFFECT_COUNT; ++i) {
        const rt_place *p = &effects->called_by[i];
        const int length =
            effects->on[i] && p->line ? snprintf(NULL, 0, "%s:%d", p->file, p->line) : 0;
        width = length > width ? length : width;
    }
    return width;
}

/* Effects that are no statements of their own. */
static void print_content(const rt_effects *e, FILE *out)
{
    int count = 0;
    fprintf(out, "primitives: %s", e->has_primitives ? "" : "no primitives");
    for (int k = 0; k < RT_KIND_COUNT; ++k)
        if (e->has_kind[k])
            fprintf(out, "%s%s", count++ ? " and " : "", rt_kinds[k].names);
    const char *kinds = e->has_point_lights && e->has_directional_lights ? "point and directional"
                        : e->has_point_lights                            ? "point alone"
                        : e->has_directional_lights                      ? "directional alone"
                                                                         : "no kind";
    fprintf(out, "%s; lights: %d, %s\n", count == 1 ? " alone" : "", e->light_count, kinds);
}

void rt_explain_print(const rt_explanation *e, FILE *out)
{
    const int width = place_width(&e->effects);
    bool is_measured = false;
    for (int i = 0; i < RT_EFFECT_COUNT; ++i)
        is_measured = is_measured || e->costs[i].is_measured;
    fprintf(out, "%-18s %-3s  %-*s", "effect", "", width, "called for by");
    if (is_measured)
        fprintf(out, "  %14s %10s %10s  cost", "own stages", "with", "without");
    fputc('\n', out);
    for (int i = 0; i < RT_EFFECT_COUNT; ++i) {
        const rt_place *place = &e->effects.called_by[i];
        const char *name = rt_effect_name((enum rt_effect)i);
        if (!e->effects.on[i]) {
            fprintf(out, "%-18s off  not compiled\n", name);
            continue;
        }
        char text[512] = "";
        if (place->line)
            snprintf(text, sizeof text, "%s:%d", place->file, place->line);
        const bool has_cost = e->costs[i].is_measured;
        fprintf(out, "%-18s on   %-*s", name, has_cost ? width : 0, text);
        if (has_cost)
            print_cost(&e->costs[i], out);
        fputc('\n', out);
    }
    print_content(&e->effects, out);
    if (is_measured)
        fprintf(out,
                "milliseconds a picture of %dx%d%s on %s:\n"
                "medians of %d pairs of pictures, with the effect and without it in turn; of the "
                "cost,\n"
                "which is the difference, the quartiles too\n",
                e->width, e->height,
                e->width < e->picture_width || e->height < e->picture_height ? ", made smaller,"
                                                                             : "",
                e->device->name, e->pairs);
}

static json_t *quartiles_json(const rt_spread *q)
{
    return json_pack("{s:f,s:f,s:f}", "low", q->low, "median", q->median, "high", q->high);
}

static json_t *effect_json(const rt_explanation *e, int i)
{
    const rt_explain_cost *c = &e->costs[i];
    const rt_place *place = &e->effects.called_by[i];
    json_t *json = json_pack("{s:s,s:b}", "name", rt_effect_name((enum rt_effect)i), "on",
                             (int)e->effects.on[i]);
    if (e->effects.on[i] && place->line) {
        json_object_set_new(json, "file", json_string(place->file));
        json_object_set_new(json, "line", json_integer(place->line));
    }
    if (c->is_measured) {
        if (c->has_stages)
            json_object_set_new(json, "stages", quartiles_json(&c->stages));
        json_object_set_new(json, "with", quartiles_json(&c->with));
        json_object_set_new(json, "without", quartiles_json(&c->without));
        json_object_set_new(json, "cost", quartiles_json(&c->difference));
        json_object_set_new(json, "measurable", json_boolean(!is_noise(&c->difference)));
    }
    return json;
}

bool rt_explain_write(const rt_explanation *e, rt_output *output, rt_status *status)
{
    json_t *root = json_object(), *effects = json_array();
    for (int i = 0; i < RT_EFFECT_COUNT; ++i)
        json_array_append_new(effects, effect_json(e, i));
    if (e->device) {
        json_object_set_new(root, "device", json_string(e->device->name));
        json_object_set_new(root, "width", json_integer(e->width));
        json_object_set_new(root, "height", json_integer(e->height));
        json_object_set_new(root, "pairs", json_integer(e->pairs));
    }
    json_object_set_new(root, "effects", effects);
    return rt_json_write(root, RT_JSON_DIGITS, "--stats", output, status);
}
