/* prepared_write.c - writes a mesh and its locator as a prepared file. A checksum stands
 * before its part, so each part is read twice: for its checksum, and to be written. */
#include "base/checksum.h"
#include "base/job.h"
#include "base/options.h"
#include "io/text/byte_source.h"
#include "io/text/output.h"
#include "prepared/prepared.h"

#include <stdlib.h>
#include <string.h>

/* The arrays of a file to be written. */
typedef struct prepared_writer {
    const mw_locator *locator;
    const mw_mesh_file *values;
    mw_mesh_file own; /* the values, where none were given */
    mw_prepared_header header;
    const void *records[MW_PART_COUNT]; /* of parts that are one array */
    double *heights;                    /* of the vertices of values->points; or NULL */
    char *names;
} prepared_writer;

mw_status mw__prepared_check_locator(const mw_locator *locator, mw_error *error)
{
    const mw_tiling *tiling = &locator->tiling;
    const char *why = !tiling->embedding     ? "it is of a mesh that is not an embedding"
                      : tiling->border_loops ? "its pockets and holes are not filled"
                      : tiling->tile_of      ? "its mesh is edited"
                                             : NULL;
    return why ? mw__fail(error, MW_ERROR_ARGUMENT, "the locator cannot be prepared: %s", why)
               : MW_OK;
}

static mw_status values_check(const prepared_writer *w, mw_error *error)
{
    const mw_mesh *mesh = w->locator->mesh;
    const mw_mesh_file *v = w->values;
    if (v->point_count != mesh->point_count || v->triangle_count != mesh->tri_count)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the values have %zu vertices and %zu triangles, the mesh has others",
                        v->point_count, v->triangle_count);
    if (v->field_count > MW_COLUMN_LIMIT - 1 || v->triangle_field_count > MW_COLUMN_LIMIT)
        return mw__fail(error, MW_ERROR_LIMIT, "a prepared mesh has at most %d fields",
                        MW_COLUMN_LIMIT);
    for (size_t i = 0; w->heights && i < v->field_count; i++)
        if (strcmp(v->field_names[i], "z") == 0)
            return mw__fail(error, MW_ERROR_INPUT, "both the heights and a field are called z");
    return MW_OK;
}

/* --- what is written -------------------------------------------------------------------------- */

/* The fields of the mesh as values. */
static bool writer_take_fields(prepared_writer *w)
{
    const mw_mesh *mesh = w->locator->mesh;
    mw_mesh_file *own = &w->own;
    own->field_names = mw__calloc(mesh->field_count, sizeof *own->field_names);
    own->fields = mw__calloc(mesh->field_count, sizeof *own->fields);
    if (!own->field_names || !own->fields) return false;
    for (; own->field_count < mesh->field_count; own->field_count++) {
        own->field_names[own->field_count] = mesh->field[own->field_count].name;
        own->fields[own->field_count] = mesh->field[own->field_count].values;
    }
    own->point_count = mesh->point_count;
    own->triangle_count = mesh->tri_count;
    w->values = own;
    return true;
}

/* Heights stand between x and y of the next vertex: they are gathered. */
static bool writer_take_heights(prepared_writer *w)
{
    const mw_mesh_file *v = w->values;
    if (!v->has_z || !v->points) return true;
    w->heights = mw__alloc(v->point_count, sizeof *w->heights);
    for (size_t i = 0; i < v->point_count && w->heights; i++) w->heights[i] = v->points[3 * i + 2];
    return w->heights;
}

static size_t name_append(char *to, const char *name)
{
    const size_t size = strlen(name) + 1;
    if (to) memcpy(to, name, size);
    return size;
}

/* Write all names, or, where `to` is NULL, tell how many bytes they have. */
static size_t names_write(const prepared_writer *w, char *to)
{
    const mw_mesh_file *v = w->values;
    size_t used = w->heights ? name_append(to, "z") : 0;
    for (size_t i = 0; i < v->field_count; i++)
        used += name_append(to ? to + used : NULL, v->field_names[i]);
    for (size_t i = 0; i < v->triangle_field_count; i++)
        used += name_append(to ? to + used : NULL, v->triangle_field_names[i]);
    for (size_t i = 0; i < v->mark_count; i++)
        used += name_append(to ? to + used : NULL, v->mark_names[i]);
    if (v->crs) used += name_append(to ? to + used : NULL, v->crs);
    return used;
}

static mw_status writer_take_names(prepared_writer *w, mw_error *error)
{
    const size_t size = names_write(w, NULL);
    if (size > UINT32_MAX) return mw__fail(error, MW_ERROR_LIMIT, "the names are too long");
    w->names = mw__alloc(size, 1);
    if (!w->names) return mw__fail_memory(error);
    names_write(w, w->names);
    w->header.facts.name_bytes = (uint32_t)size;
    w->records[MW_PART_NAMES] = w->names;
    return MW_OK;
}

