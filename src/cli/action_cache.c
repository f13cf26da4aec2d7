#include <stdio.h>
#include <stdlib.h>

#include "cli/actions.h"
#include "opencl/cache.h"

static void print_row(const char *whose, size_t programs, size_t bytes)
{
    printf("%-5s %6zu programs %8.1f MB\n", whose, programs, (double)bytes / (1 << 20));
}

bool rt_action_cache(rt_run *r)
{
    rt_cache_size size;
    if (!rt_cache_measure(&size, &r->status))
        return false;
    char *folder = rt_cache_folder();
    printf("%s, at most %zu MB\n", folder ? folder : "", rt_cache_limit() >> 20);
    free(folder);
    print_row("rt", size.programs, size.bytes);
    print_row("PoCL", size.pocl_programs, size.pocl_bytes);
    return true;
}

bool rt_action_cache_clear(rt_run *r)
{
    return rt_cache_clear(&r->status);
}
