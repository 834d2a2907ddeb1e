/* tile_index.c - writes the index of a mesh in tiles. Its checksum is that of the text that
 * Python's json.dumps makes of all other members in the order of their names, so numbers and blanks
 * are as there. */
#include "prepared/tiles/tile_index.h"
#include "io/text/number_text.h"
#include "prepared/tiles/blake2b.h"

#include <inttypes.h>
#include <math.h>
#include <meshwalk/io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- numbers ---------------------------------------------------------------------------------- */

/* The digits of a number, the first of which stands for 10^exponent. */
typedef struct number_digits {
    char digit[24];
    int count, exponent;
} number_digits;

/* The number with so many digits, rounded. The point of snprintf depends on the locale. */
static number_digits digits_round(double value, int count)
{
    char text[48];
    number_digits d = {.count = 0};
    snprintf(text, sizeof text, "%.*e", count - 1, value);
    const char *p = text;
    for (; *p != 'e'; p++)
        if (*p >= '0' && *p <= '9') d.digit[d.count++] = *p;
    d.exponent = (int)strtol(p + 1, NULL, 10);
    return d;
}

static double digits_value(const number_digits *d)
{
    char text[48];
    double value = 0;
    snprintf(text, sizeof text, "%se%d", d->digit, d->exponent - d->count + 1);
    mw__read_double(text, &value);
    return value;
}

void mw__tile_number_write(double value, char *text)
{
    enum { MOST_DIGITS = 17, LEAST_EXPONENT = -4, FIXED_BELOW = 16 };
    if (signbit(value)) *text++ = '-';
    value = fabs(value);
    number_digits d = digits_round(value, 1);
    for (int count = 2; count <= MOST_DIGITS && digits_value(&d) != value; count++)
        d = digits_round(value, count);
    if (d.exponent < LEAST_EXPONENT || d.exponent >= FIXED_BELOW) {
        const char *more = d.digit + 1;
        sprintf(text, "%c%s%se%+03d", d.digit[0], *more ? "." : "", more, d.exponent);
        return;
    }
    if (d.exponent < 0) text += sprintf(text, "0.%.*s", -d.exponent - 1, "000");
    for (int i = 0; i < d.count || i <= d.exponent; i++) {
        *text++ = i < d.count ? d.digit[i] : '0';
        if (i == d.exponent) *text++ = '.';
    }
    if (d.count <= d.exponent + 1) *text++ = '0'; /* behind the point */
    *text = 0;
}

/* --- members ---------------------------------------------------------------------------------- */

/* Takes the next bytes of the text. */
typedef struct text_sink {
    mw_output *output;
    mw_blake2b *hash; /* instead of the output */
} text_sink;

static void sink_text(const text_sink *to, const char *text)
{
    if (to->hash)
        mw__blake2b_add(to->hash, text, strlen(text));
    else
        mw_output_write(to->output, text, strlen(text));
}

static void sink_integer(const text_sink *to, int64_t value)
{
    char text[32];
    snprintf(text, sizeof text, "%" PRId64, value);
    sink_text(to, text);
}

static void sink_holes(const text_sink *to, const mw_tile_index *index)
{
    for (size_t i = 0; i < index->hole_count; i++) {
        if (i > 0) sink_text(to, ", ");
        sink_integer(to, index->holes[i]);
    }
}

static void sink_checksums(const text_sink *to, const mw_tile_index *index)
{
    char text[32];
    for (uint32_t i = 0; i < index->cuts->tiles + 1; i++) {
        snprintf(text, sizeof text, "%s\"%016" PRIx64 "\"", i ? ", " : "", index->checksums[i]);
        sink_text(to, text);
    }
}

static void sink_cuts(const text_sink *to, const mw_tile_index *index)
{
    for (uint32_t i = 0; i < index->cuts->cuts; i++) {
        const mw_tile_cut *cut = &index->cuts->cut[i];
        char number[32], text[160];
        int used = snprintf(text, sizeof text, "%s[%d, ", i ? ", " : "", cut->axis);
        mw__tile_number_write(cut->low_ends, number);
        used += snprintf(text + used, sizeof text - (size_t)used, "%s, ", number);
        mw__tile_number_write(cut->high_begins, number);
        snprintf(text + used, sizeof text - (size_t)used, "%s, %" PRId64 ", %" PRId64 "]", number,
                 cut->low, cut->high);
        sink_text(to, text);
    }
}

typedef enum index_member {
    INDEX_FORMAT,
    INDEX_VERSION,
    INDEX_VERTICES,
    INDEX_TRIANGLES,
    INDEX_HOLES,
    INDEX_CHECKSUMS,
    INDEX_CUTS,
    INDEX_MEMBERS
} index_member;

static void sink_member(const text_sink *to, const mw_tile_index *index, index_member member)
{
    switch (member) {
    case INDEX_FORMAT: sink_text(to, "\"format\": \"meshwalk tiles\""); break;
    case INDEX_VERSION: sink_text(to, "\"version\": 1"); break;
    case INDEX_VERTICES:
        sink_text(to, "\"vertices\": ");
        sink_integer(to, index->vertices);
        break;
    case INDEX_TRIANGLES:
        sink_text(to, "\"triangles\": ");
        sink_integer(to, index->triangles);
        break;
    case INDEX_HOLES:
        sink_text(to, "\"holes\": [");
        sink_holes(to, index);
        sink_text(to, "]");
        break;
    case INDEX_CHECKSUMS:
        sink_text(to, "\"checksums\": [");
        sink_checksums(to, index);
        sink_text(to, "]");
        break;
    case INDEX_CUTS:
        sink_text(to, "\"cuts\": [");
        sink_cuts(to, index);
        sink_text(to, "]");
        break;
    case INDEX_MEMBERS: break;
    }
}

static void sink_members(const text_sink *to, const mw_tile_index *index,
                         const index_member order[INDEX_MEMBERS])
{
    sink_text(to, "{");
    for (int i = 0; i < INDEX_MEMBERS; i++) {
        if (i > 0) sink_text(to, ", ");
        sink_member(to, index, order[i]);
    }
}

static uint64_t index_checksum(const mw_tile_index *index)
{
    static const index_member by_name[] = {INDEX_CHECKSUMS, INDEX_CUTS,      INDEX_FORMAT,
                                           INDEX_HOLES,     INDEX_TRIANGLES, INDEX_VERSION,
                                           INDEX_VERTICES};
    mw_blake2b hash = mw__blake2b();
    const text_sink sink = {.hash = &hash};
    sink_members(&sink, index, by_name);
    sink_text(&sink, "}");
    return mw__blake2b_end(&hash);
}

mw_status mw__tile_index_write(const mw_tile_index *index, const char *path, mw_error *error)
{
    static const index_member order[] = {INDEX_FORMAT,    INDEX_VERSION, INDEX_VERTICES,
                                         INDEX_TRIANGLES, INDEX_HOLES,   INDEX_CHECKSUMS,
                                         INDEX_CUTS};
    char text[64];
    text_sink sink = {0};
    mw_status status = mw_output_open(path, &sink.output, error);
    if (status) return status;
    sink_members(&sink, index, order);
    snprintf(text, sizeof text, ", \"checksum\": \"%016" PRIx64 "\"}", index_checksum(index));
    sink_text(&sink, text);
    return mw_output_close(sink.output, 1, error);
}
