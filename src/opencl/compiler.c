#define _GNU_SOURCE
#include "opencl/compiler.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "common/file.h"
#include "common/parallel.h"
#include "opencl/cache.h"
#include "opencl/program.h"

#define MILLISECONDS_A_TICK 100

extern char **environ;

static const char *compiler;

void rt_compiler_set(const char *executable)
{
    compiler = executable;
}

/* A folder for what PoCL writes while it compiles: it leaves that behind where it is killed. The
 * processes have it in the place of PoCL's cache, of which they have no need. */
typedef struct workshop {
    char *variable; /* owned: "POCL_CACHE_DIR=..." */
    const char *folder;
    char **environment; /* owned; its strings are the process's but for the variable */
} workshop;

#define VARIABLE "POCL_CACHE_DIR="

static void close_workshop(workshop *w)
{
    if (w->folder)
        rt_file_remove_tree(w->folder);
    free(w->environment);
    free(w->variable);
}

/* False where there is no place for it. */
static bool open_workshop(workshop *w)
{
    char *cache = rt_cache_folder();
    size_t count = 0;
    *w = (workshop){NULL, NULL, NULL};
    if (!cache || asprintf(&w->variable, VARIABLE "%s/" RT_CACHE_COMPILING "XXXXXX", cache) < 0)
        w->variable = NULL;
    free(cache);
    while (environ[count])
        ++count;
    w->environment = calloc(count + 2, sizeof *w->environment);
    if (!w->variable || !w->environment || !(w->folder = mkdtemp(w->variable + strlen(VARIABLE)))) {
        close_workshop(w);
        return false;
    }
    w->environment[0] = w->variable;
    for (size_t i = 0, to = 1; i < count; ++i)
        if (strncmp(environ[i], VARIABLE, strlen(VARIABLE)) != 0)
            w->environment[to++] = environ[i];
    return true;
}

/* A process at work; `end` is readable once it is over, and -1 from then on. */
typedef struct child {
    pid_t process;
    int end;
} child;

/* Without output, since whoever waits says what went wrong when it tries itself; in a group of its
 * own, for Ctrl-C is the waiting process's to answer. The other end of its pipe is its standard
 * output, and the first of the three to be set: the pipe may lie where another was closed. */
static bool spawn(child *c, char *const arguments[], char *const environment[], int output)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&files) != 0)
        return false;
    if (posix_spawnattr_init(&attributes) != 0) {
        posix_spawn_file_actions_destroy(&files);
        return false;
    }
    const bool good =
        posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO) == 0 &&
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0) == 0 &&
        posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0) == 0 &&
        posix_spawnattr_setpgroup(&attributes, 0) == 0 &&
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP) == 0 &&
        posix_spawn(&c->process, compiler, &files, &attributes, arguments, environment) == 0;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return good;
}

static bool begin(child *c, const rt_device *device, const char *options, char *const environment[])
{
    char selector[32], call[] = RT_COMPILER_CALL, name[RT_DEVICE_TEXT];
    int ends[2];
    snprintf(selector, sizeof selector, "%d:%d", device->platform_index, device->device_index);
    memcpy(name, device->name, sizeof name);
    char *own = strdup(options);
    char *const arguments[] = {call, call, selector, name, own, NULL};
    if (!own || pipe2(ends, O_CLOEXEC) != 0) {
        free(own);
        return false;
    }
    const bool good = spawn(c, arguments, environment, ends[1]);
    free(own);
    close(ends[1]);
    if (!good)
        close(ends[0]);
    c->end = good ? ends[0] : -1;
    return good;
}

static void finish(child *c)
{
    while (waitpid(c->process, NULL, 0) < 0 && errno == EINTR)
        ;
    close(c->end);
    c->end = -1;
}

/* Programs to compile, so many at a time as there are processors. */
typedef struct queue {
    const rt_device *device;
    const char *const *options; /* `count` */
    size_t count, next, running;
    child children[RT_COMPILER_MOST]; /* `end` is -1 where none is at work */
    size_t room;
    char **environment;
} queue;

/* Begins with what comes next, where there is room. */
static void fill(queue *q)
{
    for (size_t i = 0; i < q->room; ++i)
        while (q->children[i].end < 0 && q->next < q->count) {
            const char *options = q->options[q->next++];
            if (rt_program_can_be_kept(q->device, options) &&
                begin(&q->children[i], q->device, options, q->environment))
                ++q->running;
        }
}

/* Lets those go that are over; waits for one, a tick at most. */
static void wait_for(queue *q)
{
    struct pollfd ends[RT_COMPILER_MOST];
    for (size_t i = 0; i < q->room; ++i)
        ends[i] = (struct pollfd){q->children[i].end, POLLIN, 0};
    if (poll(ends, (nfds_t)q->room, MILLISECONDS_A_TICK) <= 0)
        return;
    for (size_t i = 0; i < q->room; ++i)
        if (q->children[i].end >= 0 && ends[i].revents) {
            finish(&q->children[i]);
            --q->running;
        }
}

static void stop(queue *q)
{
    for (size_t i = 0; i < q->room; ++i)
        if (q->children[i].end >= 0) {
            kill(-q->children[i].process, SIGKILL);
            finish(&q->children[i]);
        }
}

static size_t room_for(size_t count)
{
    const size_t processors = (size_t)rt_parallel_processors();
    const size_t room = processors < RT_COMPILER_MOST ? processors : RT_COMPILER_MOST;
    return room < count ? room : count;
}

bool rt_compiler_run(const rt_device *device, const char *const *options, size_t count,
                     const rt_watch *watch, rt_status *status)
{
    queue q = {.device = device, .options = options, .count = count, .room = room_for(count)};
    bool goes_on = true;
    workshop w;
    if (!compiler || count == 0 || !open_workshop(&w))
        return true;
    q.environment = w.environment;
    for (size_t i = 0; i < q.room; ++i)
        q.children[i].end = -1;
    for (fill(&q); goes_on && q.running > 0; fill(&q)) {
        goes_on = rt_watch_tick(watch, (double)(q.next - q.running) / (double)count);
        if (goes_on)
            wait_for(&q);
        else
            q.next = count;
    }
    if (!goes_on)
        stop(&q);
    close_workshop(&w);
    return goes_on || rt_status_fail(status, RT_INTERRUPTED, "rt: interrupted");
}

int rt_compiler_main(char *const arguments[RT_COMPILER_ARGUMENTS])
{
    const char *device = arguments[0], *name = arguments[1], *options = arguments[2];
    rt_device_list devices = {0};
    rt_status status = RT_STATUS_INIT;
    cl_int error = CL_SUCCESS;
    /* Nobody waits for what a process that was killed has asked for. */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rt_device *chosen =
        rt_device_list_read(&devices, &status) ? rt_device_choose(&devices, device, &status) : NULL;
    if (chosen && strcmp(chosen->name, name) != 0)
        chosen = NULL;
    cl_context context = chosen ? clCreateContext(NULL, 1, &chosen->id, NULL, NULL, &error) : NULL;
    cl_program program =
        context && error == CL_SUCCESS ? rt_program_build(context, chosen, options, &status) : NULL;
    if (program)
        clReleaseProgram(program);
    if (context)
        clReleaseContext(context);
    rt_device_list_clear(&devices);
    rt_status_clear(&status);
    return program ? 0 : 1;
}
