/* Whole processes from start to exit, cold and warm: rt against Tachyon and POV-Ray on a mesh in
 * their own languages, and against a do-nothing OpenCL program on one sphere. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/bench.h"
#include "bench/folder.h"
#include "bench/formats.h"
#include "bench/meshes.h"
#include "bench/samples.h"
#include "common/clock.h"

#define MESH_SIZE_DEFAULT 1024
#define MESH_LEVEL_DEFAULT 6
#define SPHERE_SIZE_DEFAULT 512
#define ARGUMENTS_MAX 16
#define ARGUMENT_SIZE 512

/* A program with its arguments. A cold one gets an empty kernel cache each time. */
typedef struct command {
    const char *name;
    const char *folder; /* of all files */
    bool is_cold;
    char text[ARGUMENTS_MAX][ARGUMENT_SIZE];
    int count;
} command;

static void add_argument(command *c, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add_argument(command *c, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (c->count < ARGUMENTS_MAX)
        vsnprintf(c->text[c->count++], ARGUMENT_SIZE, format, arguments);
    va_end(arguments);
}

/* In the child: never returns. What the program says goes to a file that is shown if it fails. */
static void become(const command *c, const char *cache, const char *log)
{
    char *arguments[ARGUMENTS_MAX + 1] = {NULL};
    for (int i = 0; i < c->count; ++i)
        arguments[i] = (char *)c->text[i];
    const int out = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (out < 0 || dup2(out, STDOUT_FILENO) < 0 || dup2(out, STDERR_FILENO) < 0)
        _exit(126);
    setenv("POCL_CACHE_DIR", cache, 1);
    setenv("RT_CACHE_DIR", cache, 1);
    execvp(arguments[0], arguments);
    fprintf(stderr, "cannot start %s: %s; make bench-deps installs what is missing\n", arguments[0],
            strerror(errno));
    _exit(127);
}

static void show(const char *path)
{
    FILE *in = fopen(path, "r");
    if (!in)
        return;
    int c;
    while ((c = getc(in)) != EOF)
        putc(c, stderr);
    fclose(in);
}

static bool run_command(void *context, double *seconds, rt_status *status)
{
    const command *c = context;
    char cache[ARGUMENT_SIZE], log[ARGUMENT_SIZE];
    snprintf(cache, sizeof cache, "%s/%s", c->folder, c->is_cold ? "cold" : "warm");
    snprintf(log, sizeof log, "%s/log", c->folder);
    if (c->is_cold)
        bench_folder_remove(cache);
    fflush(NULL);
    const double start = rt_clock_seconds();
    const pid_t child = fork();
    if (child == 0)
        become(c, cache, log);
    int state = 0;
    if (child < 0 || waitpid(child, &state, 0) != child)
        return rt_status_fail(status, RT_ERROR_USAGE, "bench: cannot start %s", c->name);
    *seconds = rt_clock_seconds() - start;
    if (WIFEXITED(state) && WEXITSTATUS(state) == 0)
        return true;
    show(log);
    return rt_status_fail(status, RT_ERROR_USAGE, "bench: %s failed", c->text[0]);
}

static command rt_command(const bench *b, const char *folder, const char *scene, bool is_cold)
{
    command c = {.name = "rt", .folder = folder, .is_cold = is_cold};
    add_argument(&c, "%s", b->settings.rt);
    add_argument(&c, "--quiet");
    if (b->settings.device)
        add_argument(&c, "--device=%s", b->settings.device);
    add_argument(&c, "%s/%s.txt", folder, scene);
    add_argument(&c, "%s/rt-%s.png", folder, scene);
    return c;
}

static command tachyon_command(const bench *b, const char *folder)
{
    command c = {.name = "Tachyon", .folder = folder};
    add_argument(&c, "tachyon");
    add_argument(&c, "%s/mesh.dat", folder);
    /* Without shadows and with Phong's highlight, like rt. */
    add_argument(&c, "-mediumshade");
    add_argument(&c, "-shade_phong");
    add_argument(&c, "-numthreads");
    add_argument(&c, "%d", b->settings.threads);
    add_argument(&c, "-format");
    add_argument(&c, "PNG");
    add_argument(&c, "-o");
    add_argument(&c, "%s/tachyon.png", folder);
    return c;
}

static command povray_command(const bench *b, const char *folder, int size)
{
    command c = {.name = "POV-Ray", .folder = folder};
    add_argument(&c, "povray");
    add_argument(&c, "+I%s/mesh.pov", folder);
    add_argument(&c, "+O%s/povray.png", folder);
    add_argument(&c, "+W%d", size);
    add_argument(&c, "+H%d", size);
    add_argument(&c, "+WT%d", b->settings.threads);
    add_argument(&c, "-D");
    add_argument(&c, "-A");
    return c;
}

static bench_contender contender_of(command *c)
{
    return (bench_contender){.name = c->name, .run = run_command, .context = c};
}

static bool report_pair(bench *b, const char *what, const char *input, const bench_contender *ours,
                        const bench_contender *theirs, double bar)
{
    const int repeats = b->settings.repeats;
    const bench_row row = {.what = what,
                           .input = input,
                           .against = theirs->name,
                           .unit = "s",
                           .ours = bench_quartiles_of(ours->seconds, repeats),
                           .theirs = bench_quartiles_of(theirs->seconds, repeats),
                           .ratio = bench_ratio(theirs->seconds, ours->seconds, repeats),
                           .bar = bar};
    return bench_report_add(&b->report, &row, &b->status);
}

static bool write_mesh(bench *b, const char *folder, int level, int size, char label[64])
{
    char paths[3][ARGUMENT_SIZE];
    static const char *const endings[3] = {"txt", "dat", "pov"};
    for (int i = 0; i < 3; ++i)
        snprintf(paths[i], sizeof paths[i], "%s/mesh.%s", folder, endings[i]);
    bench_input input;
    const bool good = bench_input_icosphere(&input, 1u << level, size, &b->status) &&
                      bench_write_rt(&input.scene, paths[0], &b->status) &&
                      bench_write_tachyon(&input.scene, paths[1], &b->status) &&
                      bench_write_povray(&input.scene, paths[2], &b->status);
    snprintf(label, 64, "%s %dx%d", input.label, size, size);
    bench_input_clear(&input);
    return good;
}

static bool measure_mesh(bench *b, const char *folder)
{
    const int level = b->settings.level >= 0 ? b->settings.level : MESH_LEVEL_DEFAULT;
    const int size = b->settings.size ? b->settings.size : MESH_SIZE_DEFAULT;
    char label[64];
    if (!write_mesh(b, folder, level, size, label))
        return false;
    command commands[] = {rt_command(b, folder, "mesh", false), rt_command(b, folder, "mesh", true),
                          tachyon_command(b, folder), povray_command(b, folder, size)};
    bench_contender c[4];
    for (int i = 0; i < 4; ++i)
        c[i] = contender_of(&commands[i]);
    const bool is_full = level == MESH_LEVEL_DEFAULT && size == MESH_SIZE_DEFAULT;
    const bool good = bench_measure(c, 4, b->settings.repeats, &b->status) &&
                      report_pair(b, "process, warm", label, &c[0], &c[2], is_full ? 4.0 : 0.0) &&
                      report_pair(b, "process, cold", label, &c[1], &c[2], 0.0) &&
                      report_pair(b, "process, warm", label, &c[0], &c[3], 0.0) &&
                      report_pair(b, "process, cold", label, &c[1], &c[3], 0.0);
    bench_contenders_clear(c, 4);
    return good;
}

/* The do-nothing program lies beside this one. */
static command nothing_command(const bench *b, const char *folder, bool is_cold)
{
    char own[ARGUMENT_SIZE - 16] = "";
    command c = {.name = is_cold ? "do-nothing OpenCL program, cold"
                                 : "do-nothing OpenCL program, warm",
                 .folder = folder,
                 .is_cold = is_cold};
    if (readlink("/proc/self/exe", own, sizeof own - 1) < 0)
        own[0] = '\0';
    char *slash = strrchr(own, '/');
    if (slash)
        *slash = '\0';
    add_argument(&c, "%s/nothing", own);
    if (b->settings.device)
        add_argument(&c, "%s", b->settings.device);
    return c;
}

static bool measure_sphere(bench *b, const char *folder)
{
    const int size = b->settings.size ? b->settings.size : SPHERE_SIZE_DEFAULT;
    char path[ARGUMENT_SIZE], label[64];
    snprintf(path, sizeof path, "%s/sphere.txt", folder);
    snprintf(label, sizeof label, "1 sphere %dx%d", size, size);
    bench_input input;
    const bool is_written = bench_input_spheres(&input, 1, size, &b->status) &&
                            bench_write_rt(&input.scene, path, &b->status);
    bench_input_clear(&input);
    if (!is_written)
        return false;
    command commands[] = {rt_command(b, folder, "sphere", false),
                          rt_command(b, folder, "sphere", true), nothing_command(b, folder, false),
                          nothing_command(b, folder, true)};
    bench_contender c[4];
    for (int i = 0; i < 4; ++i)
        c[i] = contender_of(&commands[i]);
    /* At most twice the time of nothing. */
    const bool good =
        bench_measure(c, 4, b->settings.repeats, &b->status) &&
        report_pair(b, "process, warm", label, &c[0], &c[2], b->settings.size ? 0.0 : 0.5) &&
        report_pair(b, "process, cold", label, &c[1], &c[3], 0.0);
    bench_contenders_clear(c, 4);
    return good;
}

static bool measure_all(bench *b)
{
    char folder[BENCH_FOLDER_SIZE];
    if (!bench_folder_make(folder, &b->status))
        return false;
    const bool good = measure_mesh(b, folder) && measure_sphere(b, folder);
    if (getenv("BENCH_KEEP"))
        fprintf(stderr, "bench: files are in %s\n", folder);
    else
        bench_folder_remove(folder);
    return good;
}

int main(int argc, char **argv)
{
    return bench_main(argc, argv, measure_all);
}
