/* ray.h - lines, rays and segments against a surface: what they meet, exactly, and the search of
 * the BVH for it. Private.
 *
 * ray_hit.c decides about one triangle. ray_search.c searches the BVH; what it finds goes to a
 * function, which may end the search or narrow it. */
#ifndef MW_SRC_PROBE_RAY_H
#define MW_SRC_PROBE_RAY_H

#include "probe/ray_stack.h"
#include "probe/prober.h"

/* The part of a line that counts: at a distance from q of `least` to `greatest`, which may be
 * infinite; ahead of q for a ray; up to `end` for a segment. */
typedef struct mw_ray_query {
    mw_line line;
    mw_probe_extent extent;
    mw_probe_faces faces;
    double least, greatest;
    double end[3];
} mw_ray_query;

/* How a ray meets a triangle. */
typedef enum mw_ray_side { MW_RAY_MISSES = 0, MW_RAY_FRONT, MW_RAY_BACK } mw_ray_side;

/* The line, ray or segment of a query. Returns false if a coordinate is not finite, or it has no
 * direction. */
static MW_INLINE bool mw__probe_ray(const mw_probe_options *options, const double q[3],
                                    const double m[3], mw_ray_query *ray)
{
    if (!mw__is_finite3(q) || !mw__is_finite3(m)) return false;
    *ray = (mw_ray_query){.line = {{q[0], q[1], q[2]}, {m[0], m[1], m[2]}, {0}},
                          .extent = options->extent,
                          .faces = options->faces,
                          .least = options->min_distance,
                          .greatest = options->max_distance > 0 ? options->max_distance : INFINITY,
                          .end = {m[0], m[1], m[2]}};
    if (ray->extent == MW_PROBE_SEGMENT) return mw__line_through(q, m, &ray->line);
    return m[0] != 0 || m[1] != 0 || m[2] != 0;
}

/* --- ray_hit.c --- */

/* Does the line meet the triangle? Exact. A triangle along the line is not met, nor is one with a
 * vertex that is not finite. */
mw_ray_side mw__line_meets_exactly(const mw_line *line, const mw_corners corners);
/* The same, faster. Notes the sides. */
mw_ray_side mw__ray_line_meets(const mw_line *line, const mw_corners corners, mw_line_estimate *e);
/* Is that within the extent and the limits of the ray? Exact. */
bool mw__ray_reaches(const mw_ray_query *ray, const mw_corners corners, mw_ray_side side);
/* The same, faster, with the mw__hit_distance of the triangle. */
bool mw__ray_reaches_at(const mw_ray_query *ray, const mw_corners corners, mw_ray_side side,
                        double distance);

/* Compare where along the line two triangles are met, whose sides are known: < 0 if s comes before
 * t, 0 if they are met at one place. Exact. */
int mw__ray_place_order(const mw_surface *surface, const mw_ray_query *ray, uint32_t s,
                        mw_ray_side s_side, uint32_t t, mw_ray_side t_side);

/* The same, but equal places by their numbers. */
int mw__ray_order(const mw_surface *surface, const mw_ray_query *ray, uint32_t s,
                  mw_ray_side s_side, uint32_t t, mw_ray_side t_side);

/* The answer for a triangle that is met. */
mw_touch mw__ray_touch(const mw_surface *surface, const mw_ray_query *ray, uint32_t triangle,
                       mw_ray_side side);

/* --- ray_search.c --- */

typedef struct mw_ray_search mw_ray_search;

/* A triangle that the ray meets was found. Returns whether the search goes on. */
typedef bool mw_ray_found(mw_ray_search *search, uint32_t triangle, mw_ray_side side);

struct mw_ray_search {
    const mw_prober *prober;
    const mw_ray_query *ray;
    mw_ray_found *found;
    void *self;       /* of `found` */
    bool one_of_same; /* of equal triangles, one is enough */
    mw_bvh_beam beam;
    mw_corners corners; /* of the triangle that is looked at */
    uint32_t nearest;   /* of mw__ray_found_nearest; or MW_NONE */
    mw_ray_side side;   /* of that */
    mw_corners nearest_corners;
    double distance;
    mw_line_estimate estimate, nearest_estimate; /* of the one looked at, and of the nearest */
    double underflow;                            /* mw__side_underflow of the line */
    uint64_t boxes, triangles, hits;
    /* The node that is visited, MW_NONE at the end: the children that are triangles and that the
     * beam meets, as bits, and from where on it may meet each child. Its children that are nodes
     * wait from `floor` on. */
    uint32_t at, triangles_met, floor;
    float near[MW_BVH_WIDTH];
    mw_ray_stack stack;
};

/* Begin a search. The prober and the ray must outlive it. The BVH must be up to date. */
void mw__ray_search_begin(mw_ray_search *search, const mw_prober *prober, const mw_ray_query *ray,
                          mw_ray_found *found, void *self);

/* Are there vector instructions for it? */
bool mw__prober_has_vectors(const mw_prober *prober);

/* A search that has ended, and has found nothing. */
void mw__ray_search_none(mw_ray_search *search);

/* Look at one triangle first: a good guess narrows the search. */
void mw__ray_search_guess(mw_ray_search *search, uint32_t triangle);
/* Look at a triangle with the given vertices, in a search for the nearest, with vectors. */
void mw__ray_search_look(mw_ray_search *search, uint32_t triangle, const uint32_t vertex[3]);

/* Run a search to its end. */
void mw__ray_search_run(mw_ray_search *search);

/* Where searches come from, and go to: `next` takes the answer of a search that has ended, or NULL
 * at first, and begins the next one, which may have ended already. NULL: there is none. */
typedef struct mw_ray_source {
    mw_ray_search *(*next)(void *self, mw_ray_search *ended);
    void *self;
} mw_ray_source;

/* Run all searches of a source, at most MW_RAYS_AT_A_TIME at a time. They take turns, so that one
 * goes on while another waits for memory. */
#define MW_RAYS_AT_A_TIME 16
void mw__ray_searches_run(const mw_prober *prober, const mw_ray_source *source);

/* Keeps the triangle nearest to q, of equally near ones the lowest. Instead of calling this, the
 * search does so itself. */
mw_ray_found mw__ray_found_nearest;
/* Keeps the first triangle found, and ends the search. */
mw_ray_found mw__ray_found_any;

/* The answer of a search for the nearest triangle. */
mw_touch mw__ray_touch_found(const mw_ray_search *search);

void mw__ray_search_count(const mw_ray_search *search, mw_probe_counters *counters);

/* --- hit_list.c --- */

/* The triangles that a ray meets, in the caller's array; if there are more than fit, the first ones
 * along the line. */
typedef struct mw_hit_list {
    mw_touch *touches;
    size_t capacity, count; /* count: of all that were found */
    bool grows;             /* the array is the list's own, and grows: so all fit */
    bool no_memory;         /* it could not grow: the search has ended */
} mw_hit_list;

/* `self` of the search is the list. */
mw_ray_found mw__hit_list_found;
/* Sort the list. Until mw__hit_list_complete its touches have nothing but triangles and sides. */
void mw__hit_list_sort(const mw_ray_search *search);
/* Of triangles at one place keep the first. The list is sorted, and all are in it. */
void mw__hit_list_keep_places(const mw_ray_search *search);
void mw__hit_list_complete(const mw_ray_search *search);

#endif
