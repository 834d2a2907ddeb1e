/* edit_twin.h - what an editor holds, kept a second time without it: the twin.
 *
 * The twin is brought up to date by what each edit reports to have changed, and by nothing else
 * (edit_apply.h). What an edit has to do is predicted from it by brute force (edit_predict.h).
 * Checks compare all that the editor tells with it, and hold the triangles against geometry by
 * brute force (edit_check.h, edit_locate.h). Its triangles' edges and its border are in
 * edit_sides.h. Failures end the program (edit_require.h). */
#ifndef MW_TESTS_ORACLE_EDIT_TWIN_H
#define MW_TESTS_ORACLE_EDIT_TWIN_H

#include <meshwalk/meshwalk.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "oracle/edit_require.h"
#include "oracle/predicate_oracle.h"

enum { TWIN_FIELDS = 2 };
extern const char *const twin_field[TWIN_FIELDS]; /* their names */

/* A vertex that is gone; that is in no triangle; that is in some. */
enum { TWIN_GONE, TWIN_ALONE, TWIN_USED };

/* vertex_range and triangle_range: numbers are below; vertices and triangles: how many there
 * are. */
typedef struct twin {
    mw_editor *editor;
    uint32_t vertex_range, triangle_range, vertices, triangles;
    double *point;      /* x y of each vertex                                     */
    uint8_t *state;     /* of each vertex                                         */
    uint32_t *triangle; /* three vertices each; the first MW_NONE: it is gone     */
    uint32_t fields;    /* of the mesh: TWIN_FIELDS or none                       */
    double *value[TWIN_FIELDS];
    uint32_t *fixed; /* the constraints: two vertices each, the lower first    */
    size_t fixed_count;
    bool convex, delaunay;
    bool border_moved; /* a vertex of a border that is fixed was moved           */
    bool compacted;    /* so that holes have other numbers than at first         */
    double *border;    /* the straight parts of such a border, x y to x y, sorted */
    size_t border_count;
    mw_mesh *first; /* the mesh that the editor was made from, and a locator of it */
    mw_locator *first_locator;
    bool shared; /* a copy: editor, first and first_locator are another's         */
} twin;

/* --- made, copied, released ------------------------------------------------------------------- */

/* Twins opened while this is true get no fields. */
extern bool twin_bare;

void twin_close(twin *t);

/* How things stand, to compare with after an undo. Shares the editor and the first mesh;
 * twin_close frees the rest. */
twin twin_copy(const twin *t);

/* --- what is there ---------------------------------------------------------------------------- */

/* x y of a vertex. */
static inline const double *twin_point(const twin *t, uint32_t v)
{
    return t->point + 2 * (size_t)v;
}

/* The three vertices of a triangle. */
static inline const uint32_t *twin_corners(const twin *t, uint32_t k)
{
    return t->triangle + 3 * (size_t)k;
}

static inline bool twin_has_triangle(const twin *t, uint32_t k)
{
    return k < t->triangle_range && twin_corners(t, k)[0] != MW_NONE;
}

/* Is v a vertex of some triangle? */
static inline bool twin_uses_vertex(const twin *t, uint32_t v)
{
    return v < t->vertex_range && t->state[v] == TWIN_USED;
}

/* 1 if triangle k turns left, -1 right, 0 if it is flat. */
static inline int twin_turn(const twin *t, uint32_t k)
{
    const uint32_t *v = twin_corners(t, k);
    return plane_orient(twin_point(t, v[0]), twin_point(t, v[1]), twin_point(t, v[2]));
}

/* --- constraints: edges ab that are not to be flipped away, in either order ------------------- */

bool twin_is_fixed(const twin *t, uint32_t a, uint32_t b);

/* Does nothing where it is one. */
void twin_fix(twin *t, uint32_t a, uint32_t b);

/* It has to be one. */
void twin_unfix(twin *t, uint32_t a, uint32_t b);

#endif
