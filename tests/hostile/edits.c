/* edits.c - streams of edits, undos and compactions on a lattice, where vertices, lines and circles
 * meet often; a twin predicts each edit by brute force. */
#include "hostile/hostile.h"
#include "oracle/edit_apply.h"
#include "oracle/edit_check.h"
#include "oracle/edit_locate.h"
#include "oracle/edit_open.h"

#include <math.h>

static mw_mesh *any_mesh(uint64_t *random)
{
    arrays a = arrays_grid(1 + mw__random_below(random, 4), 0, random);
    if (mw__random_below(random, 2)) arrays_punch(&a, 0.4 * random_unit(random), random);
    mw_mesh *mesh = arrays_mesh(&a, (mw_mesh_options){.threads = 1});
    arrays_free(&a);
    return mesh;
}

/* Places on halves: vertices, middles of edges, others. Now and then far out or very near, where
 * the twin can predict that: only in a mesh that fills its hull. */
static double any_coordinate(const twin *t, uint64_t *random)
{
    double x = mw__random_below(random, 13) / 2.0 - 1;
    switch (t->convex ? mw__random_below(random, 12) : 12) {
    case 0: return x + 0x1p-45;
    case 1: return nextafter(x, 10);
    case 2: return x * 1e6;
    default: return x;
    }
}

static mw_edit any_edit(const twin *t, uint64_t *random)
{
    return (mw_edit){.kind = (mw_edit_kind)mw__random_below(random, MW_EDIT_VALUE),
                     .vertex = mw__random_below(random, t->vertex_range + 1),
                     .other = mw__random_below(random, t->vertex_range + 1),
                     .x = any_coordinate(t, random),
                     .y = any_coordinate(t, random),
                     .value = NAN};
}

/* An edit that changes nothing, as an insertion at a vertex, is not counted: it cannot be undone.
 */
static uint64_t edits_done(const twin *t)
{
    mw_editor_info info;
    mw_editor_describe(t->editor, &info);
    return info.edits;
}

void hostile_edits(uint64_t *random)
{
    enum { STEPS = 60 };
    twin t;
    twin_cursors cursors;
    mw_editor_options options = {.delaunay = (mw_delaunay_mode)mw__random_below(random, 3),
                                 .undo = 4};
    twin_bare = mw__random_below(random, 2);
    twin_open(&t, any_mesh(random), &options);
    twin_cursors_open(&cursors, &t, true, mw__random(random));
    for (edit_case.step = 0; edit_case.step < STEPS; edit_case.step++) {
        twin before = twin_copy(&t);
        mw_edit edit = any_edit(&t, random);
        uint64_t edits = edits_done(&t);
        twin_apply(&t, &edit, mw__random_below(random, 2));
        if (edits_done(&t) > edits && mw__random_below(random, 4) == 0) twin_undo(&t, &before);
        twin_close(&before);
        twin_check_same(&t);
        if (mw__random_below(random, 20) == 0) twin_compact(&t);
        const double q[2] = {any_coordinate(&t, random), any_coordinate(&t, random)};
        twin_cursors_check(&cursors, &t, q, twin_locate(&t, q));
    }
    twin_check_all(&t);
    twin_check_queries(&t, &cursors);
    twin_close(&t);
    twin_bare = false;
}
