#include "io/layouts/layout_find.h"
#include "io/layouts/netcdf_mesh.h"
#include "io/netcdf/netcdf_values.h"
#include "io/series/netcdf_times.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A time, the vertices or faces, and two others. */
enum { MOST_DIMENSIONS = 4 };

/* Where the values of a field stand in its variable: the numbers of dimensions. */
typedef struct netcdf_axes {
    const mw_netcdf_variable *variable;
    mw_netcdf_packing packing;
    int time, values;   /* -1: no such dimension */
    int layer[2];       /* the other dimensions: layers and components, as SCHISM has them */
    size_t layer_at[2]; /* the index in each of them, 0 if there is none */
} netcdf_axes;

/* What a file says of a variable; NULL: nothing. */
typedef struct netcdf_texts {
    char *unit, *long_name, *standard_name;
} netcdf_texts;

typedef struct netcdf_content {
    mw_netcdf *file;
    void *memory;
    netcdf_axes *axes_of; /* of the fields */
    int time_dimension, vertex_dimension, face_dimension;
    mw_layout layout;
} netcdf_content;

static bool netcdf_series_is(const char *path, const char *head, size_t size)
{
    (void)path;
    return mw__netcdf_begins(head, size);
}

static void netcdf_series_close(void *content)
{
    netcdf_content *c = content;
    mw__netcdf_close(c->file);
    free(c->memory);
    free(c->axes_of);
    free(c);
}

/* The dimension of that length that is not the time; -1: none. */
static int netcdf_series_dimension(const netcdf_content *c, size_t length)
{
    int count = (int)mw__netcdf_dimension_count(c->file);
    for (int d = 0; d < count && length > 0; d++) {
        size_t other;
        mw__netcdf_dimension_at(c->file, d, &other);
        if (other == length && d != c->time_dimension) return d;
    }
    return -1;
}

static mw_status netcdf_series_check_count(const netcdf_content *c, int dimension, size_t count,
                                           const char *what, mw_error *error)
{
    size_t length;
    if (dimension < 0 || count == 0) return MW_OK;
    mw__netcdf_dimension_at(c->file, dimension, &length);
    if (length == count) return MW_OK;
    return mw__netcdf_fail(c->file, NULL, error, "it has values at %zu %s, but the mesh has %zu",
                           length, what, count);
}

/* The dimensions of vertices and faces: those of the mesh in the file, or by their lengths. */
static mw_status netcdf_series_dimensions(netcdf_content *c, const mw_series_options *options,
                                          mw_error *error)
{
    bool counted = options->vertex_count || options->face_count;
    mw_status status = mw__layout_find(c->file, options->layout, &c->layout, error);
    if (status && (status != MW_ERROR_INPUT || !counted || c->layout.x)) return status;
    c->vertex_dimension = c->layout.vertex_dimension;
    c->face_dimension = c->layout.face_dimension;
    if (status) {
        c->vertex_dimension = netcdf_series_dimension(c, options->vertex_count);
        c->face_dimension = netcdf_series_dimension(c, options->face_count);
        if (c->face_dimension == c->vertex_dimension) c->face_dimension = -1;
        return MW_OK;
    }
    status =
        netcdf_series_check_count(c, c->vertex_dimension, options->vertex_count, "vertices", error);
    if (status) return status;
    return netcdf_series_check_count(c, c->face_dimension, options->face_count, "faces", error);
}

