#include "study/forecast.h"

/* A part tells what it will take once so much of it is done. */
#define TELLING 0.02

static double least(double a, double b)
{
    return a < b ? a : b;
}

static double most(double a, double b)
{
    return a > b ? a : b;
}

void rt_forecast_plan(rt_forecast *f, enum rt_work kind, double amount)
{
    f->left[kind] += amount;
}

void rt_forecast_drop(rt_forecast *f, enum rt_work kind, double amount)
{
    f->left[kind] = most(f->left[kind] - amount, 0.0);
}

void rt_forecast_expect(rt_forecast *f, enum rt_work kind, double seconds)
{
    f->rate[kind] = seconds;
}

double rt_forecast_rate(const rt_forecast *f, enum rt_work kind)
{
    return f->did[kind] > 0.0 ? f->spent[kind] / f->did[kind] : f->rate[kind];
}

void rt_forecast_begin(rt_forecast *f, enum rt_work kind, double amount, double now)
{
    f->did[f->kind] += f->amount;
    f->spent[f->kind] += f->amount > 0.0 ? now - f->began : 0.0;
    f->kind = kind;
    f->amount = amount;
    f->began = now;
    rt_forecast_drop(f, kind, amount);
}

double rt_forecast_done(rt_forecast *f, double done, double now)
{
    const double passed = now - f->start, here = now - f->began;
    /* A unit of this kind: as those before it, or as this part is so far, or longer if it is. */
    double rate = rt_forecast_rate(f, f->kind);
    if (f->amount > 0.0 && done > TELLING)
        rate = (f->spent[f->kind] + here) / (f->did[f->kind] + done * f->amount);
    else if (f->amount > 0.0)
        rate = most(rate, here / f->amount);
    double left = f->amount * most(1.0 - done, 0.0) * rate;
    for (int kind = 0; kind < RT_WORK_COUNT; ++kind)
        left += f->left[kind] *
                ((enum rt_work)kind == f->kind ? rate : rt_forecast_rate(f, (enum rt_work)kind));
    const double all = passed + left;
    f->told = most(f->told, all > 0.0 ? least(passed / all, 1.0) : 0.0);
    return f->told;
}
