#define _GNU_SOURCE
#include "bench/settings.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/number.h"
#include "kernels/layout.h"

enum {
    OPTION_DEVICE = 'd',
    OPTION_HELP = 'h',
    OPTION_HUGE = 256,
    OPTION_JSON,
    OPTION_LEVEL,
    OPTION_REPEATS,
    OPTION_RT,
    OPTION_SHADOW,
    OPTION_SIZE,
    OPTION_SPHERES,
    OPTION_THREADS
};

static const struct option long_options[] = {
    {"device", required_argument, NULL, OPTION_DEVICE},
    {"help", no_argument, NULL, OPTION_HELP},
    {"huge", no_argument, NULL, OPTION_HUGE},
    {"json", required_argument, NULL, OPTION_JSON},
    {"level", required_argument, NULL, OPTION_LEVEL},
    {"repeats", required_argument, NULL, OPTION_REPEATS},
    {"rt", required_argument, NULL, OPTION_RT},
    {"shadow-from-light", no_argument, NULL, OPTION_SHADOW},
    {"size", required_argument, NULL, OPTION_SIZE},
    {"spheres", required_argument, NULL, OPTION_SPHERES},
    {"threads", required_argument, NULL, OPTION_THREADS},
    {NULL, 0, NULL, 0}};

void bench_settings_help(const char *program)
{
    printf("Usage: %s [OPTION]...\n"
           "  -d, --device=DEVICE      OpenCL device, as rt --device takes it\n"
           "      --huge               meshes of 10^7 triangles and more too\n"
           "      --json=FILE          add the results to FILE\n"
           "      --level=N            measure the mesh of 20 * 4^N triangles instead of the\n"
           "                           program's own set, or step up to it (0 to %d)\n"
           "      --repeats=N          repeats after one warm-up; by default 9\n"
           "      --rt=FILE            the rt to start; by default ./rt\n"
           "      --shadow-from-light  shadow rays start at the light instead of the hit\n"
           "      --size=N             pictures of N x N pixels, a multiple of %d\n"
           "      --spheres=N          spheres of the sphere field; 0 leaves it out\n"
           "      --threads=N          threads of each program; by default 2\n",
           program, BENCH_LEVEL_MAX, RT_BLOCK_SIDE);
}

static bool read_whole(const char *option, int64_t low, int64_t high, int *out, rt_status *status)
{
    int64_t value = 0;
    if (rt_number_int(optarg, strlen(optarg), &value) != RT_NUMBER_OK || value < low ||
        value > high)
        return rt_status_fail(status, RT_ERROR_USAGE,
                              "bench: found '%s'; %s takes a whole number from %lld to %lld",
                              optarg, option, (long long)low, (long long)high);
    *out = (int)value;
    return true;
}

static bool read_option(bench_settings *s, int code, rt_status *status)
{
    switch (code) {
    case OPTION_DEVICE:
        s->device = optarg;
        return true;
    case OPTION_HELP:
        s->help = true;
        return true;
    case OPTION_HUGE:
        s->huge = true;
        return true;
    case OPTION_JSON:
        s->json = optarg;
        return true;
    case OPTION_LEVEL:
        return read_whole("--level", 0, BENCH_LEVEL_MAX, &s->level, status);
    case OPTION_REPEATS:
        return read_whole("--repeats", 1, 1000, &s->repeats, status);
    case OPTION_RT:
        s->rt = optarg;
        return true;
    case OPTION_SHADOW:
        s->shadow_from_light = true;
        return true;
    case OPTION_SIZE:
        return read_whole("--size", RT_BLOCK_SIDE, 16384, &s->size, status) &&
               (s->size % RT_BLOCK_SIDE == 0 ||
                rt_status_fail(status, RT_ERROR_USAGE, "bench: --size takes a multiple of %d",
                               RT_BLOCK_SIDE));
    case OPTION_SPHERES:
        return read_whole("--spheres", 0, 100000000, &s->spheres, status);
    case OPTION_THREADS:
        return read_whole("--threads", 1, 256, &s->threads, status);
    default:
        return rt_status_fail(status, RT_ERROR_USAGE, "bench: unknown option; try --help");
    }
}

bool bench_settings_read(bench_settings *s, int argc, char **argv, rt_status *status)
{
    *s = (bench_settings){.level = -1, .spheres = 35000, .repeats = 9, .threads = 2, .rt = "./rt"};
    opterr = 0;
    int code;
    while ((code = getopt_long(argc, argv, "d:h", long_options, NULL)) != -1)
        if (!read_option(s, code, status))
            return false;
    if (optind < argc)
        return rt_status_fail(status, RT_ERROR_USAGE, "bench: one argument too many: %s",
                              argv[optind]);
    char threads[16];
    snprintf(threads, sizeof threads, "%d", s->threads);
    setenv("POCL_MAX_PTHREAD_COUNT", threads, 1);
    return true;
}
