/* edited_surface.h - what an editor of a surface holds. Private.
 *
 * An edit checks all that could refuse it, then reserves all memory that it may need
 * (mw__surface_edit_begin), and only then changes the surface. So nothing has to be taken back when
 * an edit fails. */
#ifndef MW_SRC_SURFACE_EDIT_EDITED_SURFACE_H
#define MW_SRC_SURFACE_EDIT_EDITED_SURFACE_H

#include "probe/prober.h"
#include "star/star.h"
#include "surface/surface.h"

#include <meshwalk/surface_edit.h>

#include <string.h>

/* The corners at one vertex form a list: corner 3 t + k is vertex k of triangle t. The surface may
 * be pinched and of any orientation: no turning round a vertex would find all. */
typedef struct mw_corner {
    uint32_t next, prev; /* MW_NONE: none */
} mw_corner;

typedef struct mw_corner_list {
    uint32_t first; /* MW_NONE: of no triangle; MW_VERTEX_FREED */
    uint32_t seen;  /* the last search (mw_surface_editor.search) that came by */
} mw_corner_list;

#define MW_VERTEX_FREED (MW_NONE - 1)

/* A triangle as it was before an edit. */
typedef struct mw_triangle_entry {
    uint32_t triangle;
    mw_triangle before;
} mw_triangle_entry;

typedef enum mw_vertex_event { MW_VERTEX_MADE, MW_VERTEX_GONE, MW_VERTEX_MOVED } mw_vertex_event;

/* What an edit did to a vertex; `other` as in mw_changed_vertex. */
typedef struct mw_vertex_entry {
    mw_vertex_event event;
    uint32_t vertex, other;
    double before[3]; /* of a moved one */
} mw_vertex_entry;

/* An edit: its entries are those from the first ones on, up to those of the next step. */
typedef struct mw_surface_step {
    size_t first_triangle, first_vertex;
    uint32_t tri_count, point_count, borders; /* before the edit */
} mw_surface_step;

struct mw_surface_editor {
    mw_surface *surface;
    mw_prober **prober; /* their boxes follow */
    mw_star **star;     /* they follow */
    size_t prober_count, prober_room, star_count, star_room;
    mw_corner *corner;  /* three a triangle */
    mw_corner_list *at; /* per vertex */
    uint32_t tri_room, point_room;
    uint32_t borders; /* edges of one triangle */
    uint32_t search;  /* see mw_corner_list */

    /* The journal: the last steps. */
    mw_triangle_entry *triangle;
    mw_vertex_entry *vertex;
    mw_surface_step *step;
    size_t triangle_count, triangle_room, vertex_count, vertex_room, step_count, step_room;
    uint32_t journal_below; /* triangles below existed before the edit under way */
    size_t undo, undoable;
    uint64_t edits;

    /* The last report. */
    mw_changed_triangle *changed_triangle;
    mw_changed_vertex *changed_vertex;
    size_t changed_triangle_room, changed_vertex_room;
};

/* In `user` of a triangle: the edit under way has recorded it. */
#define MW_SURFACE_RECORDED MW_REVERSED

/* Make room for `count` records in *array, which has *room, and for one more: it is never NULL. */
static inline bool mw__surface_grow(void *array, size_t *room, size_t count, size_t size)
{
    void **records = array;
    if (count < *room) return true;
    size_t more = *room + *room / 2 + 16;
    if (more <= count) more = count + 1;
    void *grown = mw__realloc(*records, more, size);
    if (!grown) return false;
    *records = grown;
    *room = more;
    return true;
}

static MW_INLINE uint32_t mw__corner_number(uint32_t t, uint32_t k)
{
    return 3 * t + k;
}
static MW_INLINE bool mw__is_corner(uint32_t corner)
{
    return corner < MW_VERTEX_FREED;
}

/* Does a vertex, or a triangle, exist? Of any number. */
static MW_INLINE bool mw__surface_has_vertex(const mw_surface_editor *e, uint32_t v)
{
    return v < e->surface->point_count && e->at[v].first != MW_VERTEX_FREED;
}
static MW_INLINE bool mw__surface_has_triangle(const mw_surface_editor *e, uint32_t t)
{
    return t < e->surface->tri_count && !mw__surface_is_freed(e->surface, t);
}
/* Did a recorded triangle exist before the edit? Has it other vertices now, or another order? */
static MW_INLINE bool mw__entry_was(const mw_triangle_entry *entry)
{
    return !(entry->before.user & MW_SURFACE_FREED);
}
static MW_INLINE bool mw__entry_is_altered(const mw_surface_editor *e,
                                           const mw_triangle_entry *entry)
{
    return memcmp(entry->before.v, e->surface->tri[entry->triangle].v, sizeof entry->before.v) != 0;
}

static MW_INLINE mw_surface_step *mw__last_step(const mw_surface_editor *e)
{
    return &e->step[e->step_count - 1];
}

static MW_INLINE uint32_t mw__surface_living(const mw_surface_editor *e)
{
    return e->surface->tri_count - e->surface->freed_triangles;
}

#endif
