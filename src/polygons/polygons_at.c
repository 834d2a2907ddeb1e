/* polygons_at.c - the polygons that contain a point, by the triangle that contains it. */
#include "polygons/polygons.h"

/* What the answer is merged from: three lists in the order of the ranks. */
typedef struct polygon_merge {
    const mw_polygons *p;
    mw_point q;
    const uint32_t *covered, *covered_end; /* polygons that cover the left sides of all chords */
    const uint32_t *chord, *chord_end;     /* of the triangle                                   */
    const uint32_t *owner, *owner_end;     /* polygons on whose border the edge or vertex lies  */
} polygon_merge;

static void list_take(const mw_rank_lists *lists, uint32_t row, const uint32_t **from,
                      const uint32_t **to)
{
    *from = *to = NULL;
    if (!lists->first || row == MW_NONE) return;
    *from = lists->item + lists->first[row];
    *to = lists->item + lists->first[row + 1];
}

static polygon_merge merge_begin(const mw_polygons *p, const double point[2], const mw_location *at)
{
    polygon_merge m = {.p = p, .q = {point[0], point[1]}};
    const uint32_t t = at->triangle, set = p->set[t];
    uint32_t v[3];
    m.covered = p->sets.rank + p->sets.first[set];
    m.covered_end = p->sets.rank + p->sets.first[set + 1];
    list_take(&p->chords, t, &m.chord, &m.chord_end);
    if (at->where == MW_ON_EDGE) {
        list_take(&p->owners, p->subsegment[3 * (size_t)t + at->local], &m.owner, &m.owner_end);
    } else if (at->where == MW_ON_VERTEX) {
        mw_mesh_triangle(p->mesh, t, v);
        list_take(&p->corners, v[at->local], &m.owner, &m.owner_end);
    }
    return m;
}

/* The lowest rank that is left, or MW_NONE. */
static uint32_t merge_next(const polygon_merge *m)
{
    uint32_t next = m->covered < m->covered_end ? *m->covered : MW_NONE;
    if (m->chord < m->chord_end && m->p->chord[*m->chord].rank < next)
        next = m->p->chord[*m->chord].rank;
    if (m->owner < m->owner_end && *m->owner < next) next = *m->owner;
    return next;
}

/* Take all that the lists have of a rank. Returns whether the point is in the polygon. */
static bool merge_take(polygon_merge *m, uint32_t rank, bool *border)
{
    bool inside = m->covered < m->covered_end && *m->covered == rank;
    if (inside) m->covered++;
    for (*border = false; m->owner < m->owner_end && *m->owner == rank; m->owner++) *border = true;
    for (; m->chord < m->chord_end && m->p->chord[*m->chord].rank == rank; m->chord++) {
        double side = mw__chord_side(&m->p->chord[*m->chord], m->q);
        if (side < 0) inside = !inside;
        if (side == 0) *border = true;
    }
    return inside || *border;
}

size_t mw_polygons_at(const mw_polygons *p, const double point[2], const mw_location *location,
                      mw_polygon_hit *hits, size_t capacity)
{
    if (location->where > MW_ON_VERTEX) return 0;
    polygon_merge m = merge_begin(p, point, location);
    size_t count = 0;
    for (uint32_t rank; (rank = merge_next(&m)) != MW_NONE;) {
        bool border;
        if (!merge_take(&m, rank, &border)) continue;
        if (count < capacity) hits[count] = (mw_polygon_hit){p->polygon[rank], border};
        count++;
    }
    return count;
}

const mw_mesh *mw_polygons_mesh(const mw_polygons *p)
{
    return p->mesh;
}

size_t mw_polygons_crossing(const mw_polygons *p, uint32_t *polygons_found, size_t capacity)
{
    size_t count = 0;
    for (uint32_t rank = 0; rank < p->polygon_count; rank++) {
        if (!p->crossing[rank]) continue;
        if (count < capacity) polygons_found[count] = p->polygon[rank];
        count++;
    }
    return count;
}

void mw_polygons_describe(const mw_polygons *p, mw_polygons_info *info)
{
    const uint32_t triangles = mw_mesh_triangle_count(p->mesh),
                   vertices = mw_mesh_vertex_count(p->mesh);
    *info = (mw_polygons_info){.polygons = p->polygon_count,
                               .crossing_segments = p->chord_count,
                               .passages = p->chords.first ? p->chords.first[triangles] : 0,
                               .sets = p->sets.count};
    info->bytes =
        sizeof *p + (size_t)p->polygon_count * (sizeof *p->polygon + sizeof *p->crossing) +
        (size_t)triangles * (sizeof *p->set + 3 * sizeof *p->subsegment) +
        p->sets.set_room * sizeof *p->sets.first + p->sets.rank_room * sizeof *p->sets.rank +
        mw__rank_lists_bytes(&p->owners, p->subsegment_count) +
        mw__rank_lists_bytes(&p->corners, vertices) + mw__rank_lists_bytes(&p->chords, triangles) +
        p->chord_count * sizeof *p->chord;
}
