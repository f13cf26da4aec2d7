#include <stdio.h>

#include "cli/actions.h"

bool rt_action_list(rt_run *r)
{
    if (!rt_device_list_read(&r->devices, &r->status))
        return false;
    if (r->devices.count == 0)
        return rt_device_choose(&r->devices, NULL, &r->status) != NULL;
    rt_device_list_print(&r->devices, stdout);
    return true;
}
