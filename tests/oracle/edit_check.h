/* edit_check.h - the editor says what its twin does, and both are right by geometry. */
#ifndef MW_TESTS_ORACLE_EDIT_CHECK_H
#define MW_TESTS_ORACLE_EDIT_CHECK_H

#include "oracle/edit_twin.h"

/* Requires that every vertex, triangle and constraint of the editor, and its description, are
 * the twin's. */
void twin_check_same(const twin *t);

/* twin_check_same, and: the border, the neighbours of every vertex, the kinds of edges; in
 * Delaunay editors every circle and a rebuild from nothing; the mesh that the editor gives. */
void twin_check_all(const twin *t);

/* Requires that the mesh is what is there, numbered anew without gaps; the arrays hold the new
 * number of each triangle and vertex (MW_NONE: gone), and behind them the untouched 4711. */
void twin_check_mesh(const twin *t, const mw_mesh *mesh, const uint32_t *triangles,
                     const uint32_t *vertices);

/* Requires that the editor's log, applied to an editor of the first mesh with the same options,
 * gives the same. */
void twin_check_replay(const twin *t, const mw_editor_options *options);

#endif
