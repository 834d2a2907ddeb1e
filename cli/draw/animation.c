/* animation.c - writes animated PNG.
 *
 * Cairo writes each picture as a PNG of its own: IHDR, IDAT, ..., IEND. An animation has one IHDR,
 * acTL with the number of pictures, the IDAT of a picture for programs that show no animations, and
 * of each picture fcTL (its size and time) and its IDAT, renamed fdAT, with a number before the
 * data. Each picture is painted over the previous one; unchanged pixels are transparent, so they
 * take almost no space. */
#include "cli/draw/animation.h"
#include "src/base/posix.h"

#include <string.h>

bool animation_named(const char *path)
{
    const char *ending = strrchr(path, '.');
    return ending && (strcasecmp(ending, ".png") == 0 || strcasecmp(ending, ".apng") == 0);
}

#ifdef MW_CAIRO

#include "cli/frame/message.h"
#include "cli/frame/signals.h"

#include <cairo.h>
#include <math.h>
#include <stdlib.h>
#include <zlib.h>

/* --- chunks: length, type, data, checksum ----------------------------------------------------- */

enum { SIGNATURE = 8, HEAD = 8, TAIL = 4, FRAME_CONTROL = 26 };

static void bytes_put(unsigned char *at, uint32_t value, int count)
{
    while (count-- > 0) {
        at[count] = (unsigned char)value;
        value >>= 8;
    }
}

static uint32_t bytes_get(const unsigned char *at)
{
    return (uint32_t)at[0] << 24 | (uint32_t)at[1] << 16 | (uint32_t)at[2] << 8 | at[3];
}

/* A chunk whose data are in two parts. */
static void chunk_write(mw_output *out, const char *type, const unsigned char *first,
                        uint32_t first_size, const unsigned char *second, uint32_t second_size)
{
    unsigned char head[HEAD], tail[TAIL];
    bytes_put(head, first_size + second_size, 4);
    memcpy(head + 4, type, 4);
    uLong sum = crc32(0, head + 4, 4);
    if (first_size) sum = crc32(sum, first, first_size);
    if (second_size) sum = crc32(sum, second, second_size);
    bytes_put(tail, (uint32_t)sum, 4);
    mw_output_write(out, head, HEAD);
    if (first_size) mw_output_write(out, first, first_size);
    if (second_size) mw_output_write(out, second, second_size);
    mw_output_write(out, tail, TAIL);
}

/* --- one picture ------------------------------------------------------------------------------ */

/* A PNG in memory. */
typedef struct frame_png {
    unsigned char *bytes;
    size_t size, room;
} frame_png;

static cairo_status_t frame_png_take(void *self, const unsigned char *bytes, unsigned int size)
{
    frame_png *png = self;
    if (png->size + size > png->room) {
        size_t room = 2 * (png->size + size);
        unsigned char *more = realloc(png->bytes, room);
        if (!more) return CAIRO_STATUS_NO_MEMORY;
        png->bytes = more;
        png->room = room;
    }
    memcpy(png->bytes + png->size, bytes, size);
    png->size += size;
    return CAIRO_STATUS_SUCCESS;
}

static uint32_t *page_data(cairo_surface_t *page)
{
    return (uint32_t *)(void *)cairo_image_surface_get_data(page);
}

static void frame_paint(const animation *a, cairo_surface_t *page, uint32_t frame)
{
    cairo_t *c = cairo_create(page);
    cairo_set_source_rgb(c, 1, 1, 1);
    cairo_paint(c);
    a->draw(c, frame, a->self);
    cairo_destroy(c);
    cairo_surface_flush(page);
    /* Cairo leaves out the opacity of a page without a hole, but all pictures have one form. */
    page_data(page)[0] = UINT32_C(0xfefefefe);
    cairo_surface_mark_dirty(page);
}

static size_t page_pixels(cairo_surface_t *page)
{
    return (size_t)(cairo_image_surface_get_stride(page) / 4) *
           (size_t)cairo_image_surface_get_height(page);
}

/* Store in `change` the pixels that differ from `before`, then copy the page to `before`. */
static void page_take_change(cairo_surface_t *page, uint32_t *before, cairo_surface_t *change)
{
    const uint32_t *now = page_data(page);
    uint32_t *out = page_data(change);
    for (size_t i = 0, n = page_pixels(page); i < n; i++) {
        out[i] = now[i] == before[i] ? 0 : now[i];
        before[i] = now[i];
    }
    cairo_surface_mark_dirty(change);
}

static cairo_status_t frame_png_make(frame_png *png, cairo_surface_t *page)
{
    cairo_status_t status = cairo_surface_status(page);
    png->size = 0;
    return status ? status : cairo_surface_write_to_png_stream(page, frame_png_take, png);
}

