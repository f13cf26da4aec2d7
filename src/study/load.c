#define _GNU_SOURCE
#include "study/load.h"

#include <dirent.h>
#include <stdio.h>
#include <unistd.h>

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

/* And of all processors together in the first line of /proc/stat, in hundredths of a second. */
static void add_processors(rt_load *load)
{
    unsigned long long user, nice, system, idle, io, irq, soft, stolen;
    FILE *in = fopen("/proc/stat", "re");
    if (!in)
        return;
    if (fscanf(in, "cpu %llu %llu %llu %llu %llu %llu %llu %llu", &user, &nice, &system, &idle, &io,
               &irq, &soft, &stolen) == 8) {
        const double tick = 1.0 / (double)sysconf(_SC_CLK_TCK);
        load->busy = tick * (double)(user + nice + system + irq + soft);
        load->stolen = tick * (double)stolen;
        load->all = load->busy + load->stolen + tick * (double)(idle + io);
    }
    fclose(in);
}

rt_load rt_load_read(void)
{
    rt_load load = {0};
    add_processors(&load);
    DIR *tasks = opendir(TASKS);
    if (!tasks)
        return load;
    for (const struct dirent *entry; (entry = readdir(tasks));)
        if (entry->d_name[0] != '.')
            add_thread(&load, entry->d_name);
    closedir(tasks);
    return load;
}

static double part(double of, double whole)
{
    return whole > 0.0 && of > 0.0 ? (of < whole ? of / whole : 1.0) : 0.0;
}

double rt_load_held(const rt_load *before, const rt_load *after)
{
    const double ran = after->ran - before->ran, waited = after->waited - before->waited;
    const double all = after->all - before->all, busy = after->busy - before->busy;
    const double mine = part(waited, ran + waited), others = part(busy - ran, all);
    return (mine < others ? mine : others) + part(after->stolen - before->stolen, all);
}
