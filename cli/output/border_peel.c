#include "cli/output/border_peel.h"
#include "cli/frame/message.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* The ends of an edge. */
typedef struct peel_edge {
    uint32_t low, high;
} peel_edge;

typedef struct peeler {
    const mw_mesh *mesh;
    double longest;
    peel_edge *fixed; /* constrained edges, sorted */
    size_t fixed_count;
    uint32_t *queue; /* the triangles that go, in the order in which they were found */
    uint8_t *gone;   /* per triangle */
    size_t count;
} peeler;

static peel_edge peel_edge_of(uint32_t a, uint32_t b)
{
    return a < b ? (peel_edge){a, b} : (peel_edge){b, a};
}

static int compare_peel_edges(const void *left, const void *right)
{
    const peel_edge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    return (a->high > b->high) - (a->high < b->high);
}

static bool peeler_create(peeler *p, const mw_constrained_edges *edges)
{
    size_t triangles = mw_mesh_triangle_count(p->mesh);
    p->fixed_count = edges->count;
    p->fixed = malloc((edges->count + 1) * sizeof *p->fixed);
    p->queue = malloc((triangles + 1) * sizeof *p->queue);
    p->gone = calloc(triangles + 1, 1);
    if (!p->fixed || !p->queue || !p->gone) return false;
    for (size_t i = 0; i < edges->count; i++)
        p->fixed[i] = peel_edge_of(edges->edge[2 * i], edges->edge[2 * i + 1]);
    qsort(p->fixed, p->fixed_count, sizeof *p->fixed, compare_peel_edges);
    return true;
}

static void peeler_release(peeler *p)
{
    free(p->fixed);
    free(p->queue);
    free(p->gone);
}

/* Take the triangle off if this edge of it, on the border, is long. */
static void peeler_try(peeler *p, uint32_t triangle, unsigned edge)
{
    uint32_t v[3];
    double a[2], b[2];
    mw_mesh_triangle(p->mesh, triangle, v);
    mw_mesh_vertex(p->mesh, v[edge], a);
    mw_mesh_vertex(p->mesh, v[(edge + 1) % 3], b);
    if (p->gone[triangle] || !(hypot(b[0] - a[0], b[1] - a[1]) > p->longest)) return;
    peel_edge key = peel_edge_of(v[edge], v[(edge + 1) % 3]);
    if (bsearch(&key, p->fixed, p->fixed_count, sizeof key, compare_peel_edges)) return;
    p->gone[triangle] = 1;
    p->queue[p->count++] = triangle;
}

static void peeler_run(peeler *p)
{
    uint32_t triangles = mw_mesh_triangle_count(p->mesh);
    for (uint32_t t = 0; t < triangles; t++)
        for (unsigned k = 0; k < 3; k++)
            if (mw_mesh_neighbour(p->mesh, t, k, NULL) == MW_NONE) peeler_try(p, t, k);
    for (size_t i = 0; i < p->count; i++)
        for (unsigned k = 0; k < 3; k++) {
            unsigned edge;
            uint32_t t = mw_mesh_neighbour(p->mesh, p->queue[i], k, &edge);
            if (t != MW_NONE) peeler_try(p, t, edge);
        }
}

/* Take the triangles out of the file, and count the points that only they had. */
static bool peeler_apply(const peeler *p, mw_mesh_file *file, border_peel *peel)
{
    uint8_t *used = calloc(file->point_count + 1, 1);
    if (!used) return false;
    size_t left = 0;
    for (size_t t = 0; t < file->triangle_count; t++) {
        const uint32_t *v = file->triangles + 3 * t;
        for (int k = 0; k < 3; k++) used[v[k]] |= p->gone[t] ? 1 : 2;
        if (!p->gone[t]) memmove(file->triangles + 3 * left++, v, 3 * sizeof *v);
    }
    for (size_t i = 0; i < file->point_count; i++) peel->points += used[i] == 1;
    peel->triangles = file->triangle_count - left;
    file->triangle_count = left;
    free(used);
    return true;
}

int border_peel_off(const mw_mesh *mesh, double longest, const mw_constrained_edges *edges,
                    mw_mesh_file *file, border_peel *peel)
{
    peeler p = {.mesh = mesh, .longest = longest};
    *peel = (border_peel){0};
    bool done = peeler_create(&p, edges);
    if (done) peeler_run(&p);
    done = done && peeler_apply(&p, file, peel);
    peeler_release(&p);
    return done ? 0 : fail_memory();
}
