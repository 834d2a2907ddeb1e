#include "prepared/tiles/tile_triangles.h"

#include <meshwalk/predicates.h>
#include <stdlib.h>
#include <string.h>

static bool triangle_is_flat(const mw_mesh *mesh, uint32_t t)
{
    uint32_t v[3];
    double p[3][2];
    mw_mesh_triangle(mesh, t, v);
    for (int k = 0; k < 3; k++) mw_mesh_vertex(mesh, v[k], p[k]);
    return mw_orient2d(p[0], p[1], p[2]) == 0;
}

/* --- groups of flat triangles: those that share vertices -------------------------------------- */

/* The vertex that stands for a group. */
static uint32_t group_find(uint32_t *group, uint32_t v)
{
    while (group[v] != v) v = group[v] = group[group[v]];
    return v;
}

static bool groups_make(mw_tile_triangles *all)
{
    const uint32_t vertices = mw_mesh_vertex_count(all->mesh);
    uint32_t v[3];
    all->group = mw__alloc(vertices, sizeof *all->group);
    all->met = mw__calloc(vertices, sizeof *all->met);
    if (!all->group || !all->met) return false;
    memset(all->group, 0xff, vertices * sizeof *all->group);
    for (uint32_t i = 0; i < all->flat_count; i++) {
        mw_mesh_triangle(all->mesh, all->flat[i], v);
        for (int k = 0; k < 3; k++)
            if (all->group[v[k]] == MW_NONE) all->group[v[k]] = v[k];
        for (int k = 1; k < 3; k++)
            all->group[group_find(all->group, v[k])] = group_find(all->group, v[0]);
    }
    return true;
}

/* Note the groups that a triangle of a tile touches. */
static void groups_meet(mw_tile_triangles *all, uint32_t t, uint32_t tile)
{
    uint32_t v[3];
    mw_mesh_triangle(all->mesh, t, v);
    for (int k = 0; k < 3; k++)
        if (all->group[v[k]] != MW_NONE) all->met[group_find(all->group, v[k])] = tile + 1;
}

static bool group_is_met(mw_tile_triangles *all, uint32_t t, uint32_t tile)
{
    uint32_t v[3];
    mw_mesh_triangle(all->mesh, t, v);
    return all->met[group_find(all->group, v[0])] == tile + 1;
}

/* --- all triangles ---------------------------------------------------------------------------- */

mw_status mw__tile_triangles_create(mw_tile_triangles *all, const mw_mesh *mesh, uint32_t tiles,
                                    mw_error *error)
{
    const uint32_t count = mw_mesh_triangle_count(mesh);
    uint32_t solid_count = 0, *solid = mw__alloc(count, sizeof *solid);
    *all = (mw_tile_triangles){.mesh = mesh,
                               .flat = mw__alloc(count, sizeof *all->flat),
                               .chosen = mw__alloc(count, sizeof *all->chosen)};
    bool done = solid && all->flat && all->chosen;
    for (uint32_t t = 0; t < count && done; t++) {
        if (triangle_is_flat(mesh, t))
            all->flat[all->flat_count++] = t;
        else
            solid[solid_count++] = t;
    }
    if (done && tiles > solid_count) {
        free(solid);
        return mw__fail(error, MW_ERROR_INPUT,
                        "%u tiles are more than the %u triangles with an area", (unsigned)tiles,
                        (unsigned)solid_count);
    }
    done = done && mw__tile_cuts_create(&all->cuts, mesh, solid, solid_count, tiles) &&
           (all->flat_count == 0 || groups_make(all));
    free(solid);
    return done ? MW_OK : mw__fail_memory(error);
}

void mw__tile_triangles_release(mw_tile_triangles *all)
{
    mw__tile_cuts_release(&all->cuts);
    free(all->flat);
    free(all->group);
    free(all->met);
    free(all->chosen);
    *all = (mw_tile_triangles){0};
}

/* --- the triangles of a file ------------------------------------------------------------------ */

/* The next triangle of two ascending lists; `at` are the places in them. */
static uint32_t lists_next(const uint32_t *one, size_t ones, const uint32_t *other, size_t others,
                           size_t at[2])
{
    const bool first = at[1] == others || (at[0] < ones && one[at[0]] < other[at[1]]);
    return first ? one[at[0]++] : other[at[1]++];
}

void mw__tile_triangles_of_tile(mw_tile_triangles *all, uint32_t tile)
{
    const mw_tile_cuts *cuts = &all->cuts;
    const uint32_t *solid = cuts->triangle + cuts->begin[tile];
    const size_t count = cuts->begin[tile + 1] - cuts->begin[tile];
    all->chosen_count = 0;
    for (size_t i = 0; i < count && all->flat_count; i++) groups_meet(all, solid[i], tile);
    for (size_t at[2] = {0, 0}; at[0] < count || at[1] < all->flat_count;) {
        const size_t solids = at[0];
        const uint32_t t = lists_next(solid, count, all->flat, all->flat_count, at);
        if (at[0] > solids || group_is_met(all, t, tile)) all->chosen[all->chosen_count++] = t;
    }
}

bool mw__tile_triangles_of_overview(mw_tile_triangles *all)
{
    const mw_mesh *mesh = all->mesh;
    const uint32_t count = mw_mesh_triangle_count(mesh);
    uint32_t v[3];
    bool *marked = mw__calloc(mw_mesh_vertex_count(mesh), sizeof *marked);
    if (!marked) return false;
    for (uint32_t t = 0; t < count; t++) {
        mw_mesh_triangle(mesh, t, v);
        for (unsigned k = 0; k < 3; k++)
            if (mw_mesh_neighbour(mesh, t, k, NULL) == MW_NONE)
                marked[v[k]] = marked[v[(k + 1) % 3]] = true;
    }
    for (uint32_t i = 0; i < all->flat_count; i++) {
        mw_mesh_triangle(mesh, all->flat[i], v);
        for (int k = 0; k < 3; k++) marked[v[k]] = true;
    }
    all->chosen_count = 0;
    for (uint32_t t = 0; t < count; t++) {
        mw_mesh_triangle(mesh, t, v);
        if (marked[v[0]] || marked[v[1]] || marked[v[2]]) all->chosen[all->chosen_count++] = t;
    }
    free(marked);
    return true;
}
