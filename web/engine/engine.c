/* engine.c - memory, errors, and the names of things. */
#include "engine/engine.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

mw_error web_error;

void *WEB_EXPORT(web_alloc)(size_t size)
{
    return malloc(size ? size : 1);
}

void WEB_EXPORT(web_free)(void *block)
{
    free(block);
}

int WEB_EXPORT(web_error_status)(void)
{
    return (int)web_error.status;
}

const char *WEB_EXPORT(web_error_message)(void)
{
    return web_error.message;
}

void web_count(const mw_counters *c, double numbers[WEB_COUNTERS])
{
    const double all[] = {(double)c->triangles_visited,
                          (double)(c->orient_init + c->orient + c->orient_final + c->orient_border),
                          (double)c->implicit,
                          (double)c->comparisons,
                          (double)c->cycles,
                          (double)c->handovers};
    memcpy(numbers, all, sizeof all);
}

/* Where the error is: 0 triangle, 1 vertex, 2 line; -1 if that does not apply. */
double WEB_EXPORT(web_error_place)(int what)
{
    return (double)(what == 0 ? web_error.triangle : what == 1 ? web_error.vertex : web_error.line);
}

/* Unpack zlib's data into `room` bytes. Returns 0 if they are not exactly these. */
int WEB_EXPORT(web_unpack)(const unsigned char *packed, size_t size, unsigned char *bytes,
                           size_t room)
{
    z_stream s = {
        .next_in = packed, .avail_in = (uInt)size, .next_out = bytes, .avail_out = (uInt)room};
    if (inflateInit2(&s, MAX_WBITS) != Z_OK) return 0;
    int result = Z_OK;
    while (result == Z_OK && s.avail_out > 0) result = inflate(&s, Z_NO_FLUSH);
    inflateEnd(&s);
    return s.avail_out == 0 && (result == Z_OK || result == Z_STREAM_END);
}

const char *WEB_EXPORT(web_version)(void)
{
    return mw_version();
}

const char *WEB_EXPORT(web_status_text)(int status)
{
    return mw_status_text((mw_status)status);
}

/* On which side of the line from a to b the point c is, exactly: 1 left, -1 right, 0 on it. */
int WEB_EXPORT(web_orient2d)(double ax, double ay, double bx, double by, double cx, double cy)
{
    const double a[2] = {ax, ay}, b[2] = {bx, by}, c[2] = {cx, cy};
    double side = mw_orient2d(a, b, c);
    return (side > 0) - (side < 0);
}

/* A walk's name (0), source (1), help (2); NULL beyond the last. */
const char *WEB_EXPORT(web_walk_text)(int walk, int what)
{
    mw_walk_kind kind = (mw_walk_kind)walk;
    if (what == 0) return mw_walk_name(kind);
    return what == 1 ? mw_walk_source(kind) : mw_walk_help(kind);
}

const char *WEB_EXPORT(web_start_text)(int start, int what)
{
    mw_start_kind kind = (mw_start_kind)start;
    return what == 0 ? mw_start_name(kind) : mw_start_help(kind);
}

int WEB_EXPORT(web_start_has_index)(int start)
{
    return mw_start_has_index((mw_start_kind)start);
}

const char *WEB_EXPORT(web_where_text)(int where)
{
    return mw_where_name((mw_where)where);
}
