/* regular.c - the regular triangulation, or weighted Delaunay triangulation [Aurenhammer 1987;
 * Edelsbrunner, Shah 1996]: points are inserted in random rounds along a Hilbert curve. It uses
 * nothing of the Delaunay triangulation but that there are three points that are on no line. */
#include "mesh/point_order.h"
#include "triangulate/constrained/brio.h"
#include "triangulate/kinds/kind_maker.h"
#include "triangulate/kinds/regular_insertion.h"

#include <stdlib.h>
#include <string.h>

/* The points along a curve, so that what lies close in the plane lies close in memory; slot i
 * holds point number[i]. */
typedef struct regular_points {
    uint32_t *number, *order; /* order: of insertion, by slots */
    mw_point *point;
    double *weight;
} regular_points;

static void regular_points_release(regular_points *p)
{
    free(p->number);
    free(p->order);
    free(p->point);
    free(p->weight);
}

/* False when out of memory or cancelled; to be released in any case. */
static bool regular_points_make(regular_points *p, const mw_triangulation *t, const double *weights)
{
    uint32_t n = t->point_count;
    *p = (regular_points){mw__alloc(n, sizeof *p->number), mw__brio_order(n),
                          mw__alloc_lines(n, sizeof *p->point), mw__alloc(n, sizeof *p->weight)};
    mw_job_span outer = mw__job_part(t->job, 0.1);
    bool done = p->number && p->order && p->point && p->weight &&
                mw__points_order(t->point, n, t->job, p->number);
    mw__job_part_end(t->job, outer);
    for (uint32_t i = 0; done && i < n; i++) {
        p->point[i] = t->point[p->number[i]];
        p->weight[i] = weights ? weights[p->number[i]] : 0;
    }
    return done;
}

/* Any triangle will do to begin with. */
static void regular_begin(mw_regular *r, const mw_triangulation *t, const regular_points *p)
{
    uint32_t slot[3] = {0};
    for (uint32_t i = 0; i < t->point_count; i++)
        for (uint32_t k = 0; k < 3; k++)
            if (p->number[i] == t->tri[0].v[k]) slot[k] = i;
    mw__regular_begin(r, slot[0], slot[1], slot[2]);
}

static bool regular_insert_all(mw_regular *r, const mw_triangulation *t, const regular_points *p)
{
    mw__job_stage(t->job, "inserting weighted points", 0.8);
    regular_begin(r, t, p);
    for (uint32_t i = 0; i < t->point_count; i++) {
        mw__regular_insert(r, p->order[i]);
        if (!mw__job_step(t->job, i, t->point_count)) return false;
    }
    return true;
}

/* The triangles become those of the triangulation, which has room for them: no point adds any. */
static void regular_collect(const mw_regular *r, mw_triangulation *t)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < r->facet_count; i++) {
        const mw_triangle *f = &r->facet[i];
        if (!mw__regular_is_triangle(f)) continue;
        mw_triangle *made = &t->tri[count++];
        *made = *f;
        for (uint32_t k = 0; k < 4; k++) made->v[k] = r->number[f->v[k]];
    }
    t->tri_count = count;
}

/* Which points no triangle has. */
static void regular_tell_hidden(const mw_triangulation *t, uint8_t *hidden)
{
    memset(hidden, 1, t->point_count);
    for (uint32_t i = 0; i < t->tri_count; i++)
        for (uint32_t k = 0; k < 3; k++) hidden[t->tri[i].v[k]] = 0;
}

static mw_status regular_check_weights(const mw_triangulation *t, const double *weight,
                                       mw_error *error)
{
    for (uint32_t i = 0; weight && i < t->point_count; i++)
        if (!isfinite(weight[i]))
            return mw__fail_at(error, -1, i, "the weight of point %u is not finite", i);
    return MW_OK;
}

mw_status mw__make_regular(mw_triangulation *t, const mw_kind_options *options,
                           mw_kind_report *report, mw_error *error)
{
    mw_regular r = {0};
    mw_status status = regular_check_weights(t, options->weights, error);
    if (status) return status;
    regular_points p;
    uint8_t *hidden = mw__alloc(t->point_count, 1);
    bool done = regular_points_make(&p, t, options->weights) && hidden &&
                mw__regular_create(&r, p.point, p.weight, p.number, t->point_count) &&
                regular_insert_all(&r, t, &p);
    if (done) {
        regular_collect(&r, t);
        regular_tell_hidden(t, hidden);
        for (uint32_t i = 0; i < t->point_count; i++) report->hidden += hidden[i];
        report->hidden -= report->delaunay.duplicates;
        if (options->hidden) memcpy(options->hidden, hidden, t->point_count);
    }
    mw__regular_release(&r);
    free(hidden);
    regular_points_release(&p);
    return done ? MW_OK : mw__fail_memory(error);
}
