/* call_setting.h - how a call of long_calls.h is made. */
#ifndef MW_TESTS_SUPPORT_CALLS_CALL_SETTING_H
#define MW_TESTS_SUPPORT_CALLS_CALL_SETTING_H

#include "support/calls/call_inputs.h"

typedef struct call_setting {
    uint32_t threads;
    const mw_progress *progress;
} call_setting;

/* A call makes its result, adds what it holds to *sum, and releases it. If it fails, it checks that
 * nothing was handed out and what existed before is as it was, and ends the program otherwise. */
typedef mw_status long_call_run(const call_inputs *in, const call_setting *how, uint64_t *sum,
                                mw_error *error);

#endif
