#define _GNU_SOURCE
#include "study/load.h"

#include <dirent.h>
#include <stdio.h>

#define TASKS "/proc/self/task"

/* Linux tells of each thread in /proc/PID/task/TID/schedstat: nanoseconds run, and nanoseconds
 * waited in the queue of a processor. */
static void add_thread(rt_load *load, const char *name)
{
    char path[300];
    unsigned long long ran = 0, waited = 0;
    snprintf(path, sizeof path, TASKS "/%s/schedstat", name);
    FILE *in = fopen(path, "re");
    if (!in)
        return;
    if (fscanf(in, "%llu %llu", &ran, &waited) == 2) {
        load->ran += 1e-9 * (double)ran;
        load->waited += 1e-9 * (double)waited;
    }
    fclose(in);
}

rt_load rt_load_read(void)
{
    rt_load load = {0.0, 0.0};
    DIR *tasks = opendir(TASKS);
    if (!tasks)
        return load;
    for (const struct dirent *entry; (entry = readdir(tasks));)
        if (entry->d_name[0] != '.')
            add_thread(&load, entry->d_name);
    closedir(tasks);
    return load;
}

double rt_load_share(const rt_load *before, const rt_load *after)
{
    const double ran = after->ran - before->ran, waited = after->waited - before->waited;
    return ran > 0.0 && waited > 0.0 ? ran / (ran + waited) : 1.0;
}
