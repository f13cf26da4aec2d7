/* Adds to the report where and when it was taken, and prints it as Markdown. */
#define _GNU_SOURCE
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench/bench.h"

#define TEXT_SIZE 256

/* The value of the first line that begins with `key`, such as "model name" or "MemTotal". */
static void read_value(const char *path, const char *key, char text[TEXT_SIZE])
{
    char line[1024];
    FILE *in = fopen(path, "r");
    snprintf(text, TEXT_SIZE, "unknown");
    while (in && fgets(line, sizeof line, in)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, key, strlen(key)) == 0 && colon) {
            snprintf(text, TEXT_SIZE, "%.*s", (int)strcspn(colon + 1, "\n"), colon + 1);
            break;
        }
    }
    if (in)
        fclose(in);
    memmove(text, text + strspn(text, " \t"), strlen(text + strspn(text, " \t")) + 1);
}

/* Versions of Debian packages, "" where there is none. */
static void read_package(const char *package, char text[TEXT_SIZE])
{
    char line[TEXT_SIZE];
    snprintf(line, sizeof line, "dpkg-query -W -f='${Version}' %s 2>/dev/null", package);
    FILE *in = popen(line, "r");
    text[0] = '\0';
    if (in && !fgets(text, TEXT_SIZE, in))
        text[0] = '\0';
    if (in)
        pclose(in);
}

static bool add(json_t *machine, const char *key, const char *value, rt_status *status)
{
    return json_object_set_new(machine, key, json_string(value)) == 0 ||
           rt_status_no_memory(status, "the report");
}

static bool add_versions(json_t *machine, rt_status *status)
{
    static const char *const packages[][2] = {{"Embree", "libembree-dev"},
                                              {"Tachyon", "tachyon"},
                                              {"POV-Ray", "povray"},
                                              {"PoCL", "pocl-opencl-icd"}};
    char text[TEXT_SIZE];
    for (size_t i = 0; i < sizeof packages / sizeof *packages; ++i) {
        read_package(packages[i][1], text);
        if (*text && !add(machine, packages[i][0], text, status))
            return false;
    }
    return true;
}

static bool describe(bench *b)
{
    char date[32], cpu[TEXT_SIZE], memory[TEXT_SIZE], device[4 * RT_DEVICE_TEXT], threads[64];
    const time_t now = time(NULL);
    struct tm utc;
    strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", gmtime_r(&now, &utc));
    read_value("/proc/cpuinfo", "model name", cpu);
    read_value("/proc/meminfo", "MemTotal", memory);
    if (!bench_find_device(b))
        return false;
    snprintf(device, sizeof device, "%s [%s], %s", b->device->name, b->device->platform_name,
             b->device->version);
    snprintf(threads, sizeof threads, "%d; compute units of the device: %u", b->settings.threads,
             (unsigned)b->device->compute_units);
    json_t *machine = json_object();
    rt_status *s = &b->status;
    if (!machine || json_object_set_new(b->report.root, "machine", machine) != 0)
        return rt_status_no_memory(s, "the report");
    return add(machine, "date", date, s) && add(machine, "cpu", cpu, s) &&
           add(machine, "memory", memory, s) && add(machine, "device", device, s) &&
           add(machine, "driver", b->device->driver, s) && add(machine, "threads", threads, s) &&
           add(machine, "compiler", "gcc-compatible " __VERSION__, s) && add_versions(machine, s);
}

static bool print_all(bench *b)
{
    if (!describe(b))
        return false;
    bench_report_markdown(&b->report, stdout);
    return fflush(stdout) == 0 ||
           rt_status_fail(&b->status, RT_ERROR_OUTPUT, "bench: cannot write standard output");
}

int main(int argc, char **argv)
{
    return bench_main(argc, argv, print_all);
}
