/* space_model.h - the surfaces of 'bench space', the rays that are cast at them, and how they
 * move. */
#ifndef MW_BENCH_SPACE_SPACE_MODEL_H
#define MW_BENCH_SPACE_SPACE_MODEL_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct space_model {
    const char *name;
    double *points; /* x0 y0 z0 x1 y1 z1 ... as they are now */
    double *rest;   /* the same before any move */
    size_t point_count;
    uint32_t *triangles;
    size_t triangle_count;
    double low[3], high[3];
    bool is_star; /* star-shaped about the origin */
} space_model;

/* A made polyhedron of about `triangles` triangles (data/polyhedra.h, by its number), or the mesh
 * of a file. Returns 0, or an exit code after a complaint. Release it in any case. */
int space_model_make(space_model *m, int kind, size_t triangles, uint64_t seed);
int space_model_read(space_model *m, const char *path);
void space_model_release(space_model *m);

mw_arrays space_model_arrays(const space_model *m);

/* --- rays --- */

typedef enum space_rays_kind {
    SPACE_CENTRE, /* from the origin, in random directions; of star-shaped models */
    SPACE_RANDOM, /* from random points round the model to random points of its box */
    SPACE_STREAM, /* from one point, line by line over a picture of the model */
    SPACE_SWEEP,  /* from the origin, line by line round it; of star-shaped models */
    SPACE_RAYS_KINDS
} space_rays_kind;

const char *space_rays_name(int kind);
static inline bool space_rays_need_star(int kind)
{
    return kind == SPACE_CENTRE || kind == SPACE_SWEEP;
}

/* Rays from q along m: x, y, z of q, then of m, which is the difference to a point through which
 * the ray goes, without rounding. So q, q + m and a third and fourth point have an exact
 * orientation. */
typedef struct space_rays {
    double *ray; /* 6 each */
    size_t count;
} space_rays;

/* Draw n rays. Returns false when out of memory. */
bool space_rays_draw(space_rays *r, const space_model *m, space_rays_kind kind, size_t n,
                     uint64_t seed);
void space_rays_release(space_rays *r);

/* --- moves --- */

typedef enum space_move { SPACE_ALL, SPACE_TENTH, SPACE_ONE, SPACE_MOVES } space_move;

const char *space_move_name(int move);

/* Move vertices towards the middle of the model or away from it, by up to a hundredth of their
 * distance; `away` chooses which. Sets *farthest, how far any went. A star-shaped model stays
 * so. */
void space_model_move(space_model *m, space_move move, bool away, double *farthest);

#ifdef __cplusplus
}
#endif

#endif
