#include "bench/worst/trap_peers.h"
#include "bench/peers/engine_list.h"
#include "cli/frame/message.h"

#include <stdlib.h>

static int trap_peers_copy(trap_peers *p, const mw_mesh *mesh, size_t n)
{
    const uint32_t points = mw_mesh_vertex_count(mesh), count = mw_mesh_triangle_count(mesh);
    p->points = malloc(2 * sizeof *p->points * points);
    p->triangles = malloc(3 * sizeof *p->triangles * count);
    p->answers = malloc(sizeof *p->answers * n);
    if (!p->points || !p->triangles || !p->answers) return fail_memory();
    for (uint32_t v = 0; v < points; v++) mw_mesh_vertex(mesh, v, &p->points[2 * (size_t)v]);
    for (uint32_t t = 0; t < count; t++) mw_mesh_triangle(mesh, t, &p->triangles[3 * (size_t)t]);
    p->mesh = (engine_mesh){p->points, points, p->triangles, count};
    return 0;
}

static const char *trap_peer_name(const trap_peers *p, size_t k)
{
    return engines[p->peers[k].id].name;
}

int trap_peers_build(trap_peers *p, uint32_t set, const mw_mesh *mesh, size_t n,
                     trap_peer_figures *figures)
{
    int end = set ? trap_peers_copy(p, mesh, n) : 0;
    for (engine_id id = 0; id < ENGINES && end == 0; id++) {
        const engine_code *code = engine_is_in(set, id) ? engine_code_of(id) : NULL;
        if (!code || !code->locate) continue;
        if (!engine_library_has_room(engines[id].library, p->mesh.point_count)) continue;
        trap_peer *peer = &p->peers[p->count];
        *peer = (trap_peer){.id = id, .code = code};
        double seconds = code->structure->build(&p->mesh, 1, &peer->structure);
        if (!peer->structure) {
            complain("%s cannot be built of this mesh", engines[id].name);
            continue;
        }
        figures[id].build = seconds;
        p->count++;
    }
    return end;
}

void trap_peers_release(trap_peers *p)
{
    for (size_t k = 0; k < p->count; k++)
        p->peers[k].code->structure->destroy(p->peers[k].structure);
    free(p->points);
    free(p->triangles);
    free(p->answers);
    *p = (trap_peers){0};
}

int trap_peers_locate(trap_peers *p, size_t k, const double *queries, size_t n, double *seconds)
{
    *seconds = p->peers[k].code->locate(p->peers[k].structure, queries, n, 1, p->answers);
    if (*seconds != ENGINE_FAILED) return 0;
    complain("%s fails at these queries", trap_peer_name(p, k));
    return END_RESOURCE;
}

/* Does the triangle of the answer have the point? */
static bool trap_peer_is_right(const trap_peers *p, const trap_peer *peer, uint64_t answer,
                               const double *query)
{
    double c[6];
    if (answer == ENGINE_NONE) return false;
    if (peer->code->structure->corners)
        peer->code->structure->corners(peer->structure, answer, c);
    else
        for (size_t i = 0; i < 6; i++)
            c[i] = p->points[2 * (size_t)p->triangles[3 * answer + i / 2] + i % 2];
    return engine_contains(&c[0], &c[2], &c[4], query);
}

double trap_peers_wrong(trap_peers *p, size_t k, const double *queries, size_t n,
                        const mw_location *locations)
{
    size_t wrong = 0, judged = 0;
    double seconds;
    if (trap_peers_locate(p, k, queries, n, &seconds)) return 1;
    for (size_t i = 0; i < n; i++) {
        if (locations[i].triangle == MW_NONE) continue;
        judged++;
        wrong += !trap_peer_is_right(p, &p->peers[k], p->answers[i], &queries[2 * i]);
    }
    return judged ? (double)wrong / (double)judged : 0;
}

void trap_peers_triangulate(uint32_t set, const double *points, size_t n,
                            trap_peer_figures *figures)
{
    for (engine_id id = 0; id < ENGINES; id++) {
        size_t bytes;
        const engine_code *code = engine_is_in(set, id) ? engine_code_of(id) : NULL;
        if (code && code->triangulate) figures[id].build = code->triangulate(points, n, 1, &bytes);
    }
}
