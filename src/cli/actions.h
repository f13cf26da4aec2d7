/* What rt does, an action a file: action_render.c, action_study.c, ... Each returns false after an
 * error, which is in the run's status; main.c ends the run. */
#ifndef RT_CLI_ACTIONS_H
#define RT_CLI_ACTIONS_H

#include "cli/run.h"

/* Renders the scene and writes the picture, its hit records and what it took. */
bool rt_action_render(rt_run *run);

/* A part of rendering: prints how far a picture that devices have drawn is from the scalar path's.
 * False with code RT_DIFFERENT where they differ in a way that they must not. */
bool rt_action_verify(rt_run *run, const rt_image *image);

/* Renders the scene at every level and writes what that costs. */
bool rt_action_study(rt_run *run);

/* Makes the report anew from the figures of an earlier study. */
bool rt_action_plot(rt_run *run);

/* Tells what the scene calls for and, unless told not to, what that costs. */
bool rt_action_explain(rt_run *run);

/* Lists the devices. */
bool rt_action_list(rt_run *run);

/* Compiles for the chosen devices what scenes have in common. */
bool rt_action_prepare(rt_run *run);

/* Tells what is kept of built programs; removes it. */
bool rt_action_cache(rt_run *run);
bool rt_action_cache_clear(rt_run *run);

#endif
