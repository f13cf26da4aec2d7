#define _GNU_SOURCE
#include "study/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdbool.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static enum rt_plot_result run(int script)
{
    posix_spawn_file_actions_t actions;
    pid_t child = 0;
    int code = 0;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return RT_PLOT_FAILED;
    char name[] = "gnuplot";
    char *const arguments[] = {name, NULL};
    bool started =
        posix_spawn_file_actions_adddup2(&actions, script, STDIN_FILENO) == 0 &&
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0) == 0 &&
        posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO) == 0;
    const int error =
        started ? posix_spawnp(&child, name, &actions, NULL, arguments, environ) : EINVAL;
    posix_spawn_file_actions_destroy(&actions);
    if (error)
        return error == ENOENT ? RT_PLOT_NO_GNUPLOT : RT_PLOT_FAILED;
    while (waitpid(child, &code, 0) < 0)
        if (errno != EINTR)
            return RT_PLOT_FAILED;
    return WIFEXITED(code) && WEXITSTATUS(code) == 0 ? RT_PLOT_DRAWN : RT_PLOT_FAILED;
}

enum rt_plot_result rt_gnuplot_run(FILE *script)
{
    rewind(script); /* flushes; the child reads from the beginning */
    return ferror(script) ? RT_PLOT_FAILED : run(fileno(script));
}

enum rt_plot_result rt_gnuplot_try(void)
{
    FILE *script = tmpfile();
    if (!script)
        return RT_PLOT_FAILED;
    fputs("set terminal svg\nset terminal png\n", script);
    const enum rt_plot_result result = rt_gnuplot_run(script);
    fclose(script);
    return result;
}
