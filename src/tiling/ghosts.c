/* ghosts.c - makes tiles: the user's triangles, cut where vertices lie inside their edges, and
 * ghosts.
 *
 *          C           A triangle with vertices p1 .. pm inside edge AB becomes a fan from C to
 *         /|\          p1 .. pm, and the triangles p1 C A and pm B C at its sides. These are fans
 *        / | \         from p1 and pm to the vertices inside CA and BC. No tile is flat: the
 *       A--p--B        vertices inside an edge lie on it exactly, the tip of each fan does not. */
#include "tiling/ghosts.h"

#include "mesh/connect.h"

#include <inttypes.h>
#include <string.h>

typedef struct tile_maker {
    const mw_outline *outline;
    const mw_coverage *coverage;
    mw_tiling *tiling;
    uint32_t edge; /* the next outline edge */
    size_t split;  /* the next split */
} tile_maker;

/* The representative of the vertices at the node of v. */
static uint32_t node_representative(const mw_outline *o, uint32_t v)
{
    return o->node[v] < o->node_count ? o->vertex[o->node[v]] : v;
}

static void tile_add(mw_tiling *tiling, uint32_t user, uint32_t a, uint32_t b, uint32_t c)
{
    tiling->tri[tiling->tri_count++] =
        (mw_triangle){.v = {a, b, c, a}, .link = {MW_NONE, MW_NONE, MW_NONE}, .user = user};
}

/* The splits of one edge, from its first vertex on. */
typedef struct edge_splits {
    const mw_split *first;
    size_t count;
} edge_splits;

/* Add tiles from `tip` to the segments of the edge from a to b. */
static void tiles_add_fan(tile_maker *m, uint32_t user, uint32_t tip, uint32_t a, uint32_t b,
                          edge_splits inside)
{
    for (size_t i = 0; i < inside.count; i++) {
        uint32_t next = m->outline->vertex[inside.first[i].node];
        tile_add(m->tiling, user, tip, a, next);
        a = next;
    }
    tile_add(m->tiling, user, tip, a, b);
}

static void tiles_add_cut(tile_maker *m, uint32_t user, const uint32_t v[3],
                          const edge_splits inside[3])
{
    uint32_t k = 0;
    while (inside[k].count == 0) k++;
    uint32_t a = v[k], b = v[mw__next(k)], c = v[mw__prev(k)];
    edge_splits middle = inside[k];
    uint32_t first = m->outline->vertex[middle.first[0].node];
    uint32_t last = m->outline->vertex[middle.first[middle.count - 1].node];
    tiles_add_fan(m, user, first, c, a, inside[mw__prev(k)]);
    if (middle.count > 1)
        tiles_add_fan(m, user, c, first, last, (edge_splits){middle.first + 1, middle.count - 2});
    tiles_add_fan(m, user, last, b, c, inside[mw__next(k)]);
    m->tiling->cut = true;
}

/* Add the tiles of the user's triangle t. Triangles come in increasing order, as outline edges and
 * splits are sorted. */
static void tiles_add_user(tile_maker *m, uint32_t t)
{
    const mw_triangle *tri = &m->outline->mesh->tri[t];
    uint32_t v[3];
    edge_splits inside[3] = {{0}};
    bool cut = false;
    for (int k = 0; k < 3; k++) v[k] = node_representative(m->outline, tri->v[k]);
    for (; m->edge < m->outline->half_count && mw__link_triangle(m->outline->half[m->edge]) == t;
         m->edge++) {
        edge_splits *here = &inside[mw__link_edge(m->outline->half[m->edge])];
        size_t begin = m->split;
        while (m->split < m->coverage->split_count && m->coverage->split[m->split].edge == m->edge)
            m->split++;
        if (m->split == begin) continue;
        *here = (edge_splits){m->coverage->split + begin, m->split - begin};
        cut = true;
    }
    if (cut)
        tiles_add_cut(m, tri->user, v, inside);
    else
        tile_add(m->tiling, tri->user, v[0], v[1], v[2]);
}

static void tiles_add_ghosts(tile_maker *m, const mw_regions *regions)
{
    for (uint32_t t = 0; t < m->coverage->cell_count; t++) {
        if (m->coverage->degree[t] != 0) continue;
        const uint32_t *v = m->coverage->cell[t].v, *vertex = m->outline->vertex;
        uint32_t user = MW_GHOST | regions->list[regions->of[t]].hole;
        tile_add(m->tiling, user, vertex[v[0]], vertex[v[1]], vertex[v[2]]);
    }
}

uint32_t mw__ghosts_count(const mw_coverage *coverage)
{
    uint32_t count = 0;
    for (uint32_t t = 0; t < coverage->cell_count; t++) count += coverage->degree[t] == 0;
    return count;
}

mw_status mw__ghosts_fill(const mw_embedding_check *check, bool fill, mw_job *job,
                          mw_tiling *tiling, mw_error *error)
{
    const mw_mesh *mesh = check->mesh;
    mw__job_stage(job, "filling holes", 0.3);
    tile_maker m = {.outline = &check->outline, .coverage = &check->coverage, .tiling = tiling};
    tiling->ghost_count = fill ? mw__ghosts_count(m.coverage) : 0;
    tiling->hole_count = check->regions.hole_count;
    tiling->point_count = mesh->point_count;
    /* each split adds a tile */
    uint64_t most = (uint64_t)mesh->tri_count - mesh->flat_count + m.coverage->split_count +
                    tiling->ghost_count;
    if (most > MW_MAX_TRIANGLES)
        return mw__fail(error, MW_ERROR_LIMIT,
                        "%" PRIu64 " triangles would fill the hull of the mesh; at most %" PRIu32
                        " are possible",
                        most, MW_MAX_TRIANGLES);
    tiling->tri = mw__alloc_lines(most, sizeof *tiling->tri);
    tiling->point = mw__alloc_lines(mesh->point_count, sizeof *tiling->point);
    if (!tiling->tri || !tiling->point) return mw__fail_memory(error);
    if (mesh->point_count > 0)
        memcpy(tiling->point, mesh->point, mesh->point_count * sizeof *tiling->point);
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        if (!mw__is_flat(m.outline, t)) tiles_add_user(&m, t);
    if (fill) tiles_add_ghosts(&m, &check->regions);
    mw_job_span outer = mw__job_part(job, 0.7);
    bool done = mw__connect(tiling->tri, tiling->tri_count, tiling->point_count, job, NULL);
    mw__job_part_end(job, outer);
    return done ? MW_OK : mw__fail_memory(error);
}
