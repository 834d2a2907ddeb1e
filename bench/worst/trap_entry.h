/* trap_entry.h - what the list of traps says of each, and the ways to measure them. */
#ifndef MW_BENCH_WORST_TRAP_ENTRY_H
#define MW_BENCH_WORST_TRAP_ENTRY_H

#include "bench/worst/trap_figures.h"

typedef struct trap_entry trap_entry;
typedef int trap_kind(const trap_entry *trap, const trap_plan *plan, trap_figures *figures);

/* How the triangles of a probe lie. */
typedef enum trap_layers {
    LAYERS_EQUAL,
    LAYERS_TURNED, /* one half of them faces the probe, one begins at another corner, or both */
    LAYERS_NEAR    /* one behind the other, as near as doubles can be */
} trap_layers;

struct trap_entry {
    const char *name, *help;
    trap_kind *kind;
    trap_mesh_make *make;
    trap_position position;
    mw_start_kind start;
    trap_layers layers;
};

/* Where, by what, and what is made. Each returns 0, or an exit code after a complaint. */
trap_kind trap_in_plane, trap_in_editor;      /* trap_plane.c */
trap_kind trap_of_star, trap_of_probe;        /* trap_space.c */
trap_kind trap_of_delaunay, trap_of_segments; /* trap_making.c */

#endif