/* The next chunk of that type from *at on; NULL: there is no more. *at goes behind it. */
static const unsigned char *frame_png_chunk(const frame_png *png, size_t *at, const char *type,
                                            uint32_t *size)
{
    while (*at + HEAD + TAIL <= png->size) {
        const unsigned char *chunk = png->bytes + *at;
        *size = bytes_get(chunk);
        if (*size > png->size - *at - HEAD - TAIL) return NULL;
        *at += HEAD + *size + TAIL;
        if (memcmp(chunk + 4, type, 4) == 0) return chunk + HEAD;
    }
    return NULL;
}

/* --- the file --------------------------------------------------------------------------------- */

/* Write the head of the file, and a picture for programs that do not show animations. */
static void animation_write_head(const animation *a, const frame_png *png, mw_output *out)
{
    unsigned char control[8];
    uint32_t size;
    size_t at = SIGNATURE;
    mw_output_write(out, png->bytes, SIGNATURE);
    const unsigned char *data = frame_png_chunk(png, &at, "IHDR", &size);
    chunk_write(out, "IHDR", data, data ? size : 0, NULL, 0);
    bytes_put(control, a->frames, 4);
    bytes_put(control + 4, 0, 4); /* shown again and again */
    chunk_write(out, "acTL", control, sizeof control, NULL, 0);
    while ((data = frame_png_chunk(png, &at, "IDAT", &size)))
        chunk_write(out, "IDAT", data, size, NULL, 0);
}

static void animation_write_frame(const animation *a, uint32_t frame, const frame_png *png,
                                  uint32_t *number, mw_output *out)
{
    unsigned char control[FRAME_CONTROL] = {0}, sequence[4];
    uint32_t size;
    size_t at = SIGNATURE;
    const unsigned char *data;
    bytes_put(control, (*number)++, 4);
    memcpy(control + 4, png->bytes + SIGNATURE + HEAD, 8); /* width and height, as in IHDR */
    bytes_put(control + 20, a->milliseconds(frame, a->self), 2);
    bytes_put(control + 22, 1000, 2);
    control[25] = 1; /* over the one before */
    chunk_write(out, "fcTL", control, sizeof control, NULL, 0);
    while ((data = frame_png_chunk(png, &at, "IDAT", &size))) {
        bytes_put(sequence, (*number)++, 4);
        chunk_write(out, "fdAT", sequence, sizeof sequence, data, size);
    }
}

static cairo_status_t animation_write_pages(const animation *a, cairo_surface_t *page,
                                            cairo_surface_t *change, uint32_t *before,
                                            mw_output *out)
{
    frame_png png = {0};
    uint32_t number = 0;
    frame_paint(a, page, a->frames - 1);
    cairo_status_t status = frame_png_make(&png, page);
    if (!status) animation_write_head(a, &png, out);
    for (uint32_t frame = 0; frame < a->frames && !status; frame++) {
        frame_paint(a, page, frame);
        page_take_change(page, before, change); /* the first changes all: nothing was there */
        status = frame_png_make(&png, change);
        if (!status) animation_write_frame(a, frame, &png, &number, out);
    }
    if (!status) chunk_write(out, "IEND", NULL, 0, NULL, 0);
    free(png.bytes);
    return status;
}

static cairo_status_t animation_write_all(const animation *a, mw_output *out)
{
    int width = (int)ceil(a->width), height = (int)ceil(a->height);
    cairo_surface_t *page = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    cairo_surface_t *change = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    cairo_status_t status = cairo_surface_status(page);
    if (!status) status = cairo_surface_status(change);
    uint32_t *before = status ? NULL : calloc(page_pixels(page), sizeof *before);
    if (!status)
        status =
            before ? animation_write_pages(a, page, change, before, out) : CAIRO_STATUS_NO_MEMORY;
    free(before);
    cairo_surface_destroy(change);
    cairo_surface_destroy(page);
    return status;
}

int animation_write(const animation *a, const char *path)
{
    mw_error error;
    mw_output *out;
    if (mw_output_open(path, &out, &error) != MW_OK) return fail_writing(&error);
    signals_set_temporary(mw_output_temporary(out));
    cairo_status_t status = animation_write_all(a, out);
    if (status) complain("%s: %s", path, cairo_status_to_string(status));
    int end = status ? END_RESOURCE : 0;
    if (mw_output_close(out, end == 0, &error) != MW_OK && end == 0) end = fail_writing(&error);
    signals_set_temporary(NULL);
    return end;
}

#else

#include "cli/draw/picture.h"

int animation_write(const animation *a, const char *path)
{
    (void)a;
    return picture_check(path);
}

#endif
