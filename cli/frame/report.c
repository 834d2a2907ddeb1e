#include "cli/frame/report.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#define LABEL_WIDTH 22

void report_begin(report *r, bool json)
{
    *r = (report){.json = json};
    if (json) text_string(&r->text, "{");
}

static void report_begin_value(report *r, const char *name)
{
    if (r->json) {
        text_string(&r->text, r->values++ ? ",\n " : "\n ");
        report_quote(&r->text, name);
        text_string(&r->text, ": ");
        return;
    }
    size_t length = strlen(name);
    for (size_t i = 0; i < length; i++) text_bytes(&r->text, name[i] == '_' ? " " : name + i, 1);
    for (size_t i = length; i < LABEL_WIDTH; i++) text_string(&r->text, " ");
}

static void report_end_value(report *r)
{
    if (!r->json) text_string(&r->text, "\n");
}

static void report_write_number(report *r, double value)
{
    if (r->json && !isfinite(value))
        text_string(&r->text, "null");
    else
        text_double(&r->text, value);
}

void report_count(report *r, const char *name, uint64_t value)
{
    report_begin_value(r, name);
    text_printf(&r->text, "%" PRIu64, value);
    report_end_value(r);
}

void report_number(report *r, const char *name, double value)
{
    report_begin_value(r, name);
    report_write_number(r, value);
    report_end_value(r);
}

void report_rounded(report *r, const char *name, double value)
{
    report_number(r, name, (double)(int64_t)(value * 1000 + 0.5) / 1000);
}

void report_numbers(report *r, const char *name, const double *values, size_t count)
{
    report_begin_value(r, name);
    if (r->json) text_string(&r->text, "[");
    for (size_t i = 0; i < count; i++) {
        if (i) text_string(&r->text, r->json ? ", " : " ");
        report_write_number(r, values[i]);
    }
    if (r->json) text_string(&r->text, "]");
    report_end_value(r);
}

void report_flag(report *r, const char *name, bool value)
{
    report_begin_value(r, name);
    text_string(&r->text, r->json ? (value ? "true" : "false") : value ? "yes" : "no");
    report_end_value(r);
}

void report_string(report *r, const char *name, const char *value)
{
    report_begin_value(r, name);
    if (r->json)
        report_quote(&r->text, value);
    else
        text_string(&r->text, value);
    report_end_value(r);
}

void report_strings(report *r, const char *name, char *const *values, size_t count)
{
    report_begin_value(r, name);
    if (r->json) text_string(&r->text, "[");
    for (size_t i = 0; i < count; i++) {
        if (i) text_string(&r->text, ", ");
        if (r->json)
            report_quote(&r->text, values[i]);
        else
            text_string(&r->text, values[i]);
    }
    if (r->json) text_string(&r->text, "]");
    if (!r->json && count == 0) text_string(&r->text, "none");
    report_end_value(r);
}

void report_missing(report *r, const char *name, const char *why)
{
    report_begin_value(r, name);
    text_string(&r->text, r->json ? "null" : why);
    report_end_value(r);
}

void report_end(report *r)
{
    if (r->json) text_string(&r->text, "\n}\n");
}

void report_quote(text *t, const char *value)
{
    const unsigned char *s = (const unsigned char *)value;
    text_string(t, "\"");
    while (*s) {
        size_t length = text_utf8_length(s);
        if (length == 0)
            text_string(t, "\\ufffd");
        else if (*s == '"' || *s == '\\')
            text_printf(t, "\\%c", *s);
        else if (*s < 0x20)
            text_printf(t, "\\u%04x", *s);
        else
            text_bytes(t, (const char *)s, length);
        s += length ? length : 1;
    }
    text_string(t, "\"");
}