/* Is this a field, and where are its values? */
static bool netcdf_series_axes(const netcdf_content *c, const mw_netcdf_variable *variable,
                               netcdf_axes *axes)
{
    *axes = (netcdf_axes){.variable = variable, .time = -1, .layer = {-1, -1}, .values = -1};
    if (variable->rank > MOST_DIMENSIONS || variable->type == MW_NETCDF_CHAR ||
        variable->type >= MW_NETCDF_STRING || variable == c->layout.x || variable == c->layout.y ||
        variable == c->layout.corners || variable == c->layout.counts)
        return false;
    for (int k = 0; k < (int)variable->rank; k++) {
        int d = variable->dimensions[k];
        bool values = d >= 0 && (d == c->vertex_dimension || d == c->face_dimension);
        int *role = d == c->time_dimension ? &axes->time
                    : values               ? &axes->values
                    : axes->layer[0] < 0   ? &axes->layer[0]
                                           : &axes->layer[1];
        if (*role >= 0) return false;
        *role = k;
    }
    /* tables of numbers of vertices and of faces are constant, and have several a face */
    bool table = axes->time < 0 && axes->layer[0] >= 0 && variable->type != MW_NETCDF_FLOAT &&
                 variable->type != MW_NETCDF_DOUBLE;
    return axes->values >= 0 && !table;
}

/* How many indices a dimension has; 1 if there is no such dimension. */
static size_t netcdf_layer_count(const netcdf_axes *axes, int k)
{
    return axes->layer[k] >= 0 ? axes->variable->lengths[axes->layer[k]] : 1;
}

/* "temperature, siglay 3", allocated; NULL if the file has no text. False: there is no memory. */
static bool netcdf_series_long_name(const netcdf_content *c, const netcdf_axes *axes,
                                    const char *text, char **out)
{
    *out = NULL;
    if (!text || !*text) return true;
    size_t size = strlen(text) + 2 * (MW_NETCDF_NAME + 32), used = strlen(text);
    *out = mw__alloc(size, 1);
    if (!*out) return false;
    memcpy(*out, text, used + 1);
    for (int k = 0; k < 2; k++) {
        if (netcdf_layer_count(axes, k) < 2) continue;
        const int layer = axes->variable->dimensions[axes->layer[k]];
        used += (size_t)snprintf(*out + used, size - used, ", %s %zu",
                                 mw__netcdf_dimension_at(c->file, layer, NULL), axes->layer_at[k]);
    }
    return true;
}

/* "temp", "temp:3" of several layers, "hvel:3:0" of several layers and components. */
static void netcdf_series_name(const netcdf_axes *axes, char *name, size_t size)
{
    int used = snprintf(name, size, "%s", axes->variable->name);
    for (int k = 0; k < 2; k++)
        if (netcdf_layer_count(axes, k) > 1)
            used += snprintf(name + used, size - (size_t)used, ":%zu", axes->layer_at[k]);
}

static mw_status netcdf_series_field(netcdf_content *c, mw_series_part *part,
                                     const netcdf_axes *axes, const netcdf_texts *texts,
                                     mw_error *error)
{
    const mw_netcdf_variable *variable = axes->variable;
    char name[MW_NETCDF_NAME + 48], *long_name;
    netcdf_axes *axes_of = mw__realloc(c->axes_of, part->field_count + 1, sizeof *axes_of);
    if (!axes_of) return mw__fail_memory(error);
    c->axes_of = axes_of;
    axes_of[part->field_count] = *axes;
    netcdf_series_name(axes, name, sizeof name);
    if (!netcdf_series_long_name(c, axes, texts->long_name, &long_name))
        return mw__fail_memory(error);
    mw_series_field field = {.name = name,
                             .unit = texts->unit,
                             .long_name = long_name,
                             .standard_name = texts->standard_name,
                             .location = variable->dimensions[axes->values] == c->vertex_dimension
                                             ? MW_SERIES_VERTEX
                                             : MW_SERIES_FACE,
                             .constant = axes->time < 0,
                             .value_count = variable->lengths[axes->values]};
    mw_status status = mw__series_part_add(part, field, error);
    free(long_name);
    return status;
}

