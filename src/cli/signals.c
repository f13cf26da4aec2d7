#define _GNU_SOURCE
#include "cli/signals.h"

#include <signal.h>
#include <stdatomic.h>
#include <stddef.h>

/* Lock-free, so that a handler may set it, and threads may read it. */
static atomic_int was_interrupted;

static void on_signal(int signal_number)
{
    (void)signal_number;
    was_interrupted = 1;
}

void rt_signals_catch(void)
{
    struct sigaction action = {.sa_handler = on_signal};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    /* A reader that has gone away is an error of write(), with a message and an exit code. */
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, NULL);
}

bool rt_signals_have_come(void)
{
    return was_interrupted;
}

static bool keep_going(void *context, double done)
{
    (void)context;
    (void)done;
    return !was_interrupted;
}

const rt_watch rt_signals_watch = {keep_going, NULL};
