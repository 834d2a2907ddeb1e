/* outline.c - find the outline of a mesh, and the places of its vertices. O(n + b log b) for b outline edges. */
#include "domain/outline.h"

#include <stdlib.h>

static bool find_flat(mw_outline *o)
{
    const mw_mesh *mesh = o->mesh;
    if (mesh->flat_count == 0) return true;
    o->flat = mw__alloc(mesh->tri_count, sizeof *o->flat);
    if (!o->flat) return false;
    for (uint32_t t = 0; t < mesh->tri_count; t++) o->flat[t] = !mw__has_area(mesh->point, &mesh->tri[t]);
    return true;
}

static bool is_outline(const mw_outline *o, uint32_t t, uint32_t k)
{
    uint32_t link = o->mesh->tri[t].link[k];
    if (link == MW_NONE) return true;
    uint32_t other = mw__link_triangle(link);
    if (mw__is_flat(o, other)) return true;
    return !o->mesh->opposite && t < other && mw__is_fold(o, mw__link(t, k));
}

static bool find_edges(mw_outline *o)
{
    for (int pass = 0; pass < 2; pass++) {
        uint32_t count = 0;
        for (uint32_t t = 0; t < o->mesh->tri_count; t++)
            for (uint32_t k = 0; k < 3 && !mw__is_flat(o, t); k++) {
                if (!is_outline(o, t, k)) continue;
                if (pass == 1) o->half[count] = mw__link(t, k);
                count++;
            }
        if (pass == 1) break;
        o->half_count = count;
        o->half = mw__alloc(count, sizeof *o->half);
        if (!o->half) return false;
    }
    return true;
}

/* --- places --- */

enum { ON_OUTLINE, ON_FLAT }; /* in o->place, until places are numbered */

typedef struct spot {
    mw_point point;
    uint32_t vertex, kind; /* the vertex by the user's number */
} spot;

static int compare_spots(const void *left, const void *right)
{
    const spot *a = left, *b = right;
    if (a->point.x != b->point.x) return a->point.x < b->point.x ? -1 : 1;
    if (a->point.y != b->point.y) return a->point.y < b->point.y ? -1 : 1;
    return a->vertex < b->vertex ? -1 : 1;
}

/* Mark the vertices of the outline, and the finite ones of flat triangles. Returns their number. */
static uint32_t mark_vertices(mw_outline *o)
{
    const mw_mesh *mesh = o->mesh;
    uint32_t count = 0;
    for (uint32_t v = 0; v < mesh->point_count; v++) o->place[v] = MW_NONE;
    for (uint32_t i = 0; i < o->half_count; i++)
        for (uint32_t end = 0; end < 2; end++) {
            uint32_t v = mesh->tri[mw__link_triangle(o->half[i])].v[mw__link_edge(o->half[i]) + end];
            count += o->place[v] == MW_NONE;
            o->place[v] = ON_OUTLINE;
        }
    for (uint32_t t = 0; o->flat && t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3 && o->flat[t]; k++) {
            uint32_t v = mesh->tri[t].v[k];
            if (o->place[v] != MW_NONE || !mw__is_finite(mesh->point[v])) continue;
            o->place[v] = ON_FLAT;
            count++;
        }
    return count;
}

static bool same_place(const spot *a, const spot *b)
{
    return a->point.x == b->point.x && a->point.y == b->point.y;
}

/* Number the places, those of the outline first. `spots` is sorted, so vertices at one place follow each other. */
static void number_places(mw_outline *o, const spot *spots, uint32_t count)
{
    uint32_t next = 0;
    for (uint32_t kind = ON_OUTLINE; kind <= ON_FLAT; kind++) {
        for (uint32_t i = 0, end; i < count; i = end) {
            uint32_t lowest = ON_FLAT;
            for (end = i; end < count && same_place(&spots[i], &spots[end]); end++)
                if (spots[end].kind == ON_OUTLINE) lowest = ON_OUTLINE;
            if (lowest != kind) continue;
            for (uint32_t j = i; j < end; j++) o->place[mw__vertex_place(o->mesh, spots[j].vertex)] = next;
            if (kind == ON_OUTLINE) {
                o->point[next] = spots[i].point;
                o->vertex[next] = mw__vertex_place(o->mesh, spots[i].vertex);
            }
            next++;
        }
        if (kind == ON_OUTLINE) o->place_count = next;
    }
}

static bool find_places(mw_outline *o)
{
    o->place = mw__alloc(o->mesh->point_count, sizeof *o->place);
    if (!o->place) return false;
    uint32_t count = mark_vertices(o), n = 0;
    spot *spots = mw__alloc(count, sizeof *spots);
    o->point = mw__alloc(count, sizeof *o->point);
    o->vertex = mw__alloc(count, sizeof *o->vertex);
    bool done = spots && o->point && o->vertex;
    if (done) {
        for (uint32_t v = 0; v < o->mesh->point_count; v++)
            if (o->place[v] != MW_NONE)
                spots[n++] = (spot){o->mesh->point[v], mw__users_vertex(o->mesh, v), o->place[v]};
        qsort(spots, count, sizeof *spots, compare_spots);
        number_places(o, spots, count);
    }
    free(spots);
    return done;
}

/* --- bridges --- */

static uint64_t pair(uint32_t a, uint32_t b)
{
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static int compare_pairs(const void *left, const void *right)
{
    const uint64_t *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

static bool find_bridges(mw_outline *o)
{
    if (!o->flat) return true;
    o->bridge = mw__alloc(3 * (size_t)o->mesh->flat_count, sizeof *o->bridge);
    if (!o->bridge) return false;
    for (uint32_t t = 0; t < o->mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3 && o->flat[t]; k++) {
            uint32_t a = o->place[o->mesh->tri[t].v[k]], b = o->place[o->mesh->tri[t].v[k + 1]];
            if (a != b && a != MW_NONE && b != MW_NONE) o->bridge[o->bridge_count++] = pair(a, b);
        }
    qsort(o->bridge, o->bridge_count, sizeof *o->bridge, compare_pairs);
    return true;
}

bool mw__is_bridged(const mw_outline *o, uint32_t half)
{
    if (o->bridge_count == 0) return false;
    uint64_t key = pair(mw__outline_from(o, half), mw__outline_to(o, half));
    return bsearch(&key, o->bridge, o->bridge_count, sizeof key, compare_pairs) != NULL;
}

bool mw__outline_create(mw_outline *outline, const mw_mesh *mesh)
{
    *outline = (mw_outline){.mesh = mesh};
    return find_flat(outline) && find_edges(outline) && find_places(outline) && find_bridges(outline);
}

void mw__outline_release(mw_outline *outline)
{
    free(outline->flat);
    free(outline->half);
    free(outline->place);
    free(outline->point);
    free(outline->vertex);
    free(outline->bridge);
    *outline = (mw_outline){0};
}
