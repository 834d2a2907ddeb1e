/* delaunay.c - from points to a Delaunay triangulation: order them, let it grow, hand out what has grown.
 *
 * All work is done on a copy of the points along a Hilbert curve ("places": place i holds point order[i]), so that what
 * lies close in the plane lies close in memory; numbers are translated at the end. */
#include "triangulate/delaunay.h"

#include "triangulate/delaunay_grow.h"
#include "triangulate/delaunay_order.h"

#include <stdlib.h>

typedef struct delaunay {
    const mw_point *given;
    uint32_t n;
    uint32_t *order;    /* per place: number of the point; of equal points the vertex gets the lowest number */
    uint32_t *sequence; /* places in the order of insertion                                                  */
    mw_point *point;    /* per place; of a place that is merged with another, the other: see set_twin        */
    mw_growth growth;
    uint32_t duplicates;
} delaunay;

static void release(delaunay *d)
{
    free(d->order);
    free(d->sequence);
    free(d->point);
    free(d->growth.facet);
}

/* --- points --- */

static mw_status find_extent(const mw_point *points, uint32_t n, mw_extent *extent, mw_error *error)
{
    mw_extent e = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < n; i++) {
        mw_point p = points[i];
        if (!isfinite(p.x) || !isfinite(p.y)) return mw__fail_at(error, -1, i, "point %u is not finite", i);
        if (p.x < e.low[0]) e.low[0] = p.x;
        if (p.x > e.high[0]) e.high[0] = p.x;
        if (p.y < e.low[1]) e.low[1] = p.y;
        if (p.y > e.high[1]) e.high[1] = p.y;
    }
    *extent = e;
    return MW_OK;
}

static bool equal(mw_point a, mw_point b)
{
    return a.x == b.x && a.y == b.y;
}

static void exchange(uint32_t *a, uint32_t *b)
{
    uint32_t old = *a;
    *a = *b;
    *b = old;
}

/* Bring three places that do not lie on one line to the front of the sequence. */
static mw_status choose_first_three(delaunay *d, mw_error *error)
{
    const mw_point *p = d->point;
    uint32_t *s = d->sequence, second = 1;
    while (second < d->n && equal(p[s[0]], p[s[second]])) second++;
    if (second >= d->n)
        return mw__fail(error, MW_ERROR_INPUT, "fewer than three different points: all %u are equal", d->n);
    exchange(&s[1], &s[second]);
    uint32_t third = second + 1;
    while (third < d->n && mw__orient2d(p[s[0]], p[s[1]], p[s[third]]) == 0) third++;
    if (third < d->n) {
        exchange(&s[2], &s[third]);
        return MW_OK;
    }
    for (uint32_t i = 2; i < d->n; i++)
        if (!equal(p[s[i]], p[s[0]]) && !equal(p[s[i]], p[s[1]]))
            return mw__fail(error, MW_ERROR_INPUT, "all %u points lie on one line", d->n);
    return mw__fail(error, MW_ERROR_INPUT, "fewer than three different points: only two among %u", d->n);
}

/* A place merged with another is no vertex any more. Its coordinates make room for the place of its twin. */
static void set_twin(mw_point *point, uint32_t twin)
{
    *point = (mw_point){NAN, twin};
}

static bool get_twin(mw_point point, uint32_t *twin)
{
    if (!isnan(point.x)) return false;
    *twin = (uint32_t)point.y;
    return true;
}

/* --- growth --- */

static mw_status prepare(delaunay *d, mw_extent *extent, mw_error *error)
{
    if (d->n < 3) return mw__fail(error, MW_ERROR_INPUT, "fewer than three points: %u", d->n);
    if (d->n > MW_MAX_TRIANGLES / 2) return mw__fail(error, MW_ERROR_LIMIT, "too many points: %u", d->n);
    mw_status status = find_extent(d->given, d->n, extent, error);
    if (status != MW_OK) return status;
    d->order = mw__alloc(d->n, sizeof *d->order);
    if (!d->order || !mw__hilbert_order(d->given, d->n, extent, d->order)) return mw__fail_memory(error);
    d->sequence = mw__alloc(d->n, sizeof *d->sequence);
    d->point = mw__alloc(d->n, sizeof *d->point);
    d->growth.facet = mw__alloc(2 * (size_t)d->n, sizeof *d->growth.facet);
    if (!d->sequence || !d->point || !d->growth.facet) return mw__fail_memory(error);
    for (uint32_t i = 0; i < d->n; i++) d->point[i] = d->given[d->order[i]];
    mw__insertion_sequence(d->n, d->sequence);
    return choose_first_three(d, error);
}

static void grow(delaunay *d, const mw_extent *extent)
{
    d->growth.point = d->point;
    mw__grow_begin(&d->growth, d->n, d->sequence, extent->high[0] - extent->low[0], extent->high[1] - extent->low[1]);
    for (uint32_t i = 3; i < d->n; i++) {
        uint32_t place = d->sequence[i], vertex = mw__grow(&d->growth, place);
        if (MW_LIKELY(vertex == place)) continue;
        if (d->order[place] < d->order[vertex]) exchange(&d->order[place], &d->order[vertex]);
        set_twin(&d->point[place], vertex);
        d->duplicates++;
    }
}

