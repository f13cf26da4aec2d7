/* How far a computation of many parts is, and how long it will take, where what the parts take is
 * learnt on the way. */
#ifndef RT_STUDY_FORECAST_H
#define RT_STUDY_FORECAST_H

/* Work of a kind takes as long as there is of it. */
enum rt_work {
    RT_WORK_BUILD,     /* programs */
    RT_WORK_TRY,       /* tries of what comes: a study's first pictures */
    RT_WORK_RAYS,      /* the same rays through every level */
    RT_WORK_EDGES,     /* rays at edges */
    RT_WORK_REFERENCE, /* samples a pixel of reference pictures */
    RT_WORK_PICTURES,  /* samples a pixel of a picture at every level */
    RT_WORK_COUNT
};

/* All zero, but for `start`, where nothing is planned. */
typedef struct rt_forecast {
    double start;               /* as the times below, seconds by rt_clock_seconds */
    double left[RT_WORK_COUNT]; /* that is planned and not begun */
    double did[RT_WORK_COUNT], spent[RT_WORK_COUNT];
    double rate[RT_WORK_COUNT]; /* seconds of a unit, as long as nothing of the kind is done */
    enum rt_work kind;          /* of the part that runs */
    double amount, began;       /* of it; none where the amount is 0 */
    double told;                /* the most that has been told */
} rt_forecast;

/* Plans more of a kind, and takes back what is planned of it. */
void rt_forecast_plan(rt_forecast *f, enum rt_work kind, double amount);
void rt_forecast_drop(rt_forecast *f, enum rt_work kind, double amount);
/* Says what a unit is reckoned to take, until the first is done. */
void rt_forecast_expect(rt_forecast *f, enum rt_work kind, double seconds);
/* What a unit takes, as far as is known. */
double rt_forecast_rate(const rt_forecast *f, enum rt_work kind);

/* Begins a planned part, after the end of the one that ran. */
void rt_forecast_begin(rt_forecast *f, enum rt_work kind, double amount, double now);

/* The part of the whole, 0 to 1, that is done where so much of this part is: what has passed of the
 * time that all will take. It never goes back. */
double rt_forecast_done(rt_forecast *f, double done, double now);

#endif
