/* Pictures that show nothing, and why. */
#ifndef RT_CLI_PICTURE_CHECK_H
#define RT_CLI_PICTURE_CHECK_H

#include "cli/run.h"

/* Warns, unless the run is quiet, where no primary ray of the picture hits anything, and where what
 * they hit is black although the scene itself did not look like it. Most pictures are known not to
 * be so after a few of their pixels; only one that is black or all background, and that has no hit
 * records, is drawn again with them, by a sample or two a pixel. False after an error. */
bool rt_run_check_picture(rt_run *run, const rt_image *image);

#endif
