/* complete.c - the user's triangles, cut where vertices lie inside their edges, and ghosts beside them.
 *
 *          C           A triangle with vertices p1 .. pm inside edge AB: a fan from C to p1 .. pm, and the triangles
 *         /|\          p1 C A and pm B C at its sides, which are fans from p1 and pm to the vertices inside CA and BC.
 *        / | \         No tile is flat: the vertices inside an edge lie on it exactly, the tip of each fan does not. */
#include "domain/complete.h"

#include "mesh/connect.h"

#include <inttypes.h>
#include <string.h>

typedef struct maker {
    const mw_outline *outline;
    const mw_cover *cover;
    mw_tiling *tiling;
    uint32_t edge; /* the next outline edge */
    size_t split;  /* the next split        */
} maker;

/* The vertex that stands for all at the place of v. */
static uint32_t merged(const mw_outline *o, uint32_t v)
{
    return o->place[v] < o->place_count ? o->vertex[o->place[v]] : v;
}

static void add_tile(mw_tiling *tiling, uint32_t user, uint32_t a, uint32_t b, uint32_t c)
{
    tiling->tri[tiling->tri_count++] =
        (mw_triangle){.v = {a, b, c, a}, .link = {MW_NONE, MW_NONE, MW_NONE}, .user = user};
}

/* The splits of one edge, from its first vertex on. */
typedef struct splits {
    const mw_split *first;
    size_t count;
} splits;

/* Triangles from `tip` to the parts of the edge from a to b. */
static void add_fan(maker *m, uint32_t user, uint32_t tip, uint32_t a, uint32_t b, splits inside)
{
    for (size_t i = 0; i < inside.count; i++) {
        uint32_t next = m->outline->vertex[inside.first[i].place];
        add_tile(m->tiling, user, tip, a, next);
        a = next;
    }
    add_tile(m->tiling, user, tip, a, b);
}

static void add_cut(maker *m, uint32_t user, const uint32_t v[3], const splits inside[3])
{
    uint32_t k = 0;
    while (inside[k].count == 0) k++;
    uint32_t a = v[k], b = v[mw__next(k)], c = v[mw__prev(k)];
    splits middle = inside[k];
    uint32_t first = m->outline->vertex[middle.first[0].place];
    uint32_t last = m->outline->vertex[middle.first[middle.count - 1].place];
    add_fan(m, user, first, c, a, inside[mw__prev(k)]);
    if (middle.count > 1) add_fan(m, user, c, first, last, (splits){middle.first + 1, middle.count - 2});
    add_fan(m, user, last, b, c, inside[mw__next(k)]);
    m->tiling->cut = true;
}

/* The tiles of the user's triangle t; triangles are taken in increasing order, as outline edges and splits are
 * sorted. */
static void add_user(maker *m, uint32_t t)
{
    const mw_triangle *tri = &m->outline->mesh->tri[t];
    uint32_t v[3];
    splits inside[3] = {{0}};
    bool cut = false;
    for (int k = 0; k < 3; k++) v[k] = merged(m->outline, tri->v[k]);
    for (; m->edge < m->outline->half_count && mw__link_triangle(m->outline->half[m->edge]) == t; m->edge++) {
        splits *here = &inside[mw__link_edge(m->outline->half[m->edge])];
        size_t begin = m->split;
        while (m->split < m->cover->split_count && m->cover->split[m->split].edge == m->edge) m->split++;
        if (m->split == begin) continue;
        *here = (splits){m->cover->split + begin, m->split - begin};
        cut = true;
    }
    if (cut)
        add_cut(m, tri->user, v, inside);
    else
        add_tile(m->tiling, tri->user, v[0], v[1], v[2]);
}

static void add_ghosts(maker *m, const mw_regions *regions)
{
    for (uint32_t t = 0; t < m->cover->cell_count; t++) {
        if (m->cover->degree[t] != 0) continue;
        const uint32_t *v = m->cover->cell[t].v, *vertex = m->outline->vertex;
        uint32_t user = MW_GHOST | regions->list[regions->of[t]].hole;
        add_tile(m->tiling, user, vertex[v[0]], vertex[v[1]], vertex[v[2]]);
    }
}

uint32_t mw__ghosts_wanted(const mw_cover *cover)
{
    uint32_t count = 0;
    for (uint32_t t = 0; t < cover->cell_count; t++) count += cover->degree[t] == 0;
    return count;
}

mw_status mw__complete(const mw_survey *survey, bool fill, mw_tiling *tiling, mw_error *error)
{
    const mw_mesh *mesh = survey->mesh;
    maker m = {.outline = &survey->outline, .cover = &survey->cover, .tiling = tiling};
    tiling->ghost_count = fill ? mw__ghosts_wanted(m.cover) : 0;
    tiling->hole_count = survey->regions.hole_count;
    tiling->point_count = mesh->point_count;
    /* each split makes one tile more */
    uint64_t most = (uint64_t)mesh->tri_count - mesh->flat_count + m.cover->split_count + tiling->ghost_count;
    if (most > MW_MAX_TRIANGLES)
        return mw__fail(error, MW_ERROR_LIMIT,
                        "%" PRIu64 " triangles fill the hull of the mesh, at most %" PRIu32 " are possible", most,
                        MW_MAX_TRIANGLES);
    tiling->tri = mw__alloc_lines(most, sizeof *tiling->tri);
    tiling->point = mw__alloc_lines(mesh->point_count, sizeof *tiling->point);
    if (!tiling->tri || !tiling->point) return mw__fail_memory(error);
    if (mesh->point_count > 0) memcpy(tiling->point, mesh->point, mesh->point_count * sizeof *tiling->point);
    for (uint32_t t = 0; t < mesh->tri_count; t++)
        if (!mw__is_flat(m.outline, t)) add_user(&m, t);
    if (fill) add_ghosts(&m, &survey->regions);
    return mw__connect(tiling->tri, tiling->tri_count, tiling->point_count, tiling->threads, NULL)
               ? MW_OK
               : mw__fail_memory(error);
}
