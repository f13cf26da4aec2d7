/* OpenCL devices: listed, chosen by what a user types, described. */
#ifndef RT_OPENCL_DEVICE_H
#define RT_OPENCL_DEVICE_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "common/accuracy.h"
#include "common/status.h"
#include "opencl/cl.h"

#define RT_DEVICE_TEXT 128

typedef struct rt_device {
    cl_platform_id platform;
    cl_device_id id;
    int index;                        /* in the list of all devices */
    int platform_index, device_index; /* "P:D" */
    cl_device_type type;
    char name[RT_DEVICE_TEXT];
    char platform_name[RT_DEVICE_TEXT];
    char version[RT_DEVICE_TEXT]; /* "OpenCL 3.0 ..." */
    char driver[RT_DEVICE_TEXT];
    cl_uint compute_units;
    cl_uint native_float_width;  /* 0 where the device does not tell */
    cl_uint native_double_width; /* 0 without fp64 too */
    bool has_fp64;
    bool rounds_divide_sqrt; /* correctly rounded fp32 division and square root on request */
} rt_device;

typedef struct rt_device_list {
    rt_device *devices; /* owned */
    size_t count, capacity;
} rt_device_list;

/* All devices of all platforms, in the order that the platforms give. Platforms without devices are
 * skipped; a machine without a platform gives an empty list, not an error. */
bool rt_device_list_read(rt_device_list *list, rt_status *status);
void rt_device_list_clear(rt_device_list *list);

/* The same beside other work: opening a runtime takes tens of milliseconds, most of them to load a
 * compiler, which a scene can be read in. Between the two calls the environment must not be
 * changed, and whoever begins must end. */
typedef struct rt_device_opening {
    pthread_t thread;
    bool has_begun, has_thread; /* without a thread the list is read at the end */
    bool good;
    rt_device_list list;
    rt_status status;
} rt_device_opening;

void rt_device_list_begin(rt_device_opening *opening);
/* As rt_device_list_read; reads it now where nothing has begun. */
bool rt_device_list_end(rt_device_opening *opening, rt_device_list *list, rt_status *status);

/* The device that `selector` names: NULL for the default (the first GPU, else the first CPU device,
 * else the first of all), an index, "P:D", "cpu", "gpu", "accelerator", or any part of a device's
 * or platform's name in any case. Returns NULL, with code RT_ERROR_DEVICE and a message that says
 * what there is, when none fits. */
const rt_device *rt_device_choose(const rt_device_list *list, const char *selector,
                                  rt_status *status);

/* The devices that a list of selectors names: NULL for the default, "all", or selectors as above
 * with commas between them. Fills chosen[0..list->count) in the order in which they are named, each
 * once however often it is named, and returns how many there are; 0 as NULL above. */
size_t rt_device_choose_list(const rt_device_list *list, const char *selectors,
                             const rt_device **chosen, rt_status *status);

/* "CPU", "GPU", "accelerator" or "other". */
const char *rt_device_type_name(const rt_device *device);

/* The lane width that suits the device at a level: its native width of float, or of double at the
 * level double, on anything but a GPU, rounded down to 1, 4, 8 or 16. */
int rt_device_lanes(const rt_device *device, enum rt_accuracy level);

/* Whether the device can compute at a level: double asks for fp64. Where it cannot, fails with
 * RT_ERROR_DEVICE and a message that says which levels it has. */
bool rt_device_check_level(const rt_device *device, enum rt_accuracy level, rt_status *status);

/* The table of `--list-devices`. */
void rt_device_list_print(const rt_device_list *list, FILE *out);

#endif
