#include "cli/draw/picture.h"
#include "cli/frame/message.h"
#include "src/base/posix.h"

#include <string.h>

enum { SVG, PNG, PDF, UNKNOWN };

static int picture_format(const char *path)
{
    static const char *const endings[] = {".svg", ".png", ".pdf"};
    const char *ending = strrchr(path, '.');
    for (int form = 0; ending && form < UNKNOWN; form++)
        if (strcasecmp(ending, endings[form]) == 0) return form;
    return UNKNOWN;
}

bool picture_named(const char *path)
{
    return picture_format(path) != UNKNOWN;
}

#ifdef MW_CAIRO

#include "cli/frame/signals.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <math.h>

#define PNG_SCALE 2.0 /* pixels for each point */

int picture_check(const char *path)
{
    (void)path;
    return 0;
}

static cairo_status_t picture_write_bytes(void *output, const unsigned char *bytes,
                                          unsigned int size)
{
    mw_output_write(output, bytes, size);
    return CAIRO_STATUS_SUCCESS; /* closing the output reports the error */
}

static cairo_surface_t *picture_make_surface(int form, mw_output *out, double width, double height)
{
    if (form == SVG)
        return cairo_svg_surface_create_for_stream(picture_write_bytes, out, width, height);
    if (form == PDF)
        return cairo_pdf_surface_create_for_stream(picture_write_bytes, out, width, height);
    return cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)ceil(PNG_SCALE * width),
                                      (int)ceil(PNG_SCALE * height));
}

static cairo_status_t picture_paint(cairo_surface_t *surface, int form, mw_output *out,
                                    picture_draw *draw, const void *self)
{
    cairo_t *c = cairo_create(surface);
    if (form == PNG) cairo_scale(c, PNG_SCALE, PNG_SCALE);
    cairo_set_source_rgb(c, 1, 1, 1);
    cairo_paint(c);
    draw(c, self);
    cairo_status_t status = cairo_status(c);
    cairo_destroy(c);
    if (status == CAIRO_STATUS_SUCCESS && form == PNG)
        status = cairo_surface_write_to_png_stream(surface, picture_write_bytes, out);
    cairo_surface_finish(surface);
    return status == CAIRO_STATUS_SUCCESS ? cairo_surface_status(surface) : status;
}

int picture_write(const char *path, double width, double height, picture_draw *draw,
                  const void *self)
{
    mw_error error;
    mw_output *out;
    if (mw_output_open(path, &out, &error) != MW_OK) return fail_writing(&error);
    signals_set_temporary(mw_output_temporary(out));
    int form = picture_format(path);
    cairo_surface_t *surface = picture_make_surface(form, out, width, height);
    cairo_status_t status = picture_paint(surface, form, out, draw, self);
    cairo_surface_destroy(surface);
    if (status != CAIRO_STATUS_SUCCESS) complain("%s: %s", path, cairo_status_to_string(status));
    int end = status == CAIRO_STATUS_SUCCESS ? 0 : END_RESOURCE;
    if (mw_output_close(out, end == 0, &error) != MW_OK && end == 0) end = fail_writing(&error);
    signals_set_temporary(NULL);
    return end;
}

#else

int picture_check(const char *path)
{
    complain("%s: this program was built without Cairo and cannot draw pictures", path);
    return END_USAGE;
}

int picture_write(const char *path, double width, double height, picture_draw *draw,
                  const void *self)
{
    (void)width, (void)height, (void)draw, (void)self;
    return picture_check(path);
}

#endif
