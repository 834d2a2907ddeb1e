/* machine.h - where and when a figure was measured. */
#ifndef MW_BENCH_CORE_MACHINE_H
#define MW_BENCH_CORE_MACHINE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The name of the processor, cut to `size` bytes; "unknown processor" where the system does not
 * tell it. */
void machine_processor(char *name, size_t size);

/* Today in UTC, as 2026-11-22. */
typedef char machine_date_text[32];
void machine_date(machine_date_text date);

#ifdef __cplusplus
}
#endif

#endif
