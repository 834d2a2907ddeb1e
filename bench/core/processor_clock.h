/* processor_clock.h - the time of the processor, which what else a machine does hardly changes. */
#ifndef MW_BENCH_CORE_PROCESSOR_CLOCK_H
#define MW_BENCH_CORE_PROCESSOR_CLOCK_H

/* Seconds of the processor that this process has used, in all its threads. */
double processor_seconds(void);

#endif