static void report_duplicates(const delaunay *d, uint32_t *duplicate_of)
{
    for (uint32_t i = 0, twin; i < d->n; i++)
        duplicate_of[d->order[i]] = get_twin(d->point[i], &twin) ? d->order[twin] : MW_NONE;
}

/* --- harvest --- */

/* Number the facets that are no ghosts by their lowest vertex: along the curve. Sets number[f] for facet f, MW_NONE for
 * ghosts, and *count. */
static bool number_facets(const mw_growth *g, uint32_t *number, uint32_t *count)
{
    uint32_t *next = mw__calloc((size_t)g->infinity + 1, sizeof *next);
    if (!next) return false;
    for (uint32_t f = 0; f < g->facet_count; f++) {
        const uint32_t *v = g->facet[f].v;
        uint32_t low = v[0] < v[1] ? v[0] : v[1];
        if (v[2] < low) low = v[2];
        number[f] = mw__is_ghost(g, &g->facet[f]) ? MW_NONE : low;
        if (number[f] != MW_NONE) next[low + 1]++;
    }
    for (uint32_t i = 0; i < g->infinity; i++) next[i + 1] += next[i];
    *count = next[g->infinity];
    for (uint32_t f = 0; f < g->facet_count; f++)
        if (number[f] != MW_NONE) number[f] = next[number[f]]++;
    free(next);
    return true;
}

static void copy_facets(const delaunay *d, const uint32_t *number, mw_triangle *tri)
{
    for (uint32_t f = 0; f < d->growth.facet_count; f++) {
        if (number[f] == MW_NONE) continue;
        const mw_facet *from = &d->growth.facet[f];
        mw_triangle *t = &tri[number[f]];
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t other = number[mw__link_triangle(from->link[k])];
            t->v[k] = d->order[from->v[k]];
            t->link[k] = other == MW_NONE ? MW_NONE : mw__link(other, mw__link_edge(from->link[k]));
        }
        t->v[3] = t->v[0];
        t->user = number[f];
    }
}

static mw_status harvest(const delaunay *d, mw_triangle **tri, uint32_t *tri_count, mw_error *error)
{
    uint32_t *number = mw__alloc(d->growth.facet_count, sizeof *number);
    bool done = number && number_facets(&d->growth, number, tri_count);
    if (done) *tri = mw__alloc_lines(*tri_count, sizeof **tri);
    done = done && *tri;
    if (done) copy_facets(d, number, *tri);
    free(number);
    return done ? MW_OK : mw__fail_memory(error);
}

mw_status mw__delaunay_triangles(const mw_point *points, uint32_t n, uint32_t *duplicate_of,
                                 mw_triangulation_report *report, mw_triangle **tri, uint32_t *tri_count,
                                 mw_error *error)
{
    delaunay d = {.given = points, .n = n};
    mw_extent extent;
    *tri = NULL;
    *tri_count = 0;
    mw_status status = prepare(&d, &extent, error);
    if (status == MW_OK) {
        grow(&d, &extent);
        if (duplicate_of) report_duplicates(&d, duplicate_of);
        if (report) *report = (mw_triangulation_report){n, d.duplicates, d.growth.visited};
        free(d.point);
        free(d.sequence);
        d.point = NULL;
        d.sequence = NULL;
        status = harvest(&d, tri, tri_count, error);
    }
    release(&d);
    return status;
}

mw_status mw_delaunay(const double *points, size_t n, size_t stride, uint32_t *duplicate_of,
                      mw_triangulation_report *report, mw_mesh **out, mw_error *error)
{
    if (!out) return mw__fail(error, MW_ERROR_ARGUMENT, "out is NULL");
    *out = NULL;
    if (!stride) stride = 2;
    if (stride < 2) return mw__fail(error, MW_ERROR_ARGUMENT, "stride %zu is below 2", stride);
    if (n && !points) return mw__fail(error, MW_ERROR_ARGUMENT, "points is NULL");
    if (n > MW_MAX_TRIANGLES / 2) return mw__fail(error, MW_ERROR_LIMIT, "too many points: %zu", n);
    mw_mesh *mesh = mw__calloc(1, sizeof *mesh);
    if (mesh) mesh->point = mw__alloc_lines(n, sizeof *mesh->point);
    mw_status status = mesh && mesh->point ? MW_OK : mw__fail_memory(error);
    if (status == MW_OK) {
        mesh->point_count = (uint32_t)n;
        for (size_t i = 0; i < n; i++) mesh->point[i] = (mw_point){points[i * stride], points[i * stride + 1]};
        status = mw__delaunay_triangles(mesh->point, mesh->point_count, duplicate_of, report, &mesh->tri,
                                        &mesh->tri_count, error);
    }
    if (status == MW_OK)
        *out = mesh;
    else
        mw_mesh_destroy(mesh);
    return status;
}
