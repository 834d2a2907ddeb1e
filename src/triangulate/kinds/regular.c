/* regular.c - the regular triangulation, or weighted Delaunay triangulation [Aurenhammer 1987; Edelsbrunner,
 * Shah 1996]: points are inserted in random rounds along a Hilbert curve. It uses nothing of the Delaunay
 * triangulation but that there are three points that are on no line. */
#include "mesh/point_order.h"
#include "triangulate/constrained/brio.h"
#include "triangulate/kinds/kind_maker.h"
#include "triangulate/kinds/regular_insertion.h"

#include <stdlib.h>
#include <string.h>

/* The points in random rounds, each along the curve. NULL when out of memory or cancelled. */
static uint32_t *regular_order(const mw_triangulation *t)
{
    uint32_t n = t->point_count, *curve = mw__alloc(n, sizeof *curve), *order = NULL;
    mw_job_span outer = mw__job_part(t->job, 0.1);
    if (curve && mw__points_order(t->point, n, t->job, curve)) order = mw__brio_order(n);
    mw__job_part_end(t->job, outer);
    for (uint32_t i = 0; order && i < n; i++) order[i] = curve[order[i]];
    free(curve);
    return order;
}

static bool regular_insert_all(mw_regular *r, const mw_triangulation *t, const uint32_t *order)
{
    mw__job_stage(t->job, "inserting weighted points", 0.8);
    const uint32_t *v = t->tri[0].v;
    mw__regular_begin(r, v[0], v[1], v[2]); /* any triangle will do */
    for (uint32_t i = 0; i < t->point_count; i++) {
        mw__regular_insert(r, order[i]);
        if (!mw__job_step(t->job, i, t->point_count)) return false;
    }
    return true;
}

/* The triangles become those of the triangulation, which has room for them: no point adds any. */
static void regular_collect(const mw_regular *r, mw_triangulation *t)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < r->facet_count; i++)
        if (mw__regular_is_triangle(&r->facet[i])) t->tri[count++] = r->facet[i];
    t->tri_count = count;
}

/* Which points no triangle has. */
static void regular_tell_hidden(const mw_triangulation *t, uint8_t *hidden)
{
    memset(hidden, 1, t->point_count);
    for (uint32_t i = 0; i < t->tri_count; i++)
        for (uint32_t k = 0; k < 3; k++) hidden[t->tri[i].v[k]] = 0;
}

static mw_status regular_check_weights(const mw_triangulation *t, const double *weight, mw_error *error)
{
    for (uint32_t i = 0; weight && i < t->point_count; i++)
        if (!isfinite(weight[i])) return mw__fail_at(error, -1, i, "the weight of point %u is not finite", i);
    return MW_OK;
}

mw_status mw__make_regular(mw_triangulation *t, const mw_kind_options *options, mw_kind_report *report, mw_error *error)
{
    mw_regular r = {0};
    mw_status status = regular_check_weights(t, options->weights, error);
    if (status) return status;
    uint32_t *order = regular_order(t);
    uint8_t *hidden = mw__alloc(t->point_count, 1);
    bool done = order && hidden && mw__regular_create(&r, t->point, options->weights, t->point_count) &&
                regular_insert_all(&r, t, order);
    if (done) {
        regular_collect(&r, t);
        regular_tell_hidden(t, hidden);
        for (uint32_t i = 0; i < t->point_count; i++) report->hidden += hidden[i];
        report->hidden -= report->delaunay.duplicates;
        if (options->hidden) memcpy(options->hidden, hidden, t->point_count);
    }
    mw__regular_release(&r);
    free(hidden);
    free(order);
    return done ? MW_OK : mw__fail_memory(error);
}
