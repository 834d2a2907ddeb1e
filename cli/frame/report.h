/* report.h - a report of named values, as aligned text or as one JSON object. */
#ifndef MW_CLI_FRAME_REPORT_H
#define MW_CLI_FRAME_REPORT_H

#include "cli/frame/text.h"

#include <stdint.h>

/* The name of a value is its key in JSON. In text its underscores become blanks. */
typedef struct report {
    text text;
    bool json;
    size_t values; /* added so far */
} report;

void report_begin(report *r, bool json);
void report_count(report *r, const char *name, uint64_t value);
void report_number(report *r, const char *name, double value); /* null in JSON if not finite */
/* A number that is not negative, rounded to three decimals. */
void report_rounded(report *r, const char *name, double value);
void report_numbers(report *r, const char *name, const double *values, size_t count);
void report_flag(report *r, const char *name, bool value); /* yes or no; true or false in JSON */
void report_string(report *r, const char *name, const char *value);
void report_strings(report *r, const char *name, char *const *values, size_t count);
void report_missing(report *r, const char *name, const char *why); /* null in JSON */
void report_end(report *r);

/* Add a JSON string to a text, with quotes and escapes. Bytes that are not UTF-8 are replaced. */
void report_quote(text *t, const char *value);

#endif
