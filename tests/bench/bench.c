#include "bench/bench.h"

#include <stdio.h>

bool bench_find_device(bench *b)
{
    if (b->device)
        return true;
    if (!rt_device_list_read(&b->devices, &b->status))
        return false;
    b->device = rt_device_choose(&b->devices, b->settings.device, &b->status);
    if (b->device && (int)b->device->compute_units != b->settings.threads)
        fprintf(stderr, "bench: %s has %u compute units, the others get %d threads\n",
                b->device->name, (unsigned)b->device->compute_units, b->settings.threads);
    return b->device != NULL;
}

int bench_main(int argc, char **argv, bool (*measure)(bench *))
{
    bench b = {.status = RT_STATUS_INIT};
    bool good = bench_settings_read(&b.settings, argc, argv, &b.status);
    if (good && b.settings.help) {
        bench_settings_help(argv[0]);
        return RT_OK;
    }
    /* Written once before the work too: a file that cannot be written is known at once. */
    good = good && bench_report_open(&b.report, b.settings.json, &b.status) &&
           bench_report_write(&b.report, &b.status) && measure(&b);
    /* What was measured before an error is still worth having. */
    if (b.report.root && b.status.code != RT_ERROR_OUTPUT)
        good = bench_report_write(&b.report, &b.status) && good;
    if (good && !b.report.agrees)
        good = rt_status_fail(&b.status, RT_DIFFERENT, "bench: hit counts differ");
    if (b.status.text)
        fputs(b.status.text, stderr);
    bench_report_close(&b.report);
    rt_device_list_clear(&b.devices);
    const enum rt_code code = good ? RT_OK : b.status.code;
    rt_status_clear(&b.status);
    return (int)code;
}
