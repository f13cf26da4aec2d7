/* A folder for what a measurement writes. */
#ifndef BENCH_FOLDER_H
#define BENCH_FOLDER_H

#include <stdbool.h>

#include "common/status.h"

#define BENCH_FOLDER_SIZE 256

/* Makes a new one below TMPDIR, or /tmp, and writes its path to folder[0..BENCH_FOLDER_SIZE). */
bool bench_folder_make(char *folder, rt_status *status);
/* With all that is in it; one that is not there is nothing to remove. */
void bench_folder_remove(const char *folder);

#endif
