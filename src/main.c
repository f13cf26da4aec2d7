/* From argv to the exit code. */
#include <stdio.h>
#include <string.h>

#include "cli/actions.h"
#include "common/clock.h"
#include "opencl/compiler.h"
#include "scene_text/grammar.h"

static bool act(rt_run *run)
{
    switch (run->options.action) {
    case RT_ACTION_HELP:
        rt_options_help(stdout);
        return true;
    case RT_ACTION_VERSION:
        printf("rt %s\n", RT_VERSION);
        return true;
    case RT_ACTION_GRAMMAR:
        rt_grammar_print(stdout);
        return true;
    case RT_ACTION_LIST:
        return rt_action_list(run);
    case RT_ACTION_PREPARE:
        return rt_action_prepare(run);
    case RT_ACTION_CACHE:
        return rt_action_cache(run);
    case RT_ACTION_CACHE_CLEAR:
        return rt_action_cache_clear(run);
    case RT_ACTION_STUDY:
        return rt_action_study(run);
    case RT_ACTION_PLOT:
        return rt_action_plot(run);
    case RT_ACTION_EXPLAIN:
        return rt_action_explain(run);
    case RT_ACTION_RENDER:
        break;
    }
    return rt_action_render(run);
}

int main(int argc, char **argv)
{
    if (argc == 2 + RT_COMPILER_ARGUMENTS && strcmp(argv[1], RT_COMPILER_CALL) == 0)
        return rt_compiler_main(argv + 2);
    rt_compiler_set("/proc/self/exe");
    rt_run run = {.start = rt_clock_seconds()};
    bool good = rt_options_read(&run.options, argc, argv, &run.status) && act(&run);
    if (!good)
        rt_run_heed_signals(&run);
    /* Text on standard output may still be in a buffer that a full disk refuses. */
    if (fflush(stdout) != 0 || ferror(stdout))
        good = rt_status_fail(&run.status, RT_ERROR_OUTPUT, "rt: cannot write standard output");
    rt_status_print(&run.status, stderr);
    const enum rt_code code = good ? RT_OK : run.status.code;
    rt_run_end(&run);
    return (int)code;
}
