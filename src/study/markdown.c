#include "study/markdown.h"

#include <stdlib.h>

#include "study/report_text.h"

void rt_study_print_markdown(const rt_study *study, const char *name, bool has_pictures,
                             bool has_plot, FILE *out)
{
    char *headline = rt_study_headline(study);
    rt_doc doc = {.out = out};
    fprintf(out, "# What accuracy costs: %s\n\n**%s**\n\n", study->scene, headline ? headline : "");
    free(headline);
    if (has_pictures) {
        fprintf(out, "![the scene twice, and the difference](%s-pictures.png)\n\n", name);
        rt_doc_paragraph(
            &doc,
            "The scene at %s, at %s, and where they differ: black where not at all, pale yellow "
            "where by 64 of 256 steps and more. Look where it is bright, then at the same place in "
            "the other two.",
            rt_study_shown_name(study, 0), rt_study_shown_name(study, 1));
    }
    rt_report_first(study, &doc);
    if (has_plot)
        fprintf(out, "![time against error, by level](%s.svg)\n\n", name);
    rt_report_rest(study, &doc);
}
