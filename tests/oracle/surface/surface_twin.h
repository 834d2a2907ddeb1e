/* surface_twin.h - the twin of an editor of a surface: a list of triangles, edited by looking at
 * all of them. It predicts which edits are refused and what the others make, and compares the
 * editor's surface with one made anew, its boxes with brute force. Failures end the program
 * (edit_require.h). */
#ifndef MW_TESTS_ORACLE_SURFACE_SURFACE_TWIN_H
#define MW_TESTS_ORACLE_SURFACE_SURFACE_TWIN_H

#include "oracle/surface/star_twin.h"
#include "support/shapes.h"

#include <stdbool.h>

/* Points and triangles with their numbers; freed ones are not there. */
typedef struct twin_surface {
    double *point;
    uint32_t *triangle;
    bool *has_point, *has_triangle;
    uint32_t points, triangles;
} twin_surface;

typedef struct surface_twin {
    mw_surface *surface;
    mw_prober *prober, *second; /* both follow */
    mw_star *star;              /* too; NULL: the shape was not star-shaped about the origin */
    mw_surface_editor *editor;
    mw_probe_cursor certain, published; /* they outlive edits */
    mw_star_cursor ray;                 /* too */
    star_twin_counts stars;
    twin_surface now;
    twin_surface *before; /* each edit that can be undone */
    void **record;        /* and the records of the surface before it */
    size_t undoable, undo;
    uint64_t applied, refused;
} surface_twin;

/* An editor of a shared surface made of the shape, with two probers and a star, and its twin. */
surface_twin surface_twin_make(const shape *s, size_t undo);
void surface_twin_free(surface_twin *t);

/* Apply an edit to both. Returns whether the twin could; the editor must agree, and a refused edit
 * must change nothing. */
bool surface_twin_apply(surface_twin *t, const mw_surface_edit *edit);
/* Undo in both; false if there was nothing to undo. */
bool surface_twin_undo(surface_twin *t);
void surface_twin_compact(surface_twin *t);
/* The same after the editor was compacted, which gave these numbers. */
void surface_twin_compacted(surface_twin *t, const uint32_t *triangle, const uint32_t *vertex);

/* Vertices were moved, by hand, at most so far (negative: unknown): what follows is brought up to
 * date. For use in an update. */
void surface_twin_moved(surface_twin *t, double distance);

/* Compare everything, with so many lines against brute force. */
void surface_twin_check(surface_twin *t, size_t lines, uint64_t *random);

/* All that the surface holds, as bytes that the caller frees; and is it the same now? */
void *surface_twin_record(const surface_twin *t);
void surface_twin_require_record(const surface_twin *t, const void *record);

/* Compare the prober, with brute force; and surface_twin_check does. */
void surface_twin_check_probes(surface_twin *t, size_t lines, uint64_t *random);

/* The twin as a shape without gaps; number[i] becomes the number of its triangle i. The caller
 * frees both. */
shape surface_twin_shape(const surface_twin *t, uint32_t **number);

/* A random edit, mostly a sensible one. Its paths, in `path`, have room for 2 * `room` vertices. */
mw_surface_edit surface_twin_edit(const surface_twin *t, uint32_t *path, size_t room,
                                  uint64_t *random);

#endif
