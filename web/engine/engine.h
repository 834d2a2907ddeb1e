/* engine.h - what the files of the engine share. Their functions are called by web/js only: numbers
 * and addresses go in and out, and what a function allocates, JavaScript releases.
 *
 * A browser's module has one thread, so the error of the last call is a variable. */
#ifndef MW_WEB_ENGINE_H
#define MW_WEB_ENGINE_H

#include <meshwalk/meshwalk.h>

#define WEB_EXPORT(name) __attribute__((export_name(#name))) name

/* Of the last call that failed. */
extern mw_error web_error;

/* What a walk did: triangles, orientation tests, implicit tests, comparisons, rings, handovers. */
enum { WEB_COUNTERS = 6 };
void web_count(const mw_counters *c, double numbers[WEB_COUNTERS]);

#endif
