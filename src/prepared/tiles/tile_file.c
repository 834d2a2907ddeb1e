#include "prepared/tiles/tile_file.h"

#include <stdlib.h>
#include <string.h>

/* The arrays of a file. */
typedef struct tile_copy {
    const mw_tile_source *source;
    const uint32_t *number; /* of its triangles in the whole mesh */
    uint32_t *vertex;       /* of its vertices, ascending */
    size_t triangle_count, vertex_count;
    double *points;
    uint32_t *corner;
    mw_mesh_file values; /* what is kept beside the mesh */
} tile_copy;

static int compare_tile_vertices(const void *left, const void *right)
{
    const uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

/* --- the copy --------------------------------------------------------------------------------- */

/* List the vertices of the triangles, and note the place of each. */
static void copy_list_vertices(tile_copy *c)
{
    uint32_t *place = c->source->place, v[3];
    for (size_t i = 0; i < c->triangle_count; i++) {
        mw_mesh_triangle(c->source->mesh, c->number[i], v);
        for (int k = 0; k < 3; k++)
            if (place[v[k]] == MW_NONE) {
                place[v[k]] = 0;
                c->vertex[c->vertex_count++] = v[k];
            }
    }
    qsort(c->vertex, c->vertex_count, sizeof *c->vertex, compare_tile_vertices);
    for (size_t i = 0; i < c->vertex_count; i++) place[c->vertex[i]] = (uint32_t)i;
}

static bool copy_take_mesh(tile_copy *c)
{
    const mw_tile_source *s = c->source;
    const size_t vertices = mw_mesh_vertex_count(s->mesh), corners = 3 * c->triangle_count;
    c->vertex = mw__alloc(corners < vertices ? corners : vertices, sizeof *c->vertex);
    c->corner = mw__alloc(corners, sizeof *c->corner);
    if (!c->vertex || !c->corner) return false;
    copy_list_vertices(c);
    for (size_t i = 0; i < c->triangle_count; i++) {
        uint32_t *corner = c->corner + 3 * i;
        mw_mesh_triangle(s->mesh, c->number[i], corner);
        for (int k = 0; k < 3; k++) corner[k] = s->place[corner[k]];
    }
    for (size_t i = 0; i < c->vertex_count; i++) s->place[c->vertex[i]] = MW_NONE;
    c->points = mw__alloc(c->vertex_count, 2 * sizeof *c->points);
    for (size_t i = 0; i < c->vertex_count && c->points; i++)
        mw_mesh_vertex(s->mesh, c->vertex[i], c->points + 2 * i);
    return c->points;
}

/* --- values ----------------------------------------------------------------------------------- */

/* Room for one more field. The name stays whose it is. */
static double *fields_add(char **names, double **fields, size_t *count, const char *name,
                          size_t length)
{
    double *values = mw__alloc(length, sizeof *values);
    names[*count] = (char *)(uintptr_t)name;
    if (values) fields[(*count)++] = values;
    return values;
}

/* Copy the chosen ones of values that stand `step` apart. */
static bool field_gather(double *to, const double *from, size_t step, const uint32_t *chosen,
                         size_t count)
{
    for (size_t i = 0; i < count && to; i++) to[i] = from[step * chosen[i]];
    return to;
}

static bool numbers_write(double *to, const uint32_t *number, size_t count)
{
    for (size_t i = 0; i < count && to; i++) to[i] = number[i];
    return to;
}

static bool copy_take_fields(tile_copy *c)
{
    const mw_mesh_file *from = c->source->values;
    mw_mesh_file *to = &c->values;
    const size_t n = c->vertex_count;
    bool done = true;
    to->field_names = mw__calloc(from->field_count + 2, sizeof *to->field_names);
    to->fields = mw__calloc(from->field_count + 2, sizeof *to->fields);
    if (!to->field_names || !to->fields) return false;
    if (from->has_z && from->points)
        done = field_gather(fields_add(to->field_names, to->fields, &to->field_count, "z", n),
                            from->points + 2, 3, c->vertex, n);
    for (size_t i = 0; i < from->field_count && done; i++)
        done = field_gather(
            fields_add(to->field_names, to->fields, &to->field_count, from->field_names[i], n),
            from->fields[i], 1, c->vertex, n);
    return done && numbers_write(fields_add(to->field_names, to->fields, &to->field_count,
                                            MW_TILE_VERTICES, n),
                                 c->vertex, n);
}

static bool copy_take_triangle_fields(tile_copy *c)
{
    const mw_mesh_file *from = c->source->values;
    mw_mesh_file *to = &c->values;
    const size_t n = c->triangle_count;
    bool done = true;
    to->triangle_field_names = mw__calloc(from->triangle_field_count + 1, sizeof(char *));
    to->triangle_fields = mw__calloc(from->triangle_field_count + 1, sizeof(double *));
    if (!to->triangle_field_names || !to->triangle_fields) return false;
    for (size_t i = 0; i < from->triangle_field_count && done; i++)
        done = field_gather(fields_add(to->triangle_field_names, to->triangle_fields,
                                       &to->triangle_field_count, from->triangle_field_names[i], n),
                            from->triangle_fields[i], 1, c->number, n);
    return done && numbers_write(fields_add(to->triangle_field_names, to->triangle_fields,
                                            &to->triangle_field_count, MW_TILE_TRIANGLES, n),
                                 c->number, n);
}

static mw_status copy_make(tile_copy *c, mw_error *error)
{
    if (!copy_take_mesh(c)) return mw__fail_memory(error);
    c->values.point_count = c->vertex_count;
    c->values.triangle_count = c->triangle_count;
    c->values.crs = c->source->values->crs;
    return copy_take_fields(c) && copy_take_triangle_fields(c) ? MW_OK : mw__fail_memory(error);
}

static void fields_release(char **names, double **fields, size_t count)
{
    for (size_t i = 0; i < count; i++) free(fields[i]);
    free(fields);
    free(names);
}

static void copy_release(tile_copy *c)
{
    mw_mesh_file *v = &c->values;
    fields_release(v->field_names, v->fields, v->field_count);
    fields_release(v->triangle_field_names, v->triangle_fields, v->triangle_field_count);
    free(c->vertex);
    free(c->corner);
    free(c->points);
}

/* --- the file --------------------------------------------------------------------------------- */

/* One of the three calls that make a file, for the user who watches the whole. */
typedef struct tile_call {
    const mw_tile_source *source;
    uint64_t call;
} tile_call;

static int tile_report(void *context, const char *stage, double fraction)
{
    enum { CALLS = 3, STEPS = 1000 };
    const tile_call *c = context;
    const mw_tile_source *s = c->source;
    (void)stage;
    return !mw__job_step(s->job, (s->file * CALLS + c->call) * STEPS + (uint64_t)(fraction * STEPS),
                         s->files * CALLS * STEPS);
}

static mw_status file_checksum(const char *path, uint64_t *checksum, mw_error *error)
{
    mw_prepared *map;
    mw_prepared_info info;
    mw_status status = mw_mesh_map(path, &(mw_map_options){.trust = 1}, &map, error);
    if (status) return status;
    mw_prepared_describe(map, &info);
    *checksum = info.checksum;
    mw_prepared_close(map);
    return MW_OK;
}

static mw_status copy_write(const tile_copy *c, const char *path, uint64_t *checksum,
                            mw_tile_holes *holes, mw_error *error)
{
    const mw_tile_source *s = c->source;
    mw_mesh *mesh = NULL;
    mw_locator *locator = NULL;
    tile_call call = {.source = s};
    const mw_progress watch = {.report = tile_report, .context = &call},
                      *progress = s->job->progress ? &watch : NULL;
    const mw_arrays arrays = {.points = c->points,
                              .point_count = c->vertex_count,
                              .triangles = c->corner,
                              .triangle_count = c->triangle_count};
    const mw_mesh_options meshes = {.threads = s->job->threads, .progress = progress};
    const mw_locator_options locators = {
        .border = 1, .fill = MW_FILL_YES, .threads = s->job->threads, .progress = progress};
    const mw_prepare_options files = {.values = &c->values, .progress = progress};
    mw_status status = mw_mesh_create(&arrays, &meshes, &mesh, error);
    call.call = 1;
    if (!status) status = mw_locator_create(mesh, &locators, &locator, error);
    call.call = 2;
    if (!status) status = mw_write_prepared(locator, path, &files, error);
    if (!status) status = file_checksum(path, checksum, error);
    if (!status && holes)
        status = mw__tile_holes_match(holes, s->locator, locator, c->number, error);
    mw_locator_destroy(locator);
    mw_mesh_destroy(mesh);
    return status;
}

mw_status mw__tile_file_write(const mw_tile_source *source, const uint32_t *triangles, size_t count,
                              const char *path, uint64_t *checksum, mw_tile_holes *holes,
                              mw_error *error)
{
    tile_copy copy = {.source = source, .number = triangles, .triangle_count = count};
    mw_status status = copy_make(&copy, error);
    if (!status) status = copy_write(&copy, path, checksum, holes, error);
    copy_release(&copy);
    return status;
}
