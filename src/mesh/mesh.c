/* mesh.c - what a planar mesh tells of itself, and its end. */
#include "mesh/mesh.h"

#include <stdlib.h>

void mw_mesh_destroy(mw_mesh *mesh)
{
    if (!mesh) return;
    for (size_t i = 0; i < mesh->field_count; i++) {
        free(mesh->field[i].name);
        free(mesh->field[i].values);
    }
    free(mesh->field);
    free(mesh->tri);
    free(mesh->triangle_place);
    free(mesh->vertex_place);
    free(mesh->users_vertex);
    free(mesh->point);
    free(mesh);
}

uint32_t mw_mesh_vertex_count(const mw_mesh *mesh)
{
    return mesh->point_count;
}

uint32_t mw_mesh_triangle_count(const mw_mesh *mesh)
{
    return mesh->tri_count;
}

void mw_mesh_vertex(const mw_mesh *mesh, uint32_t vertex, double point[2])
{
    mw_point p = mesh->point[mw__vertex_place(mesh, vertex)];
    point[0] = p.x;
    point[1] = p.y;
}

void mw_mesh_triangle(const mw_mesh *mesh, uint32_t triangle, uint32_t vertices[3])
{
    const mw_triangle *t = &mesh->tri[mw__triangle_place(mesh, triangle)];
    for (uint32_t k = 0; k < 3; k++) vertices[mw__user_vertex(t->user, k)] = mw__users_vertex(mesh, t->v[k]);
}

uint32_t mw_mesh_neighbour(const mw_mesh *mesh, uint32_t triangle, unsigned local_edge, unsigned *edge)
{
    const mw_triangle *t = &mesh->tri[mw__triangle_place(mesh, triangle)];
    uint32_t link = t->link[mw__user_edge(t->user, local_edge)]; /* the exchange is its own inverse */
    if (link == MW_NONE) return MW_NONE;
    uint32_t user = mesh->tri[mw__link_triangle(link)].user;
    if (edge) *edge = mw__user_edge(user, mw__link_edge(link));
    return user & MW_USER_MASK;
}

size_t mw_mesh_bytes(const mw_mesh *mesh)
{
    size_t vertex = sizeof *mesh->point + mesh->field_count * sizeof(double), triangle = sizeof *mesh->tri;
    if (mesh->vertex_place) vertex += sizeof *mesh->vertex_place + sizeof *mesh->users_vertex;
    if (mesh->triangle_place) triangle += sizeof *mesh->triangle_place;
    return sizeof *mesh + mesh->point_count * vertex + mesh->tri_count * triangle +
           mesh->field_count * sizeof *mesh->field;
}
