/* segment_object.c - the triangles along a segment: what a profile is made of. */
#include "engine/engine.h"

#include <stdlib.h>

typedef struct web_segment {
    double *piece; /* from, to, triangle of each */
    size_t count, room;
} web_segment;

void WEB_EXPORT(web_segment_free)(web_segment *s)
{
    if (!s) return;
    free(s->piece);
    free(s);
}

static int segment_add(web_segment *s, const mw_segment_piece *piece)
{
    if (s->count == s->room) {
        size_t room = s->room ? 2 * s->room : 256;
        double *more = realloc(s->piece, room * 3 * sizeof *more);
        if (!more) return 0;
        s->piece = more;
        s->room = room;
    }
    double *at = s->piece + 3 * s->count++;
    at[0] = piece->from;
    at[1] = piece->to;
    at[2] = piece->triangle;
    return 1;
}

/* NULL on failure. */
web_segment *WEB_EXPORT(web_segment_make)(const mw_locator *locator, double ax, double ay,
                                          double bx, double by)
{
    mw_cursor cursor;
    mw_segment walk;
    mw_segment_piece piece;
    const double a[2] = {ax, ay}, b[2] = {bx, by};
    if (mw_cursor_init(locator, NULL, &cursor, &web_error) != MW_OK) return NULL;
    if (mw_segment_begin(locator, &cursor, a, b, &walk, &web_error) != MW_OK) return NULL;
    web_segment *s = calloc(1, sizeof *s);
    while (s && mw_segment_next(&walk, &piece))
        if (!segment_add(s, &piece)) {
            web_segment_free(s);
            return NULL;
        }
    return s;
}

size_t WEB_EXPORT(web_segment_count)(const web_segment *s)
{
    return s->count;
}

const double *WEB_EXPORT(web_segment_pieces)(const web_segment *s)
{
    return s->piece;
}
