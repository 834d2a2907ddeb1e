/* borrowed_check.c - are the caller's numbers right? */
#include "borrow/borrowed.h"
#include "base/posix.h"

#include <inttypes.h>

typedef struct borrowed_scan {
    const mw_borrowed *mesh;
    pthread_mutex_t lock; /* of what follows */
    uint32_t bad;         /* the first triangle that breaks a promise, or MW_NONE */
    uint32_t flat, reversed, borders;
    /* a triangle with an area that has no neighbour opposite to this corner */
    uint32_t border, corner;
    bool flat_pair; /* two flat triangles are neighbours */
} borrowed_scan;

/* --- one triangle --- */

static mw_status check_corners(const mw_borrowed *mesh, uint32_t t, mw_borrowed_tile *tile,
                               mw_error *error)
{
    if (!mw__borrowed_read(mesh, t, tile))
        return mw__fail_at(error, t, -1,
                           "triangle %" PRIu32
                           " names a vertex that does not exist; there are %" PRIu32,
                           t, mesh->point_count);
    for (uint32_t k = 0; k < 3; k++) {
        if (tile->v[k] == tile->v[mw__next(k)])
            return mw__fail_at(error, t, tile->v[k],
                               "triangle %" PRIu32 ": vertex %" PRIu32 " is in it twice", t,
                               tile->v[k]);
        if (!mw__is_finite(tile->p[k]))
            return mw__fail_at(error, t, tile->v[k],
                               "triangle %" PRIu32 ": vertex %" PRIu32 " is not finite", t,
                               tile->v[k]);
    }
    return MW_OK;
}

/* Neighbours that do not fit may be laid out in the other way; then say so. */
static const char *check_hint(const mw_borrowed *mesh, uint32_t t, const mw_borrowed_tile *tile)
{
    mw_borrowed other = *mesh;
    other.turn = !mesh->turn;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t across = mw__borrowed_across(&other, t, k);
        mw_borrowed_tile there;
        if (across == MW_NONE) continue;
        if (!mw__borrowed_read(mesh, across, &there)) return "";
        if (mw__borrowed_apex(&there, tile->v[mw__next(k)], tile->v[mw__prev(k)]) == 3) return "";
    }
    return "; the neighbours would fit the other layout";
}

/* The neighbour opposite to corner k shares the edge, and says the same; *apex is its own corner
 * off the edge. */
static mw_status check_neighbour(const mw_borrowed *mesh, uint32_t t, const mw_borrowed_tile *tile,
                                 uint32_t k, uint32_t across, mw_point *apex, mw_error *error)
{
    mw_borrowed_tile there;
    uint32_t a = tile->v[mw__next(k)], b = tile->v[mw__prev(k)];
    uint32_t at = across == t || !mw__borrowed_read(mesh, across, &there)
                      ? 3
                      : mw__borrowed_apex(&there, a, b);
    if (at == 3)
        return mw__fail_at(error, t, tile->v[k],
                           "triangle %" PRIu32 ": its neighbour %" PRIu32
                           " opposite to vertex %" PRIu32 " does not have the vertices %" PRIu32
                           " and %" PRIu32 "%s",
                           t, across, tile->v[k], a, b, check_hint(mesh, t, tile));
    if (mw__borrowed_across(mesh, across, at) != t)
        return mw__fail_at(error, t, tile->v[k],
                           "triangle %" PRIu32 ": triangle %" PRIu32
                           " is its neighbour opposite to vertex %" PRIu32
                           ", but not the other way round",
                           t, across, tile->v[k]);
    *apex = there.p[at];
    return MW_OK;
}

/* Does the triangle across the edge opposite to corner k turn a flat one left (1), right (-1), or
 * not at all (0)? */
static int check_flat_turn(const mw_borrowed *mesh, const mw_borrowed_tile *tile, uint32_t k,
                           uint32_t across)
{
    mw_borrowed_tile there;
    if (across == MW_NONE || !mw__borrowed_read(mesh, across, &there)) return 0;
    uint32_t apex = mw__borrowed_apex(&there, tile->v[mw__next(k)], tile->v[mw__prev(k)]);
    double side =
        apex == 3 ? 0 : mw__orient2d(tile->p[mw__next(k)], tile->p[mw__prev(k)], there.p[apex]);
    return side > 0 ? -1 : side < 0;
}

/* A flat triangle between neighbours lies between them: seen from each it goes round the same way.
 */
