/* prepared_open.c - a mesh and a locator from the bytes of a prepared file. */
#include "base/hilbert.h"
#include "prepared/prepared.h"
#include "prepared/prepared_check.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* --- the header ------------------------------------------------------------------------------- */

static mw_status header_check_kind(const mw_prepared *p, size_t size, mw_error *error)
{
    const mw_prepared_header *h = &p->header;
    if (size < sizeof h->mark || memcmp(h->mark, MW_PREPARED_MARK, sizeof h->mark) != 0)
        return mw__fail(error, MW_ERROR_INPUT, "%.240s: this is not a prepared mesh (.mwm)",
                        p->name);
    if (size < offsetof(mw_prepared_header, bytes))
        return mw__prepared_fail(p, error, "it ends within its header");
    if (h->order == __builtin_bswap32(MW_PREPARED_ORDER))
        return mw__fail(error, MW_ERROR_INPUT,
                        "%.240s: a prepared mesh in the byte order of another machine: prepare it "
                        "again on this one",
                        p->name);
    if (h->order != MW_PREPARED_ORDER)
        return mw__prepared_fail(p, error, "its byte order is not known");
    if (h->version != MW_PREPARED_VERSION)
        return mw__fail(error, MW_ERROR_INPUT,
                        "%.240s: a prepared mesh of format version %" PRIu32
                        ", but this program knows version %d only: prepare it again from its mesh",
                        p->name, h->version, MW_PREPARED_VERSION);
    return MW_OK;
}

static mw_status header_check(mw_prepared *p, size_t size, mw_error *error)
{
    mw_prepared_header *h = &p->header, fresh;
    memcpy(h, p->bytes, size < sizeof *h ? size : sizeof *h);
    mw_status status = header_check_kind(p, size, error);
    if (status) return status;
    if (size < sizeof *h) return mw__prepared_fail(p, error, "it ends within its header");
    if (mw__prepared_header_checksum(h) != h->checksum)
        return mw__prepared_fail(p, error, "the checksum of its header is wrong");
    if (!mw__prepared_facts_fit(&h->facts))
        return mw__prepared_fail(p, error, "its counts are not those of a mesh");
    if (h->bytes != size)
        return mw__prepared_fail(p, error, "it has %zu bytes, but should have %" PRIu64, size,
                                 h->bytes);
    fresh = *h;
    mw__prepared_lay_out(&fresh);
    if (memcmp(&fresh, h, sizeof fresh) != 0)
        return mw__prepared_fail(p, error, "its parts do not have the lengths of its counts");
    return MW_OK;
}

/* --- the parts -------------------------------------------------------------------------------- */

/* Nothing in the file is ever written, although the structures of the library could. */
static void *part_records(const mw_prepared *p, mw_prepared_kind kind)
{
    return (void *)(uintptr_t)mw__prepared_records(p, kind);
}

static void mesh_attach(mw_prepared *p)
{
    const mw_prepared_facts *f = &p->header.facts;
    p->mesh = (mw_mesh){
        .point = part_records(p, MW_PART_POINTS),
        .tri = part_records(p, MW_PART_TRIANGLES),
        .triangle_slot = part_records(p, MW_PART_TRIANGLE_SLOTS),
        .vertex_slot = part_records(p, MW_PART_VERTEX_SLOTS),
        .vertex_number = part_records(p, MW_PART_VERTEX_NUMBERS),
        .point_count = f->points,
        .tri_count = f->triangles,
        .flat_count = f->flat,
        .reversed_count = f->reversed,
        .border_count = f->border,
        .opposite = (f->flags & MW_PREPARED_OPPOSITE) != 0,
    };
}

static void tiling_attach(mw_prepared *p)
{
    const mw_prepared_facts *f = &p->header.facts;
    const bool own = (f->flags & MW_PREPARED_OWN_TILES) != 0;
    p->locator.tiling = (mw_tiling){
        .point = p->mesh.point,
        .tri = own ? part_records(p, MW_PART_TILES) : p->mesh.tri,
        .owner = part_records(p, MW_PART_OWNERS),
        .point_count = f->points,
        .tri_count = f->tiles,
        .ghost_count = f->ghosts,
        .hole_count = f->holes,
        .borrowed = !own,
        .cut = (f->flags & MW_PREPARED_CUT) != 0,
        .embedding = true,
    };
}

