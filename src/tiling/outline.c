/* outline.c - finds the outline of a mesh and its nodes. O(n + b log b) for b outline edges. */
#include "tiling/outline.h"

#include <stdlib.h>

static bool outline_find_flat(mw_outline *o)
{
    const mw_mesh *mesh = o->mesh;
    if (mesh->flat_count == 0) return true;
    o->flat = mw__alloc(mesh->tri_count, sizeof *o->flat);
    if (!o->flat) return false;
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        o->flat[t] = !mw__has_area(mesh->point, &mesh->tri[t]);
    return true;
}

static bool is_outline_edge(const mw_outline *o, uint32_t t, uint32_t k)
{
    uint32_t link = o->mesh->tri[t].link[k];
    if (link == MW_NONE) return true;
    uint32_t other = mw__link_triangle(link);
    if (mw__is_flat(o, other)) return true;
    return !o->mesh->opposite && t < other && mw__is_fold(o, mw__link(t, k));
}

static bool outline_find_edges(mw_outline *o)
{
    for (int pass = 0; pass < 2; pass++) {
        uint32_t count = 0;
        for (uint32_t t = 0; t < o->mesh->tri_count; t++)
            for (uint32_t k = 0; k < 3 && !mw__is_flat(o, t); k++) {
                if (!is_outline_edge(o, t, k)) continue;
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

/* --- nodes --- */

enum { ON_OUTLINE, ON_FLAT }; /* in o->node, until nodes are numbered */

typedef struct node_vertex {
    mw_point point;
    uint32_t vertex, kind; /* the user's number of the vertex */
} node_vertex;

static int compare_node_vertices(const void *left, const void *right)
{
    const node_vertex *a = left, *b = right;
    if (a->point.x != b->point.x) return a->point.x < b->point.x ? -1 : 1;
    if (a->point.y != b->point.y) return a->point.y < b->point.y ? -1 : 1;
    return a->vertex < b->vertex ? -1 : 1;
}

/* Mark the vertices of the outline, and the finite vertices of flat triangles. Returns their
 * number. */
static uint32_t outline_mark_vertices(mw_outline *o)
{
    const mw_mesh *mesh = o->mesh;
    uint32_t count = 0;
    for (uint32_t v = 0; v < mesh->point_count; v++) o->node[v] = MW_NONE;
    for (uint32_t i = 0; i < o->half_count; i++)
        for (uint32_t end = 0; end < 2; end++) {
            uint32_t v =
                mesh->tri[mw__link_triangle(o->half[i])].v[mw__link_edge(o->half[i]) + end];
            count += o->node[v] == MW_NONE;
            o->node[v] = ON_OUTLINE;
        }
    for (uint32_t t = 0; o->flat && t < mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3 && o->flat[t]; k++) {
            uint32_t v = mesh->tri[t].v[k];
            if (o->node[v] != MW_NONE || !mw__is_finite(mesh->point[v])) continue;
            o->node[v] = ON_FLAT;
            count++;
        }
    return count;
}

static bool vertices_coincide(const node_vertex *a, const node_vertex *b)
{
    return a->point.x == b->point.x && a->point.y == b->point.y;
}

/* Number the nodes, those of the outline first. `vertices` is sorted, so coincident vertices follow
 * each other. */
static void outline_number_nodes(mw_outline *o, const node_vertex *vertices, uint32_t count)
{
    uint32_t next = 0;
    for (uint32_t kind = ON_OUTLINE; kind <= ON_FLAT; kind++) {
        for (uint32_t i = 0, end; i < count; i = end) {
            uint32_t lowest = ON_FLAT;
            for (end = i; end < count && vertices_coincide(&vertices[i], &vertices[end]); end++)
                if (vertices[end].kind == ON_OUTLINE) lowest = ON_OUTLINE;
            if (lowest != kind) continue;
            for (uint32_t j = i; j < end; j++)
                o->node[mw__vertex_slot(o->mesh, vertices[j].vertex)] = next;
            if (kind == ON_OUTLINE) {
                o->point[next] = vertices[i].point;
                o->vertex[next] = mw__vertex_slot(o->mesh, vertices[i].vertex);
            }
            next++;
        }
        if (kind == ON_OUTLINE) o->node_count = next;
    }
}

static bool outline_find_nodes(mw_outline *o)
{
    o->node = mw__alloc(o->mesh->point_count, sizeof *o->node);
    if (!o->node) return false;
    uint32_t count = outline_mark_vertices(o), n = 0;
    node_vertex *vertices = mw__alloc(count, sizeof *vertices);
    o->point = mw__alloc(count, sizeof *o->point);
    o->vertex = mw__alloc(count, sizeof *o->vertex);
    bool done = vertices && o->point && o->vertex;
    if (done) {
        for (uint32_t v = 0; v < o->mesh->point_count; v++)
            if (o->node[v] != MW_NONE)
                vertices[n++] =
                    (node_vertex){o->mesh->point[v], mw__vertex_number(o->mesh, v), o->node[v]};
        qsort(vertices, count, sizeof *vertices, compare_node_vertices);
        outline_number_nodes(o, vertices, count);
    }
    free(vertices);
    return done;
}

/* --- bridges --- */

static uint64_t node_pair(uint32_t a, uint32_t b)
{
    return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

static int compare_node_pairs(const void *left, const void *right)
{
    const uint64_t *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

static bool outline_find_bridges(mw_outline *o)
{
    if (!o->flat) return true;
    o->bridge = mw__alloc(3 * (size_t)o->mesh->flat_count, sizeof *o->bridge);
    if (!o->bridge) return false;
    for (uint32_t t = 0; t < o->mesh->tri_count; t++)
        for (uint32_t k = 0; k < 3 && o->flat[t]; k++) {
            uint32_t a = o->node[o->mesh->tri[t].v[k]], b = o->node[o->mesh->tri[t].v[k + 1]];
            if (a != b && a != MW_NONE && b != MW_NONE)
                o->bridge[o->bridge_count++] = node_pair(a, b);
        }
    qsort(o->bridge, o->bridge_count, sizeof *o->bridge, compare_node_pairs);
    return true;
}

bool mw__is_bridged(const mw_outline *o, uint32_t half)
{
    if (o->bridge_count == 0) return false;
    uint64_t key = node_pair(mw__outline_from(o, half), mw__outline_to(o, half));
    return bsearch(&key, o->bridge, o->bridge_count, sizeof key, compare_node_pairs) != NULL;
}

bool mw__outline_create(mw_outline *outline, const mw_mesh *mesh)
{
    *outline = (mw_outline){.mesh = mesh};
    return outline_find_flat(outline) && outline_find_edges(outline) &&
           outline_find_nodes(outline) && outline_find_bridges(outline);
}

void mw__outline_release(mw_outline *outline)
{
    free(outline->flat);
    free(outline->half);
    free(outline->node);
    free(outline->point);
    free(outline->vertex);
    free(outline->bridge);
    *outline = (mw_outline){0};
}
