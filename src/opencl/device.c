#define _GNU_SOURCE
#include "opencl/device.h"

#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "common/array.h"
#include "common/number.h"
#include "opencl/cache.h"

#define PLATFORM_NOT_FOUND_KHR (-1001)

static bool read_text(cl_device_id id, cl_device_info what, char *text, rt_status *status)
{
    char *whole = NULL;
    size_t size = 0;
    if (!RT_CL(clGetDeviceInfo(id, what, 0, NULL, &size), status))
        return false;
    whole = calloc(size + 1, 1);
    if (!whole)
        return rt_status_no_memory(status, "a device's name");
    const bool good = RT_CL(clGetDeviceInfo(id, what, size, whole, NULL), status);
    const char *start = whole + strspn(whole, " ");
    snprintf(text, RT_DEVICE_TEXT, "%s", start);
    free(whole);
    return good;
}

static bool describe(rt_device *d, rt_status *status)
{
    cl_device_fp_config single = 0, twofold = 0;
    if (!read_text(d->id, CL_DEVICE_NAME, d->name, status) ||
        !read_text(d->id, CL_DEVICE_VERSION, d->version, status) ||
        !read_text(d->id, CL_DRIVER_VERSION, d->driver, status) ||
        !RT_CL(clGetDeviceInfo(d->id, CL_DEVICE_TYPE, sizeof d->type, &d->type, NULL), status) ||
        !RT_CL(clGetDeviceInfo(d->id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof d->compute_units,
                               &d->compute_units, NULL),
               status) ||
        !RT_CL(clGetDeviceInfo(d->id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT,
                               sizeof d->native_float_width, &d->native_float_width, NULL),
               status) ||
        !RT_CL(clGetDeviceInfo(d->id, CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE,
                               sizeof d->native_double_width, &d->native_double_width, NULL),
               status) ||
        !RT_CL(clGetDeviceInfo(d->id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof single, &single, NULL),
               status))
        return false;
    d->rounds_divide_sqrt = (single & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    /* Some drivers without fp64 answer this with an error: that too means none. */
    if (clGetDeviceInfo(d->id, CL_DEVICE_DOUBLE_FP_CONFIG, sizeof twofold, &twofold, NULL) ==
        CL_SUCCESS)
        d->has_fp64 = twofold != 0;
    return true;
}

static bool read_platform(rt_device_list *list, cl_platform_id platform, int platform_index,
                          rt_status *status)
{
    cl_uint count = 0;
    const cl_int error = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, NULL, &count);
    if (error == CL_DEVICE_NOT_FOUND || (error == CL_SUCCESS && count == 0))
        return true;
    if (!RT_CL_MADE(error, "clGetDeviceIDs", status))
        return false;
    cl_device_id *ids = calloc(count, sizeof *ids);
    if (!ids)
        return rt_status_no_memory(status, "devices");
    bool good = RT_CL(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, count, ids, NULL), status);
    for (cl_uint i = 0; good && i < count; ++i) {
        if (!RT_ARRAY_GROW(list->devices, list->count, &list->capacity)) {
            good = rt_status_no_memory(status, "devices");
            break;
        }
        rt_device *d = &list->devices[list->count];
        *d = (rt_device){.platform = platform,
                         .id = ids[i],
                         .index = (int)list->count,
                         .platform_index = platform_index,
                         .device_index = (int)i};
        good = RT_CL(clGetPlatformInfo(platform, CL_PLATFORM_NAME, RT_DEVICE_TEXT, d->platform_name,
                                       NULL),
                     status) &&
               describe(d, status);
        if (good)
            list->count++;
    }
    free(ids);
    return good;
}

/* PoCL's threads wander between processors unless they are pinned, and for the length of a tile two
 * of them share one: pinned, coherent rays take 0.6 of the time. It pins thread i to processor i
 * without looking, so this is done only where this process may run on all there are. */
static void pin_pocl_threads(void)
{
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    cpu_set_t set;
    if (online < 1 || online > CPU_SETSIZE || sched_getaffinity(0, sizeof set, &set) != 0)
        return;
    for (long i = 0; i < online; ++i)
        if (!CPU_ISSET((size_t)i, &set))
            return;
    setenv("POCL_AFFINITY", "1", 0);
}

/* How PoCL serves rt best, where the user has not said otherwise. The environment is its only ear.
 */
static void suit_pocl(void)
{
    pin_pocl_threads();
    /* Else it compiles every kernel for the size of its work-groups, again where the grid is large,
     * and again for any size when the program's binary is asked for, to be kept. The kernels are as
     * fast in this last form (ASSUME_GROUP), so that is the only one. */
    setenv("POCL_WORK_GROUP_SPECIALIZATION", "0", 0);
    rt_cache_suit_pocl();
}

