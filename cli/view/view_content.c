#include "cli/view/view_content.h"
#include "cli/frame/report.h"

#include <stdint.h>
#include <stdlib.h>
#include <zlib.h>

/* --- texts and numbers ------------------------------------------------------------------------ */

/* A JSON string within a page: "</script>" in a name must not end the script. */
static void content_quote(text *t, const char *value)
{
    text quoted = {0};
    report_quote(&quoted, value ? value : "");
    for (size_t i = 0; i < quoted.size; i++) {
        if (quoted.bytes[i] == '<')
            text_string(t, "\\u003c");
        else
            text_bytes(t, quoted.bytes + i, 1);
    }
    t->failed |= quoted.failed;
    text_release(&quoted);
}

static void content_base64(text *t, const unsigned char *bytes, size_t size)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t have = size - i < 3 ? size - i : 3;
        uint32_t bits = (uint32_t)bytes[i] << 16;
        if (have > 1) bits |= (uint32_t)bytes[i + 1] << 8;
        if (have > 2) bits |= bytes[i + 2];
        char four[4] = {'=', '=', '=', '='};
        for (size_t k = 0; k <= have; k++) four[k] = digit[bits >> (18 - 6 * k) & 63];
        text_bytes(t, four, 4);
    }
}

/* Numbers in the order of bytes of this machine and of WebAssembly: the lowest first. */
static void content_numbers(text *t, const void *numbers, size_t size)
{
    uLong room = compressBound(size);
    unsigned char *packed = malloc(room);
    if (!packed || compress2(packed, &room, numbers, size, Z_DEFAULT_COMPRESSION) != Z_OK) {
        t->failed = true;
    } else {
        text_printf(t, "{\"size\": %zu, \"packed\": \"", size);
        content_base64(t, packed, room);
        text_string(t, "\"}");
    }
    free(packed);
}

/* --- members ---------------------------------------------------------------------------------- */

static void content_name(text *t, const char *name)
{
    text_printf(t, ",\n \"%s\": ", name);
}

static void content_fields(text *t, const char *name, char *const *names, double *const *fields,
                           size_t count, size_t size)
{
    content_name(t, name);
    text_string(t, "[");
    for (size_t i = 0; i < count; i++) {
        text_string(t, i ? ",\n  {\"name\": " : "\n  {\"name\": ");
        content_quote(t, names[i]);
        text_string(t, ", \"values\": ");
        content_numbers(t, fields[i], size * sizeof **fields);
        text_string(t, "}");
    }
    text_string(t, "]");
}

static void content_points(text *t, const view_content *c)
{
    content_name(t, "query");
    text_string(t, "{\"name\": ");
    content_quote(t, c->points_path);
    text_string(t, ", \"points\": ");
    content_numbers(t, c->points, c->point_count * 2 * sizeof *c->points);
    text_string(t, "}");
}

void view_content_write(text *t, const view_content *c)
{
    const mw_mesh_file *m = c->mesh;
    text_string(t, "{\"name\": ");
    content_quote(t, c->path);
    content_name(t, "as");
    content_quote(t, c->as);
    content_name(t, "centre");
    for (int k = 0; k < 3; k++) {
        text_string(t, k ? ", " : "[");
        text_double(t, c->centre[k]);
    }
    text_string(t, "]");
    content_name(t, "crs");
    content_quote(t, m->crs);
    text_printf(t, ",\n \"heights\": %s", m->has_z ? "true" : "false");
    content_name(t, "points");
    content_numbers(t, m->points, m->point_count * 3 * sizeof *m->points);
    content_name(t, "triangles");
    content_numbers(t, m->triangles, m->triangle_count * 3 * sizeof *m->triangles);
    content_fields(t, "fields", m->field_names, m->fields, m->field_count, m->point_count);
    content_fields(t, "triangleFields", m->triangle_field_names, m->triangle_fields,
                   m->triangle_field_count, m->triangle_count);
    if (c->points_path) content_points(t, c);
    text_string(t, "}\n");
}
