#include "cli/actions.h"
#include "cli/signals.h"
#include "opencl/cache.h"
#include "render/programs.h"

bool rt_action_prepare(rt_run *r)
{
    const enum rt_accuracy level =
        r->options.has_accuracy ? r->options.accuracy : RT_ACCURACY_DEFAULT;
    rt_cache_size size;
    rt_run_heed(r);
    bool good = rt_cache_measure(&size, &r->status) && rt_run_choose_devices(r);
    rt_run_begin_progress(r);
    for (size_t i = 0; good && i < r->chosen_count; ++i)
        good = rt_programs_prepare(r->chosen[i], level, &r->building, &r->status);
    rt_progress_clear(&r->progress);
    return good;
}
