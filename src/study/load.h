/* How busy a machine is with other work, as far as this process notices. */
#ifndef RT_STUDY_LOAD_H
#define RT_STUDY_LOAD_H

/* Seconds since some moment, of all threads of this process or of all processors together. All 0
 * where the system does not tell. */
typedef struct rt_load {
    double ran, waited; /* this process's threads: on a processor; in the queue of one */
    double busy;        /* processors, with whatever program */
    double stolen;      /* processors that the machine's host gave to other machines */
    double all;         /* processors, idle or not */
} rt_load;

rt_load rt_load_read(void);

/* The part of the time between two readings, 0 to 1, in which others held the processors that this
 * process's threads were ready to run on. That they wait for each other does not count, nor that
 * others use processors which they do not wait for. */
double rt_load_held(const rt_load *before, const rt_load *after);

#endif
