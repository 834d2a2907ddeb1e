/* report.h - a report of named values, as aligned text or as JSON. */
#ifndef CLI_REPORT_H
#define CLI_REPORT_H

#include "cli/frame/text.h"

#include <stdint.h>

/* In JSON a report is one object. The name of a value is its JSON key; in text its underscores become blanks. */
typedef struct report {
    text text;
    bool json;
    size_t values;
} report;

void report_begin(report *r, bool json);
void report_count(report *r, const char *name, uint64_t value);
void report_number(report *r, const char *name, double value); /* JSON null where it is not finite */
void report_numbers(report *r, const char *name, const double *values, size_t count);
void report_flag(report *r, const char *name, bool value); /* yes, no; true, false */
void report_string(report *r, const char *name, const char *value);
void report_strings(report *r, const char *name, char *const *values, size_t count);
void report_missing(report *r, const char *name, const char *why); /* JSON null */
void report_end(report *r);

/* A string with quotes and escapes, as JSON wants it; bytes that are no UTF-8 are replaced. */
void report_quote(text *t, const char *value);

#endif
