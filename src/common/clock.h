/* Wall time. */
#ifndef RT_COMMON_CLOCK_H
#define RT_COMMON_CLOCK_H

/* Seconds since some fixed moment; never goes back. */
double rt_clock_seconds(void);

#endif
