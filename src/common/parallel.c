#define _GNU_SOURCE
#include "common/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdbool.h>

#define THREADS_MAX 256

typedef struct loop {
    void (*round)(void *context, size_t i);
    void *context;
    size_t count;
    atomic_size_t next;
} loop;

static void *work(void *argument)
{
    loop *l = argument;
    for (;;) {
        const size_t i = atomic_fetch_add(&l->next, 1);
        if (i >= l->count)
            return NULL;
        l->round(l->context, i);
    }
}

void rt_parallel(size_t count, int threads, void (*round)(void *context, size_t i), void *context)
{
    loop l = {.round = round, .context = context, .count = count};
    pthread_t helpers[THREADS_MAX];
    size_t wanted = threads < 1 ? 0 : (size_t)threads - 1, started = 0;
    if (wanted >= count)
        wanted = count ? count - 1 : 0;
    if (wanted > THREADS_MAX)
        wanted = THREADS_MAX;
    while (started < wanted && pthread_create(&helpers[started], NULL, work, &l) == 0)
        ++started;
    work(&l);
    for (size_t i = 0; i < started; ++i)
        pthread_join(helpers[i], NULL);
}

int rt_parallel_processors(void)
{
    cpu_set_t set;
    const int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return count > 0 ? count : 1;
}
