/* monotonic_clock.h - the clock that all times of the program are taken with. */
#ifndef MW_CLI_FRAME_MONOTONIC_CLOCK_H
#define MW_CLI_FRAME_MONOTONIC_CLOCK_H

/* Seconds of a clock that only goes forward. Only differences between two calls have a meaning. */
double monotonic_seconds(void);

#endif