static mw_chains chains_attach(const mw_prepared *p)
{
    const mw_prepared_facts *f = &p->header.facts;
    return (mw_chains){.edge = part_records(p, MW_PART_CHAIN_EDGES),
                       .from = part_records(p, MW_PART_CHAIN_STARTS),
                       .tile = part_records(p, MW_PART_CHAIN_TILES),
                       .bottom = {f->chain_bottom[0], f->chain_bottom[1]},
                       .top = {f->chain_top[0], f->chain_top[1]},
                       .tiles = f->chain_tiles,
                       .points = f->chain_points};
}

static void guide_attach(mw_prepared *p)
{
    const mw_prepared_facts *f = &p->header.facts;
    mw_index *guide = &p->locator.guide;
    const mw_grid grid = {.lattice = f->lattice, .tile = part_records(p, MW_PART_CELLS)};
    guide->sort_batches = (f->flags & MW_PREPARED_SORTED) != 0;
    switch ((mw_prepared_guide)f->guide) {
    case MW_GUIDE_GRID:
        guide->start = MW_START_GRID;
        guide->grid = grid;
        break;
    case MW_GUIDE_CURVE:
        guide->start = MW_START_CURVE;
        guide->curve = (mw_curve){.hilbert = mw__hilbert(p->locator.low, p->locator.high),
                                  .sample = part_records(p, MW_PART_SAMPLES),
                                  .from = part_records(p, MW_PART_BUCKETS),
                                  .count = f->samples,
                                  .shift = f->sample_shift,
                                  .near = f->sample_near,
                                  .regular = true,
                                  .sparse = grid};
        break;
    case MW_GUIDE_CHAINS:
        guide->start = MW_START_CHAINS;
        guide->chains = chains_attach(p);
        break;
    case MW_GUIDE_NONE:
    case MW_GUIDE_COUNT: break;
    }
    if (f->guide == MW_GUIDE_CHAINS || f->chain_edges == 0) return;
    p->locator.fallback = (mw_index){.start = MW_START_CHAINS, .chains = chains_attach(p)};
}

static void border_attach(mw_prepared *p)
{
    const mw_prepared_facts *f = &p->header.facts;
    mw_border_tree *border = &p->locator.border_tree;
    p->locator.has_border = (f->flags & MW_PREPARED_BORDER) != 0;
    if (!p->locator.has_border) return;
    mw__box_tree_lay_out(&border->tree, f->border_edges);
    border->tree.box = part_records(p, MW_PART_BORDER_BOXES);
    border->edge = part_records(p, MW_PART_BORDER_EDGES);
    border->edge_count = f->border_edges;
}

static void locator_attach(mw_prepared *p, uint32_t threads)
{
    const mw_prepared_facts *f = &p->header.facts;
    mw_locator *locator = &p->locator;
    *locator = (mw_locator){
        .mesh = &p->mesh,
        .low = {f->low[0], f->low[1]},
        .high = {f->high[0], f->high[1]},
        .auto_walk = f->flags & MW_PREPARED_CELESTIAL ? MW_WALK_CELESTIAL : MW_WALK_REMEMBERING,
        .finish = f->flags & MW_PREPARED_STOCHASTIC ? MW_WALK_STOCHASTIC : MW_WALK_REMEMBERING,
        .centre = f->centre,
        .threads = threads,
    };
    tiling_attach(p);
    guide_attach(p);
    border_attach(p);
    mw__locator_scale(locator);
}

/* --- what is kept beside the mesh ------------------------------------------------------------- */

/* The next `count` names; false when there are too few. */
static bool names_take(const char **next, const char *end, char **names, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const char *stop = *next < end ? memchr(*next, 0, (size_t)(end - *next)) : NULL;
        if (!stop) return false;
        names[i] = (char *)(uintptr_t)*next;
        *next = stop + 1;
    }
    return true;
}

static bool values_name(mw_prepared *p)
{
    const mw_prepared_facts *f = &p->header.facts;
    mw_mesh_file *v = &p->values;
    const char *names = mw__prepared_records(p, MW_PART_NAMES), *next = names ? names : "",
               *end = next + f->name_bytes;
    return names_take(&next, end, v->field_names, f->fields) &&
           names_take(&next, end, v->triangle_field_names, f->triangle_fields) &&
           names_take(&next, end, v->mark_names, f->marks) &&
           names_take(&next, end, &v->crs, (f->flags & MW_PREPARED_CRS) != 0) && next == end;
}

