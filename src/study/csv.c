#include "study/csv.h"

#include "study/fields.h"

static void print_text(const char *text, FILE *out)
{
    fputc('"', out);
    for (; *text; ++text) {
        if (*text == '"')
            fputc('"', out);
        fputc(*text, out);
    }
    fputc('"', out);
}

void rt_study_print_csv(const rt_study *study, FILE *out)
{
    fputs("scene,device_name,width,height,level,samples", out);
    rt_fields_print_names(rt_study_cell_fields, out);
    rt_fields_print_names(rt_study_entry_fields, out);
    fputs("\r\n", out);
    for (size_t i = 0; i < study->plan.sample_count; ++i)
        for (size_t k = 0; k < study->entry_count; ++k) {
            const rt_study_entry *entry = &study->entries[k];
            print_text(study->scene, out);
            fputc(',', out);
            print_text(study->devices[entry->device].name, out);
            fprintf(out, ",%d,%d,%s,%d", study->width, study->height,
                    rt_accuracy_name(entry->level), study->plan.samples[i]);
            rt_fields_print(rt_study_cell_fields, rt_study_cell_at(study, i, k), out);
            rt_fields_print(rt_study_entry_fields, entry, out);
            fputs("\r\n", out);
        }
}
