/* mend.c - the public call: reads the arrays, carries out the repairs in their order, numbers what
 * is left. */
#include "mend/mend_work.h"
#include "base/options.h"
#include "mesh/arrays.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* --- input --- */

static mw_status mend_check_arguments(const mw_arrays *arrays, const mw_mend_options *options,
                                      mw_error *error)
{
    mw_status status = MW_RESERVED_CHECK(mw_mend_options, options, error);
    if (status) return status;
    if (options->repairs > MW_REPAIR_ALL || options->space > 1)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the option 'repairs' or 'space' has an unknown value");
    if (!(options->tolerance >= 0 && options->tolerance < INFINITY))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the tolerance is negative, or not finite");
    return mw__arrays_validate(arrays, options->space ? 3 : 2, error);
}

/* Copy the triangles. A number out of range is kept for the list of changes. */
static mw_status mend_work_create(mw_mend_work *w, const mw_arrays *arrays, mw_error *error)
{
    w->kept = mw__alloc(w->vertex_count, sizeof *w->kept);
    w->triangle = mw__alloc(arrays->triangle_count, sizeof *w->triangle);
    if (!w->kept || !w->triangle) return mw__fail_memory(error);
    for (uint32_t v = 0; v < w->vertex_count; v++) w->kept[v] = v;
    w->count = arrays->triangle_count;
    for (uint32_t t = 0; t < w->count; t++) {
        w->triangle[t].from = t;
        for (size_t k = 0; k < 3; k++) {
            uint32_t v = mw__index_at(arrays, 3 * (size_t)t + k);
            w->triangle[t].v[k] = v;
            if (v >= w->vertex_count && !(w->repairs & MW_REPAIR_DROP))
                return mw__fail_at(
                    error, t, -1,
                    "triangle %" PRIu32
                    ": local vertex %zu does not exist; the repair 'drop' removes such triangles",
                    t, k);
        }
    }
    return MW_OK;
}

static void mend_work_release(mw_mend_work *w)
{
    free(w->kept);
    free(w->triangle);
    free(w->changes);
}

/* --- work --- */

/* Where triangles overlap, splits make duplicates; and dropping a triangle makes edges of its
 * neighbours border edges. So both are repeated until nothing changes. Exact splits only make
 * triangles smaller, so they come to an end; splits within a tolerance may not. */
#define MOST_PASSES 64

static bool mend_drop_and_split(mw_mend_work *w)
{
    bool changed = true;
    for (int pass = 0; pass < MOST_PASSES && changed; pass++) {
        double share = 0.6 * ldexp(1, -pass - 1);
        mw__job_stage(w->job, "dropping triangles", 0.2 * share);
        if (w->repairs & MW_REPAIR_DROP && !mw__mend_drop(w, &changed)) return false;
        changed = false;
        mw__job_stage(w->job, "splitting triangles", 0.8 * share);
        if (w->repairs & MW_REPAIR_SPLIT && !mw__mend_split(w, &changed)) return false;
    }
    return true;
}

static bool mend_repair(mw_mend_work *w)
{
    if (w->repairs & MW_REPAIR_WELD && !mw__mend_weld(w)) return false;
    if (!mend_drop_and_split(w)) return false;
    return !(w->repairs & MW_REPAIR_ORIENT) || mw__mend_orient(w);
}

/* --- result --- */

static bool mended_number_vertices(const mw_mend_work *w, mw_mended *m)
{
    m->vertex_to = mw__alloc(w->vertex_count, sizeof *m->vertex_to);
    m->vertex_from = mw__alloc(w->vertex_count, sizeof *m->vertex_from);
    if (!m->vertex_to || !m->vertex_from) return false;
    for (uint32_t v = 0; v < w->vertex_count; v++) {
        /* A vertex is welded to a lower one, which has its number. */
        bool stays = w->kept[v] == v;
        if (stays) m->vertex_from[m->vertex_count] = v;
        m->vertex_to[v] = stays ? (uint32_t)m->vertex_count++ : m->vertex_to[w->kept[v]];
    }
    return true;
}