/* What the file says of a variable. Release them in any case. */
static mw_status netcdf_series_texts(const netcdf_content *c, const mw_netcdf_variable *variable,
                                     netcdf_texts *texts, mw_error *error)
{
    *texts = (netcdf_texts){0};
    mw_status status = mw__netcdf_text(c->file, variable, "units", &texts->unit, error);
    if (!status && !texts->unit)
        status = mw__netcdf_text(c->file, variable, "unit", &texts->unit, error);
    if (!status) status = mw__netcdf_text(c->file, variable, "long_name", &texts->long_name, error);
    return status
               ? status
               : mw__netcdf_text(c->file, variable, "standard_name", &texts->standard_name, error);
}

static void netcdf_texts_release(netcdf_texts *texts)
{
    free(texts->unit);
    free(texts->long_name);
    free(texts->standard_name);
}

static mw_status netcdf_series_variable(netcdf_content *c, mw_series_part *part, netcdf_axes *axes,
                                        mw_error *error)
{
    enum { MOST_LAYERS = 4096 };
    netcdf_texts texts;
    if (mw__netcdf_check_size(c->file, axes->variable, error)) return MW_ERROR_INPUT;
    const size_t outer = netcdf_layer_count(axes, 0), inner = netcdf_layer_count(axes, 1);
    if (outer > MOST_LAYERS || inner > MOST_LAYERS || outer * inner > MOST_LAYERS) return MW_OK;
    mw_status status = netcdf_series_texts(c, axes->variable, &texts, error);
    axes->packing = mw__netcdf_packing(c->file, axes->variable);
    for (size_t k = 0; k < outer * inner && !status; k++) {
        axes->layer_at[0] = k / inner;
        axes->layer_at[1] = k % inner;
        status = netcdf_series_field(c, part, axes, &texts, error);
    }
    netcdf_texts_release(&texts);
    return status;
}

static mw_status netcdf_series_fill(netcdf_content *c, const mw_series_options *options,
                                    mw_series_part *part, mw_error *error)
{
    c->time_dimension = mw__netcdf_time_dimension(c->file);
    mw_status status = netcdf_series_dimensions(c, options, error);
    if (!status) status = mw__netcdf_times(c->file, c->time_dimension, part, error);
    for (size_t i = 0; i < mw__netcdf_variable_count(c->file) && !status; i++) {
        netcdf_axes axes;
        if (netcdf_series_axes(c, mw__netcdf_variable_at(c->file, i), &axes))
            status = netcdf_series_variable(c, part, &axes, error);
    }
    if (status || part->field_count > 0) return status;
    return mw__netcdf_fail(c->file, NULL, error,
                           "the file has no values at the vertices or faces of the mesh");
}

static mw_status netcdf_series_open(mw_source *source, const mw_series_options *options,
                                    mw_series_part *part, mw_error *error)
{
    netcdf_content *c = mw__calloc(1, sizeof *c);
    if (!c) return mw__fail_memory(error);
    part->content = c;
    mw_status status = mw__netcdf_open_source(source, &c->file, &c->memory, error);
    return status ? status : netcdf_series_fill(c, options, part, error);
}

static mw_status netcdf_series_read(void *content, size_t field, size_t step, double *values,
                                    mw_error *error)
{
    const netcdf_content *c = content;
    const netcdf_axes *axes = &c->axes_of[field];
    const mw_netcdf_variable *variable = axes->variable;
    size_t starts[MOST_DIMENSIONS] = {0}, counts[MOST_DIMENSIONS] = {1, 1, 1, 1};
    if (axes->time >= 0) starts[axes->time] = step;
    for (int k = 0; k < 2; k++)
        if (axes->layer[k] >= 0) starts[axes->layer[k]] = axes->layer_at[k];
    counts[axes->values] = variable->lengths[axes->values];
    mw_status status = mw__netcdf_doubles(c->file, variable, starts, counts, values, error);
    if (!status) mw__netcdf_unpack(&axes->packing, values, counts[axes->values]);
    return status;
}

const mw_series_kind mw__netcdf_series = {netcdf_series_is, netcdf_series_open, netcdf_series_read,
                                          netcdf_series_close};