static bool read_list(rt_device_list *list, rt_status *status)
{
    *list = (rt_device_list){NULL, 0, 0};
    cl_uint count = 0;
    const cl_int error = clGetPlatformIDs(0, NULL, &count);
    if (error == PLATFORM_NOT_FOUND_KHR || (error == CL_SUCCESS && count == 0))
        return true;
    if (!RT_CL_MADE(error, "clGetPlatformIDs", status))
        return false;
    cl_platform_id *platforms = calloc(count, sizeof *platforms);
    if (!platforms)
        return rt_status_no_memory(status, "platforms");
    bool good = RT_CL(clGetPlatformIDs(count, platforms, NULL), status);
    for (cl_uint i = 0; good && i < count; ++i)
        good = read_platform(list, platforms[i], (int)i, status);
    free(platforms);
    if (!good)
        rt_device_list_clear(list);
    return good;
}

bool rt_device_list_read(rt_device_list *list, rt_status *status)
{
    suit_pocl();
    return read_list(list, status);
}

static void *read_beside(void *argument)
{
    rt_device_opening *o = argument;
    o->good = read_list(&o->list, &o->status);
    return NULL;
}

void rt_device_list_begin(rt_device_opening *o)
{
    *o = (rt_device_opening){.has_begun = true, .status = RT_STATUS_INIT};
    suit_pocl();
    o->has_thread = pthread_create(&o->thread, NULL, read_beside, o) == 0;
}

bool rt_device_list_end(rt_device_opening *o, rt_device_list *list, rt_status *status)
{
    if (!o->has_begun)
        return rt_device_list_read(list, status);
    o->has_begun = false;
    if (o->has_thread)
        pthread_join(o->thread, NULL);
    else
        read_beside(o);
    *list = o->list;
    /* Without the last newline, which the caller's status adds. */
    const int length = o->status.length ? (int)o->status.length - 1 : 0;
    if (!o->good)
        rt_status_fail(status, o->status.code, "%.*s", length,
                       o->status.text ? o->status.text : "");
    rt_status_clear(&o->status);
    return o->good;
}

void rt_device_list_clear(rt_device_list *list)
{
    free(list->devices);
    *list = (rt_device_list){NULL, 0, 0};
}

static const rt_device *first_of_type(const rt_device_list *list, cl_device_type type)
{
    for (size_t i = 0; i < list->count; ++i)
        if (list->devices[i].type & type)
            return &list->devices[i];
    return NULL;
}

/* "INDEX" or "P:D"; NULL where there is no such device. */
static const rt_device *find_number(const rt_device_list *list, const char *selector)
{
    const char *colon = strchr(selector, ':');
    const size_t first_length = colon ? (size_t)(colon - selector) : strlen(selector);
    int64_t first = -1, second = -1;
    if (rt_number_int(selector, first_length, &first) != RT_NUMBER_OK ||
        (colon && rt_number_int(colon + 1, strlen(colon + 1), &second) != RT_NUMBER_OK))
        return NULL;
    for (size_t i = 0; i < list->count; ++i) {
        const rt_device *d = &list->devices[i];
        if (colon ? d->platform_index == first && d->device_index == second : d->index == first)
            return d;
    }
    return NULL;
}

/* Never NULL for a list that is not empty. */
static const rt_device *find_default(const rt_device_list *list)
{
    const rt_device *d = first_of_type(list, CL_DEVICE_TYPE_GPU);
    if (!d)
        d = first_of_type(list, CL_DEVICE_TYPE_CPU);
    return d ? d : list->devices;
}

static const rt_device *find(const rt_device_list *list, const char *selector)
{
    if (strcasecmp(selector, "cpu") == 0)
        return first_of_type(list, CL_DEVICE_TYPE_CPU);
    if (strcasecmp(selector, "gpu") == 0)
        return first_of_type(list, CL_DEVICE_TYPE_GPU);
    if (strcasecmp(selector, "accelerator") == 0)
        return first_of_type(list, CL_DEVICE_TYPE_ACCELERATOR);
    if (selector[strspn(selector, "0123456789:")] == '\0')
        return find_number(list, selector);
    for (size_t i = 0; i < list->count; ++i)
        if (strcasestr(list->devices[i].name, selector) ||
            strcasestr(list->devices[i].platform_name, selector))
            return &list->devices[i];
    return NULL;
}