static bool mended_create(mw_mend_work *w, mw_mended *m)
{
    if (!mended_number_vertices(w, m)) return false;
    m->triangle_count = w->count;
    m->triangles = mw__alloc(3 * w->count, sizeof *m->triangles);
    m->triangle_from = mw__alloc(w->count, sizeof *m->triangle_from);
    if (!m->triangles || !m->triangle_from) return false;
    for (size_t t = 0; t < w->count; t++) {
        m->triangle_from[t] = w->triangle[t].from;
        for (size_t k = 0; k < 3; k++) m->triangles[3 * t + k] = m->vertex_to[w->triangle[t].v[k]];
    }
    m->changes = w->changes;
    m->change_count = w->change_count;
    w->changes = NULL;
    return true;
}

static mw_status mend_work_status(const mw_mend_work *w, bool done, mw_error *error)
{
    if (done) return MW_OK;
    if (w->too_large)
        return mw__fail(error, MW_ERROR_LIMIT, "splits make more than %" PRIu32 " triangles",
                        MW_MAX_TRIANGLES);
    return mw__fail_memory(error);
}

mw_status mw_mend_arrays(const mw_arrays *arrays, const mw_mend_options *options, mw_mended *mended,
                         mw_error *error)
{
    static const mw_mend_options defaults;
    if (!mended)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the pointer to the new mended mesh is NULL");
    *mended = (mw_mended){0};
    if (!options) options = &defaults;
    mw_status status = mend_check_arguments(arrays, options, error);
    if (status) return status;
    mw_job job = mw__job(1, options->progress);
    size_t dimension = options->space ? 3 : 2;
    mw_mend_work w = {.points = arrays->points,
                      .stride = arrays->point_stride ? arrays->point_stride : dimension,
                      .dimension = dimension,
                      .vertex_count = (uint32_t)arrays->point_count,
                      .repairs = options->repairs ? options->repairs : MW_REPAIR_ALL,
                      .tolerance = options->tolerance,
                      .job = &job};
    status = mend_work_create(&w, arrays, error);
    if (!status) status = mend_work_status(&w, mend_repair(&w) && mended_create(&w, mended), error);
    status = mw__job_end(&job, status, error);
    mend_work_release(&w);
    if (status) mw_mended_release(mended);
    return status;
}

void mw_mended_release(mw_mended *mended)
{
    if (!mended) return;
    free(mended->triangles);
    free(mended->vertex_from);
    free(mended->vertex_to);
    free(mended->triangle_from);
    free(mended->changes);
    *mended = (mw_mended){0};
}

void mw_mend_change_describe(const mw_mend_change *change, char *text, size_t size)
{
    uint32_t t = change->triangle, v = change->vertex, other = change->other;
    switch (change->kind) {
    case MW_MEND_WELDED:
        snprintf(text, size, "vertex %" PRIu32 ": welded to vertex %" PRIu32, v, other);
        return;
    case MW_MEND_DROPPED_MISSING:
        snprintf(text, size, "triangle %" PRIu32 ": dropped: it has a vertex that does not exist",
                 t);
        return;
    case MW_MEND_DROPPED_INFINITE:
        snprintf(text, size, "triangle %" PRIu32 ": dropped: vertex %" PRIu32 " is not finite", t,
                 v);
        return;
    case MW_MEND_DROPPED_REPEATED:
        snprintf(text, size, "triangle %" PRIu32 ": dropped: it has vertex %" PRIu32 " twice", t,
                 v);
        return;
    case MW_MEND_DROPPED_DUPLICATE:
        snprintf(text, size,
                 "triangle %" PRIu32 ": dropped: it has the vertices of triangle %" PRIu32, t,
                 other);
        return;
    case MW_MEND_DROPPED_FLAT:
        snprintf(text, size, "triangle %" PRIu32 ": dropped: it has no area", t);
        return;
    case MW_MEND_SPLIT:
        snprintf(text, size, "triangle %" PRIu32 ": split at vertex %" PRIu32, t, v);
        return;
    case MW_MEND_TURNED: snprintf(text, size, "triangle %" PRIu32 ": turned", t); return;
    case MW_MEND_CHANGE_COUNT: break;
    }
    snprintf(text, size, "an unknown change");
}
