/* Wall time. */
#ifndef RT_CLOCK_H
#define RT_CLOCK_H

/* Seconds since some fixed moment; never goes back. */
double rt_clock_seconds(void);

#endif