const rt_device *rt_device_choose(const rt_device_list *list, const char *selector,
                                  rt_status *status)
{
    if (list->count == 0) {
        rt_status_fail(status, RT_ERROR_DEVICE,
                       "rt: no OpenCL device; install one (on Debian: apt-get install "
                       "pocl-opencl-icd), or use --device scalar");
        return NULL;
    }
    if (!selector)
        return find_default(list);
    const rt_device *d = find(list, selector);
    if (d)
        return d;
    rt_status_fail(status, RT_ERROR_DEVICE, "rt: no device fits '%s'; there are:", selector);
    for (size_t i = 0; i < list->count; ++i)
        rt_status_warn(status, "  %d  %d:%d  %s (%s)", list->devices[i].index,
                       list->devices[i].platform_index, list->devices[i].device_index,
                       list->devices[i].name, rt_device_type_name(&list->devices[i]));
    return NULL;
}

static size_t add_once(const rt_device **chosen, size_t count, const rt_device *device)
{
    for (size_t i = 0; i < count; ++i)
        if (chosen[i] == device)
            return count;
    chosen[count] = device;
    return count + 1;
}

size_t rt_device_choose_list(const rt_device_list *list, const char *selectors,
                             const rt_device **chosen, rt_status *status)
{
    size_t count = 0;
    if (selectors && strcasecmp(selectors, "all") == 0 && list->count > 0) {
        for (; count < list->count; ++count)
            chosen[count] = &list->devices[count];
        return count;
    }
    /* A device's whole name may have a comma of its own. */
    if (!selectors || !strchr(selectors, ',') || find(list, selectors)) {
        chosen[0] = rt_device_choose(list, selectors, status);
        return chosen[0] ? 1 : 0;
    }
    for (const char *next = selectors; next;) {
        next += strspn(next, " ");
        const char *comma = strchr(next, ',');
        char *selector = comma ? strndup(next, (size_t)(comma - next)) : strdup(next);
        if (!selector) {
            rt_status_no_memory(status, "devices");
            return 0;
        }
        const rt_device *device = rt_device_choose(list, selector, status);
        free(selector);
        if (!device)
            return 0;
        count = add_once(chosen, count, device);
        next = comma ? comma + 1 : NULL;
    }
    return count;
}

const char *rt_device_type_name(const rt_device *device)
{
    if (device->type & CL_DEVICE_TYPE_GPU)
        return "GPU";
    if (device->type & CL_DEVICE_TYPE_CPU)
        return "CPU";
    return device->type & CL_DEVICE_TYPE_ACCELERATOR ? "accelerator" : "other";
}

bool rt_device_check_level(const rt_device *device, enum rt_accuracy level, rt_status *status)
{
    if (level != RT_ACCURACY_DOUBLE || device->has_fp64)
        return true;
    return rt_status_fail(status, RT_ERROR_DEVICE,
                          "rt: %s has no double precision (fp64); its levels of accuracy are %s, "
                          "%s and %s",
                          device->name, rt_accuracy_name(RT_ACCURACY_FAST),
                          rt_accuracy_name(RT_ACCURACY_STANDARD),
                          rt_accuracy_name(RT_ACCURACY_ROBUST));
}

int rt_device_lanes(const rt_device *device, enum rt_accuracy level)
{
    if (device->type & CL_DEVICE_TYPE_GPU)
        return 1;
    const cl_uint width =
        level == RT_ACCURACY_DOUBLE ? device->native_double_width : device->native_float_width;
    return width >= 16 ? 16 : width >= 8 ? 8 : width >= 4 ? 4 : 1;
}

void rt_device_list_print(const rt_device_list *list, FILE *out)
{
    fprintf(out, "%-5s  %-3s  %-11s  %-13s  %5s  %5s  %-4s  %s\n", "index", "P:D", "type",
            "version", "units", "width", "fp64", "name");
    for (size_t i = 0; i < list->count; ++i) {
        const rt_device *d = &list->devices[i];
        /* "OpenCL 3.0 vendor's words": the standard fixes the first two. */
        const char *rest = strchr(d->version, ' ');
        rest = rest ? strchr(rest + 1, ' ') : NULL;
        const int version = rest ? (int)(rest - d->version) : (int)strlen(d->version);
        fprintf(out, "%-5d  %d:%d  %-11s  %-13.*s  %5u  %5u  %-4s  %s [%s]\n", d->index,
                d->platform_index, d->device_index, rt_device_type_name(d), version, d->version,
                d->compute_units, d->native_float_width, d->has_fp64 ? "yes" : "no", d->name,
                d->platform_name);
    }
}
