#include <stdio.h>

#include "cli/actions.h"

bool rt_action_verify(rt_run *r, const rt_image *image)
{
    rt_image expected;
    if (!rt_image_init(&expected, image->width, image->height, true, &r->status))
        return false;
    /* The scalar path at the device's own precision. */
    if (!rt_run_draw_scalar(r, r->scene.accuracy == RT_ACCURACY_DOUBLE, &expected)) {
        rt_image_clear(&expected);
        return false;
    }
    const rt_image_difference d = rt_image_compare(image, &expected);
    rt_image_clear(&expected);
    printf("hit records that differ:         %zu of %zu\n"
           "pixels off by more than 1 step:  %zu\n"
           "largest difference:              %d steps\n"
           "root mean square difference:     %.6f steps\n"
           "pixels that are not finite:      %zu\n",
           d.hits, (size_t)image->width * (size_t)image->height, d.pixels, d.max_step, d.rms_step,
           d.non_finite);
    if (fflush(stdout) != 0)
        return rt_status_fail(&r->status, RT_ERROR_OUTPUT, "rt: cannot write standard output");
    if (d.first_x < 0)
        return true;
    /* What is not a number on either side has not been compared. */
    return rt_status_fail(&r->status, RT_DIFFERENT, "rt: %s, first at pixel %d,%d",
                          d.hits > 0 || d.pixels > 0 ? "the device and the scalar path differ"
                                                     : "there are pixels that are not finite",
                          d.first_x, d.first_y);
}
