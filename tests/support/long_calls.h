/* long_calls.h - each public function that can take long, called on inputs of any size: for tests
 * that watch, cancel, share or repeat such calls. */
#ifndef MW_TESTS_SUPPORT_LONG_CALLS_H
#define MW_TESTS_SUPPORT_LONG_CALLS_H

#include "support/call_inputs.h"

typedef struct call_setting {
    uint32_t threads;
    const mw_progress *progress;
} call_setting;

/* A call makes its result, adds what it holds to *sum, and releases it. If it fails, it checks that
 * nothing was handed out and what existed before is as it was, and ends the program otherwise. */
typedef struct long_call {
    const char *name;
    mw_status (*run)(const call_inputs *in, const call_setting *how, uint64_t *sum,
                     mw_error *error);
} long_call;

extern const long_call long_calls[];
extern const size_t long_call_count;

#endif
