/* inside.c - is a point inside of a closed surface? By the parity of the triangles that a ray along
 * the x axis meets, exactly.
 *
 * A ray through an edge or a vertex meets several triangles there. The rule: the ray counts as
 * moved by (0, e, e^2) with an infinitely small e > 0, so that it meets no edge [Edelsbrunner,
 * Muecke 1990]. Seen along x, an edge ab passes the ray on the side of the sign of
 *
 *     s = (a_y - q_y)(b_z - q_z) - (a_z - q_z)(b_y - q_y),
 *
 * which changes by e (a_z - b_z) + e^2 (b_y - a_y) when q moves: where s is 0, the first of these
 * that is not 0 decides. If both are, the edge is a point as seen along x and its triangle a
 * segment, which the ray passes by. The moved ray meets a triangle if all three edges pass it on
 * the same side. The ray as it is then meets the triangle, too, perhaps at its border: so the
 * search finds it.
 *
 * A closed surface has an even number of triangles at each edge. So every ray of a point that is
 * not on the surface has the same parity. A point is on the surface if a line along one of the axes
 * meets a triangle there, as a triangle with an area is parallel to at most two of them. */
#include "probe/ray.h"

const char *mw_surface_side_name(mw_surface_side side)
{
    static const char *const names[MW_SURFACE_SIDE_COUNT] = {"outside", "inside", "on", "bad"};
    return (unsigned)side < MW_SURFACE_SIDE_COUNT ? names[side] : NULL;
}

/* --- parity --- */

static int side_sign(double x)
{
    return (x > 0) - (x < 0);
}

/* On which side does edge ab pass the moved ray? 0: neither, for an edge along x. */
static int moved_side(const mw_line *line, const double a[3], const double b[3])
{
    int side = side_sign(mw__side(line, a, b));
    if (side == 0) side = (a[2] > b[2]) - (a[2] < b[2]);
    if (side == 0) side = (b[1] > a[1]) - (b[1] < a[1]);
    return side;
}

typedef struct parity_count {
    bool odd, on;
} parity_count;

/* A ray that begins on the triangle has no parity: the search ends. */
static bool parity_found(mw_ray_search *search, uint32_t triangle, mw_ray_side side)
{
    parity_count *count = search->self;
    const mw_surface *surface = search->prober->surface;
    const mw_line *line = &search->ray->line;
    const double *a = mw__surface_corner(surface, triangle, 0),
                 *b = mw__surface_corner(surface, triangle, 1),
                 *c = mw__surface_corner(surface, triangle, 2);
    (void)side;
    count->on = mw__orient3d(line->q, a, b, c) == 0;
    int ab = moved_side(line, a, b);
    if (ab != 0 && moved_side(line, b, c) == ab && moved_side(line, c, a) == ab)
        count->odd = !count->odd;
    return !count->on;
}

static bool contact_found(mw_ray_search *search, uint32_t triangle, mw_ray_side side)
{
    (void)triangle;
    (void)side;
    *(bool *)search->self = true;
    return false;
}

/* Does a line along an axis meet a triangle at the point? */
static bool point_is_on(const mw_prober *prober, const double point[3], int axis)
{
    mw_ray_query ray = {.line = {{point[0], point[1], point[2]}, {0}, {0}}, .faces = MW_PROBE_BOTH};
    mw_ray_search search;
    bool on = false;
    ray.line.m[axis] = 1;
    mw__ray_search_begin(&search, prober, &ray, contact_found, &on);
    mw__ray_search_run(&search);
    return on;
}

static mw_surface_side side_of_point(const mw_prober *prober, const double point[3])
{
    if (!mw__is_finite3(point)) return MW_SURFACE_BAD;
    mw_ray_query ray = {.line = {{point[0], point[1], point[2]}, {1, 0, 0}, {0}},
                        .extent = MW_PROBE_RAY,
                        .faces = MW_PROBE_BOTH,
                        .greatest = INFINITY};
    mw_ray_search search;
    parity_count count = {false, false};
    mw__ray_search_begin(&search, prober, &ray, parity_found, &count);
    mw__ray_search_run(&search);
    if (count.on || point_is_on(prober, point, 1) || point_is_on(prober, point, 2))
        return MW_SURFACE_ON;
    return count.odd ? MW_SURFACE_INSIDE : MW_SURFACE_OUTSIDE;
}

/* --- closed surfaces --- */

/* Does every edge have a neighbour? */
bool mw__surface_is_closed(const mw_surface *surface)
{
    for (uint32_t t = 0; t < surface->tri_count; t++)
        for (uint32_t k = 0; k < 3; k++)
            if (surface->tri[t].link[k] == MW_NONE && !mw__surface_is_freed(surface, t))
                return false;
    return true;
}

/* Are coincident vertices where they were welded? */
bool mw__surface_is_joined(const mw_surface *surface)
{
    for (uint32_t v = 0; surface->coincident && v < surface->point_count; v++) {
        const double *p = mw__surface_point(surface, v),
                     *q = mw__surface_point(surface, surface->coincident[v]);
        for (int k = 0; k < 3; k++)
            if (p[k] != q[k]) return false;
    }
    return true;
}

static mw_status prober_check_closed(const mw_prober *prober, mw_error *error)
{
    if (!prober->has_bvh)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "mw_inside_surface() needs a prober with options.boxes");
    if (prober->version != prober->surface->version)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "the boxes are not up to date: call mw_prober_update()");
    if (!prober->closed)
        return mw__fail(error, MW_ERROR_INPUT,
                        "the surface has no inside: some edges have one triangle, or several that "
                        "are not linked");
    if (!prober->bvh.finite)
        return mw__fail(error, MW_ERROR_INPUT, "the surface has no inside: a vertex is not finite");
    if (!prober->joined)
        return mw__fail(error, MW_ERROR_INPUT,
                        "vertices of a welded surface may have moved apart: call "
                        "mw_prober_update() with a negative distance to check them");
    return MW_OK;
}

/* --- points --- */

typedef struct inside_batch {
    const mw_prober *prober;
    const double *points;
    size_t stride;
    uint8_t *sides;
} inside_batch;

static void inside_answer_range(void *work, uint64_t from, uint64_t to)
{
    const inside_batch *b = work;
    for (uint64_t i = from; i < to; i++)
        b->sides[i] = (uint8_t)side_of_point(b->prober, b->points + i * b->stride);
}

mw_status mw_inside_surface(const mw_prober *prober, const double *points, size_t n, size_t stride,
                            uint32_t threads, uint8_t *sides, mw_error *error)
{
    if (!prober || (n && (!points || !sides)))
        return mw__fail(error, MW_ERROR_ARGUMENT, "the prober, the points or the result is NULL");
    if (stride != 0 && stride < 3)
        return mw__fail(error, MW_ERROR_ARGUMENT, "the stride must be at least 3");
    inside_batch batch = {prober, points, stride ? stride : 3, sides};
    mw_job job = mw__job(threads, NULL);
    mw__surface_read_lock(prober->surface);
    mw_status status = prober_check_closed(prober, error);
    mw__job_stage(&job, "answering queries", 1);
    if (status == MW_OK) mw__job_ranges(&job, n, inside_answer_range, &batch);
    mw__surface_read_unlock(prober->surface);
    return status;
}