static bool values_alloc(mw_prepared *p)
{
    const mw_prepared_facts *f = &p->header.facts;
    mw_mesh_file *v = &p->values;
    v->field_names = mw__calloc(f->fields, sizeof *v->field_names);
    v->fields = mw__calloc(f->fields, sizeof *v->fields);
    v->triangle_field_names = mw__calloc(f->triangle_fields, sizeof *v->triangle_field_names);
    v->triangle_fields = mw__calloc(f->triangle_fields, sizeof *v->triangle_fields);
    v->mark_names = mw__calloc(f->marks, sizeof *v->mark_names);
    p->mesh.field = mw__calloc(f->fields, sizeof *p->mesh.field);
    return v->field_names && v->fields && v->triangle_field_names && v->triangle_fields &&
           v->mark_names && p->mesh.field;
}

static mw_status values_attach(mw_prepared *p, mw_error *error)
{
    const mw_prepared_facts *f = &p->header.facts;
    mw_mesh_file *v = &p->values;
    double *fields = part_records(p, MW_PART_FIELDS),
           *triangle_fields = part_records(p, MW_PART_TRIANGLE_FIELDS);
    if (!values_alloc(p)) return mw__fail_memory(error);
    if (!values_name(p))
        return mw__prepared_fail(
            p, error, "part 'names': there are more or fewer names than the header says");
    for (size_t i = 0; i < f->fields; i++) v->fields[i] = fields + i * f->points;
    for (size_t i = 0; i < f->triangle_fields; i++)
        v->triangle_fields[i] = triangle_fields + i * f->triangles;
    for (size_t i = 0; i < f->fields; i++)
        p->mesh.field[i] =
            (mw_field){.name = v->field_names[i], .values = v->fields[i], .borrowed = true};
    p->mesh.field_count = f->fields;
    v->point_count = f->points;
    v->triangle_count = f->triangles;
    v->field_count = f->fields;
    v->triangle_field_count = f->triangle_fields;
    v->faces = part_records(p, MW_PART_FACES);
    v->face_count = f->faces;
    v->first_number = (int)f->first_number;
    v->step_count = f->steps;
    v->edges = part_records(p, MW_PART_MARKED_EDGES);
    v->edge_count = f->marked_edges;
    v->mark_count = f->marks;
    return MW_OK;
}

/* --- all of it -------------------------------------------------------------------------------- */

mw_status mw__prepared_open(mw_prepared *p, const char *name, const void *bytes, size_t size,
                            bool trust, mw_job *job, mw_error *error)
{
    p->bytes = bytes;
    p->name = name;
    p->trusted = trust;
    mw_status status = header_check(p, size, error);
    if (status) return status;
    mesh_attach(p);
    locator_attach(p, job->threads);
    status = values_attach(p, error);
    if (status || trust) return status;
    mw_job_span outer = mw__job_part(job, 0.95);
    status = mw__prepared_check(p, job, error);
    mw__job_part_end(job, outer);
    if (status) return status;
    mw__job_stage(job, "measuring the extent", 0.05);
    mw__locator_measure(&p->locator, job);
    if (mw__job_stopped(job)) return mw__fail_memory(error);
    guide_attach(p); /* by the extent that is the mesh's */
    return MW_OK;
}

void mw__prepared_release(mw_prepared *p)
{
    mw__late_chains_destroy(p->locator.late);
    mw__mesh_release_fields(&p->mesh);
    free(p->values.field_names);
    free(p->values.fields);
    free(p->values.triangle_field_names);
    free(p->values.triangle_fields);
    free(p->values.mark_names);
}

mw_mesh *mw_prepared_mesh(mw_prepared *prepared)
{
    return &prepared->mesh;
}

const mw_locator *mw_prepared_locator(const mw_prepared *prepared)
{
    return &prepared->locator;
}

const mw_mesh_file *mw_prepared_values(const mw_prepared *prepared)
{
    return &prepared->values;
}

void mw_prepared_describe(const mw_prepared *prepared, mw_prepared_info *info)
{
    const mw_locator *locator = &prepared->locator;
    *info = (mw_prepared_info){
        .bytes = prepared->header.bytes,
        .checksum = prepared->header.checksum,
        .low = {locator->low[0], locator->low[1]},
        .high = {locator->high[0], locator->high[1]},
        .version = prepared->header.version,
        .border = locator->has_border,
        .trusted = prepared->trusted,
    };
}