static mw_status check_flat(const mw_borrowed *mesh, uint32_t t, const mw_borrowed_tile *tile,
                            bool *pair, mw_error *error)
{
    int sum = 0, turns = 0;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t across = mw__borrowed_across(mesh, t, k);
        int turn = check_flat_turn(mesh, tile, k, across);
        sum += turn;
        turns += turn != 0;
        *pair = *pair || (across != MW_NONE && turn == 0);
    }
    if (sum == turns || sum == -turns) return MW_OK;
    return mw__fail_at(error, t, -1,
                       "triangle %" PRIu32 " has no area, and its neighbours fold round it", t);
}

/* Neighbours lie on different sides of their edge: the higher one is asked, by both. A flat
 * triangle lies on neither. */
static mw_status check_links(const mw_borrowed *mesh, uint32_t t, const mw_borrowed_tile *tile,
                             double area, mw_error *error)
{
    for (uint32_t k = 0; k < 3; k++) {
        mw_point apex;
        uint32_t across = mw__borrowed_across(mesh, t, k);
        mw_status status =
            across == MW_NONE ? MW_OK : check_neighbour(mesh, t, tile, k, across, &apex, error);
        if (status) return status;
        if (across == MW_NONE || across < t || area == 0) continue;
        double beyond = mw__orient2d(tile->p[mw__next(k)], tile->p[mw__prev(k)], apex);
        if (area > 0 ? beyond > 0 : beyond < 0)
            return mw__fail_at(error, t, tile->v[k],
                               "triangle %" PRIu32 " and its neighbour %" PRIu32
                               " lie on the same side of the edge they share",
                               t, across);
    }
    return MW_OK;
}

static mw_status check_triangle(borrowed_scan *scan, uint32_t t, mw_error *error)
{
    const mw_borrowed *mesh = scan->mesh;
    mw_borrowed_tile tile;
    mw_status status = check_corners(mesh, t, &tile, error);
    if (status) return status;
    double area = mw__orient2d(tile.p[0], tile.p[1], tile.p[2]);
    status = check_links(mesh, t, &tile, area, error);
    if (status) return status;
    scan->flat += area == 0;
    scan->reversed += area < 0;
    for (uint32_t k = 0; k < 3; k++) {
        if (mw__borrowed_across(mesh, t, k) != MW_NONE) continue;
        scan->borders++;
        if (area == 0) continue;
        scan->border = t;
        scan->corner = k;
    }
    return area == 0 ? check_flat(mesh, t, &tile, &scan->flat_pair, error) : MW_OK;
}

/* --- all of them --- */

static void borrowed_scan_add(borrowed_scan *sum, const borrowed_scan *more)
{
    pthread_mutex_lock(&sum->lock);
    if (more->bad < sum->bad) sum->bad = more->bad;
    sum->flat += more->flat;
    sum->reversed += more->reversed;
    sum->borders += more->borders;
    sum->flat_pair = sum->flat_pair || more->flat_pair;
    if (more->border < sum->border) {
        sum->border = more->border;
        sum->corner = more->corner;
    }
    pthread_mutex_unlock(&sum->lock);
}

static void borrowed_scan_range(void *work, uint64_t from, uint64_t to)
{
    borrowed_scan *sum = work;
    borrowed_scan some = {.mesh = sum->mesh, .bad = MW_NONE, .border = MW_NONE};
    for (uint32_t t = (uint32_t)from; t < to && some.bad == MW_NONE; t++)
        if (check_triangle(&some, t, NULL)) some.bad = t;
    borrowed_scan_add(sum, &some);
}

mw_status mw__borrowed_check(mw_borrowed *mesh, mw_job *job, mw_error *error)
{
    borrowed_scan scan = {.mesh = mesh, .bad = MW_NONE, .border = MW_NONE};
    pthread_mutex_init(&scan.lock, NULL);
    mw__job_stage(job, "checking neighbours", 0.9);
    bool done = mw__job_ranges(job, mesh->tri_count, borrowed_scan_range, &scan);
    pthread_mutex_destroy(&scan.lock);
    if (scan.bad != MW_NONE) return check_triangle(&scan, scan.bad, error);
    if (!done) return mw__fail_memory(error);
    mw__job_stage(job, "following the border", 0.1);
    mesh->flat_count = scan.flat;
    mesh->reversed_count = scan.reversed;
    mesh->convex = scan.border != MW_NONE && !scan.flat_pair &&
                   mw__borrowed_is_convex(mesh, scan.border, scan.corner, scan.borders);
    return MW_OK;
}
