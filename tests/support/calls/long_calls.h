/* long_calls.h - each public function that can take long, called on inputs of any size: for tests
 * that watch, cancel, share or repeat such calls. */
#ifndef MW_TESTS_SUPPORT_CALLS_LONG_CALLS_H
#define MW_TESTS_SUPPORT_CALLS_LONG_CALLS_H

#include "support/calls/call_setting.h"

typedef struct long_call {
    const char *name;
    long_call_run *run;
} long_call;

extern const long_call long_calls[];
extern const size_t long_call_count;

#endif
