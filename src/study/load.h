/* How busy a machine is with other work: how long this process's threads wait for a processor. */
#ifndef RT_STUDY_LOAD_H
#define RT_STUDY_LOAD_H

/* Seconds since each thread of this process began, all of them together: how long they have run,
 * and how long they could have run and did not, since all processors were taken. Both 0 where the
 * system does not tell. */
typedef struct rt_load {
    double ran, waited;
} rt_load;

rt_load rt_load_read(void);

/* The part of the time between two readings in which the threads that could run did, 0 to 1; 1
 * where nothing is known. */
double rt_load_share(const rt_load *before, const rt_load *after);

#endif