static void writer_take_values(prepared_writer *w)
{
    mw_prepared_facts *f = &w->header.facts;
    const mw_mesh_file *v = w->values;
    f->fields = (uint32_t)v->field_count + (w->heights != NULL);
    f->triangle_fields = (uint32_t)v->triangle_field_count;
    f->faces = v->faces ? (uint32_t)v->face_count : 0;
    f->first_number = v->first_number != 0;
    f->marked_edges = (uint32_t)v->edge_count;
    f->marks = (uint32_t)v->mark_count;
    f->steps = (uint32_t)v->step_count;
    if (v->faces) f->flags |= MW_PREPARED_FACES;
    if (v->crs) f->flags |= MW_PREPARED_CRS;
    w->records[MW_PART_FACES] = v->faces;
    w->records[MW_PART_MARKED_EDGES] = v->edges;
}

static void writer_take_mesh(prepared_writer *w)
{
    const mw_mesh *mesh = w->locator->mesh;
    mw_prepared_facts *f = &w->header.facts;
    f->points = mesh->point_count;
    f->triangles = mesh->tri_count;
    f->flat = mesh->flat_count;
    f->reversed = mesh->reversed_count;
    f->border = mesh->border_count;
    if (mesh->opposite) f->flags |= MW_PREPARED_OPPOSITE;
    if (mesh->vertex_slot) f->flags |= MW_PREPARED_LAID_OUT;
    if (mesh->triangle_slot) f->flags |= MW_PREPARED_TRIANGLES_LAID;
    w->records[MW_PART_POINTS] = mesh->point;
    w->records[MW_PART_TRIANGLES] = mesh->tri;
    w->records[MW_PART_TRIANGLE_SLOTS] = mesh->triangle_slot;
    w->records[MW_PART_VERTEX_SLOTS] = mesh->vertex_slot;
    w->records[MW_PART_VERTEX_NUMBERS] = mesh->vertex_number;
}

static void writer_take_locator(prepared_writer *w)
{
    const mw_locator *locator = w->locator;
    const mw_tiling *tiling = &locator->tiling;
    mw_prepared_facts *f = &w->header.facts;
    f->tiles = tiling->tri_count;
    f->ghosts = tiling->ghost_count;
    f->holes = tiling->hole_count;
    f->centre = locator->centre;
    for (int k = 0; k < 2; k++) {
        f->low[k] = locator->low[k];
        f->high[k] = locator->high[k];
    }
    if (!tiling->borrowed) f->flags |= MW_PREPARED_OWN_TILES;
    if (tiling->cut) f->flags |= MW_PREPARED_CUT;
    if (locator->auto_walk == MW_WALK_CELESTIAL) f->flags |= MW_PREPARED_CELESTIAL;
    if (locator->finish == MW_WALK_STOCHASTIC) f->flags |= MW_PREPARED_STOCHASTIC;
    w->records[MW_PART_TILES] = tiling->tri;
    w->records[MW_PART_OWNERS] = tiling->owner;
    if (!locator->has_border) return;
    f->flags |= MW_PREPARED_BORDER;
    f->border_edges = locator->border_tree.edge_count;
    w->records[MW_PART_BORDER_EDGES] = locator->border_tree.edge;
    w->records[MW_PART_BORDER_BOXES] = locator->border_tree.tree.box;
}

static void writer_take_grid(prepared_writer *w, const mw_grid *grid)
{
    w->header.facts.lattice = grid->lattice;
    w->records[MW_PART_CELLS] = grid->tile;
}

static void writer_take_chains(prepared_writer *w, const mw_chains *chains)
{
    mw_prepared_facts *f = &w->header.facts;
    f->chain_points = chains->points;
    f->chain_tiles = chains->tiles;
    f->chain_edges = chains->from[chains->tiles + 2];
    for (int k = 0; k < 2; k++) {
        f->chain_bottom[k] = chains->bottom[k];
        f->chain_top[k] = chains->top[k];
    }
    w->records[MW_PART_CHAIN_EDGES] = chains->edge;
    w->records[MW_PART_CHAIN_STARTS] = chains->from;
    w->records[MW_PART_CHAIN_TILES] = chains->tile;
}

static void writer_take_guide(prepared_writer *w)
{
    const mw_index *guide = &w->locator->guide, *fallback = &w->locator->fallback;
    mw_prepared_facts *f = &w->header.facts;
    if (guide->sort_batches) f->flags |= MW_PREPARED_SORTED;
    if (guide->start == MW_START_GRID) {
        f->guide = MW_GUIDE_GRID;
        writer_take_grid(w, &guide->grid);
    } else if (guide->start == MW_START_CURVE) {
        f->guide = MW_GUIDE_CURVE;
        f->samples = guide->curve.count;
        f->sample_shift = guide->curve.shift;
        f->sample_near = guide->curve.near;
        w->records[MW_PART_SAMPLES] = guide->curve.sample;
        w->records[MW_PART_BUCKETS] = guide->curve.from;
        writer_take_grid(w, &guide->curve.sparse);
    } else if (guide->start == MW_START_CHAINS && guide->chains.tiles > 0) {
        f->guide = MW_GUIDE_CHAINS;
        writer_take_chains(w, &guide->chains);
    }
    if (fallback->start == MW_START_CHAINS && fallback->chains.tiles > 0)
        writer_take_chains(w, &fallback->chains);
}

static mw_status writer_gather(prepared_writer *w, mw_error *error)
{
    if (!w->values && !writer_take_fields(w)) return mw__fail_memory(error);
    if (!writer_take_heights(w)) return mw__fail_memory(error);
    mw_status status = values_check(w, error);
    if (!status) status = writer_take_names(w, error);
    if (status) return status;
    writer_take_values(w);
    writer_take_mesh(w);
    writer_take_locator(w);
    writer_take_guide(w);
    memcpy(w->header.mark, MW_PREPARED_MARK, sizeof w->header.mark);
    w->header.version = MW_PREPARED_VERSION;
    w->header.order = MW_PREPARED_ORDER;
    mw__prepared_lay_out(&w->header);
    return MW_OK;
}

/* --- writing ---------------------------------------------------------------------------------- */

/* Takes the next bytes of a part. */
typedef void part_sink(void *sink, const void *bytes, size_t size);

static void fields_pour(double *const *fields, size_t count, size_t length, part_sink *pour,
                        void *sink)
{
    for (size_t i = 0; i < count; i++) pour(sink, fields[i], length * sizeof(double));
}

/* Give all bytes of a part to a sink. */
static void part_pour(const prepared_writer *w, mw_prepared_kind kind, part_sink *pour, void *sink)
{
    const mw_mesh_file *v = w->values;
    if (kind == MW_PART_FIELDS) {
        if (w->heights) fields_pour(&w->heights, 1, v->point_count, pour, sink);
        fields_pour(v->fields, v->field_count, v->point_count, pour, sink);
    } else if (kind == MW_PART_TRIANGLE_FIELDS) {
        fields_pour(v->triangle_fields, v->triangle_field_count, v->triangle_count, pour, sink);
    } else if (w->header.part[kind].bytes) {
        pour(sink, w->records[kind], (size_t)w->header.part[kind].bytes);
    }
}

static void sum_pour(void *sink, const void *bytes, size_t size)
{
    mw__checksum_add(sink, bytes, size);
}

/* In pieces, each a step of the job. Large ones let the system keep the file in large pages, which
 * a map of it then has. */
static void output_pour(void *sink, const void *bytes, size_t size)
{
    enum { PIECE = 1 << 24 };
    for (size_t done = 0; done < size && !mw_output_failed(sink); done += PIECE)
        mw_output_write(sink, (const char *)bytes + done,
                        size - done < PIECE ? size - done : PIECE);
}

static void writer_sum(prepared_writer *w)
{
    for (int kind = 0; kind < MW_PART_COUNT; kind++) {
        mw_checksum sum = {0};
        if (w->header.part[kind].bytes == 0) continue;
        part_pour(w, (mw_prepared_kind)kind, sum_pour, &sum);
        w->header.part[kind].checksum = mw__checksum_end(&sum);
    }
    w->header.checksum = mw__prepared_header_checksum(&w->header);
}

/* Zeros up to where the next part begins. */
static void output_align(mw_output *output, uint64_t written)
{
    static const char zeros[MW_PREPARED_ALIGN];
    const uint64_t over = written % MW_PREPARED_ALIGN;
    if (over) mw_output_write(output, zeros, (size_t)(MW_PREPARED_ALIGN - over));
}

static mw_status writer_write(const prepared_writer *w, const char *path, mw_job *job,
                              mw_error *error)
{
    mw_output *output;
    mw_status status = mw_output_open(path, &output, error);
    if (status) return status;
    mw__output_watch(output, job, w->header.bytes);
    mw_output_write(output, &w->header, sizeof w->header);
    output_align(output, sizeof w->header);
    for (int kind = 0; kind < MW_PART_COUNT; kind++) {
        part_pour(w, (mw_prepared_kind)kind, output_pour, output);
        output_align(output, w->header.part[kind].bytes);
    }
    return mw_output_close(output, 1, error);
}

static mw_status prepared_write(const mw_locator *locator, const char *path,
                                const mw_mesh_file *values, mw_job *job, mw_error *error)
{
    prepared_writer w = {.locator = locator, .values = values};
    mw__job_stage(job, "writing", 1);
    mw_status status = writer_gather(&w, error);
    if (!status) {
        writer_sum(&w);
        status = writer_write(&w, path, job, error);
    }
    free(w.own.field_names);
    free(w.own.fields);
    free(w.heights);
    free(w.names);
    return status;
}

mw_status mw_write_prepared(const mw_locator *locator, const char *path,
                            const mw_prepare_options *options, mw_error *error)
{
    static const mw_prepare_options defaults;
    if (!locator || !path)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_write_prepared: the locator or the path is NULL");
    if (!options) options = &defaults;
    mw_status status = MW_RESERVED_CHECK(mw_prepare_options, options, error);
    if (!status) status = mw__prepared_check_locator(locator, error);
    if (status) return status;
    mw_job job = mw__job(1, options->progress);
    return mw__job_end(&job, prepared_write(locator, path, options->values, &job, error), error);
}
