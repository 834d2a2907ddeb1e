/* prepared_check.c - what a prepared file may hold, even if someone made it to do harm.
 *
 * A walk relies on tiles that fill a convex polygon edge to edge: then it stays within the tiles,
 * and it ends (docs/proofs/walks.md). So this is decided here as for any mesh (tiling/convex.h),
 * after each record has been checked: numbers within their ranges, links that lead back, tiles
 * counter-clockwise by the exact orient2d. A tile must lie in the triangle whose number it has, and
 * the owner of a vertex must be the lowest triangle that has it; so the rule of ties holds.
 * The guide may name any tile: that makes walks longer, but not wrong. In the guide, only the
 * numbers that searches rely on are checked.
 *
 * One pass over each part, shared among the threads. Each pass notes the first record that is
 * wrong, so that the message does not depend on the threads. */
#include "prepared/prepared_check.h"

#include "base/checksum.h"
#include "base/hilbert.h"
#include "prepared/prepared_guide_check.h"
#include "tiling/convex.h"

#include <inttypes.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

typedef struct prepared_checking {
    const mw_prepared *p;
    _Atomic uint64_t bad; /* the first record that is wrong; UINT64_MAX: none */
    _Atomic uint64_t flat, reversed, border, clashing, covered;
} prepared_checking;

static void checking_note(prepared_checking *c, uint64_t record)
{
    uint64_t known = atomic_load(&c->bad);
    while (record < known && !atomic_compare_exchange_weak(&c->bad, &known, record)) continue;
}

/* --- checksums -------------------------------------------------------------------------------- */

static void part_check_sum(void *work, uint64_t kind, uint32_t member)
{
    prepared_checking *c = work;
    const mw_prepared_part *part = &c->p->header.part[kind];
    (void)member;
    if (part->bytes && mw__checksum_of(c->p->bytes + part->offset, part->bytes) != part->checksum)
        checking_note(c, kind);
}

/* The bytes between the parts. */
static bool gaps_are_zero(const mw_prepared *p)
{
    uint64_t from = sizeof p->header;
    for (int kind = 0; kind <= MW_PART_COUNT; kind++) {
        const mw_prepared_part *part = &p->header.part[kind];
        const bool last = kind == MW_PART_COUNT;
        if (!last && part->bytes == 0) continue;
        for (uint64_t i = from; i < (last ? p->header.bytes : part->offset); i++)
            if (p->bytes[i] != 0) return false;
        if (!last) from = part->offset + part->bytes;
    }
    return true;
}

static mw_status check_sums(const mw_prepared *p, mw_job *job, mw_error *error)
{
    prepared_checking c = {.p = p, .bad = UINT64_MAX};
    mw__job_stage(job, "checking checksums", 0.3);
    if (!mw__job_chunks(job, mw__job_team(job, MW_PART_COUNT), MW_PART_COUNT, part_check_sum, &c))
        return mw__fail_memory(error);
    if (c.bad != UINT64_MAX)
        return mw__prepared_fail(p, error, "the checksum of part '%s' is wrong",
                                 mw__prepared_part_name((mw_prepared_kind)c.bad));
    return gaps_are_zero(p) ? MW_OK
                            : mw__prepared_fail(p, error, "there are bytes between its parts");
}

/* --- records ---------------------------------------------------------------------------------- */

/* Is one of the records from .. to - 1 wrong? It is noted. */
typedef mw_range_work records_check;

static mw_status check_records(prepared_checking *c, mw_prepared_kind kind, records_check *check,
                               mw_job *job, mw_error *error)
{
    const uint64_t count =
        mw__prepared_records(c->p, kind) ? mw__prepared_part_count(&c->p->header.facts, kind) : 0;
    if (!mw__job_ranges(job, count, check, c)) return mw__fail_memory(error);
    return c->bad == UINT64_MAX
               ? MW_OK
               : mw__prepared_fail(c->p, error, "part '%s': record %" PRIu64 " is wrong",
                                   mw__prepared_part_name(kind), c->bad);
}

/* What a record names lies anywhere in memory: that of a later record is asked for. A number that
 * is wrong does no harm there. */
enum { RECORDS_AHEAD = 16 };

static void check_ask(const uint32_t *of, uint32_t number)
{
    if (of) __builtin_prefetch(&of[number]);
}

/* Numbers and slots of vertices: each the inverse of the other. */
static void vertex_slots_check(void *work, uint64_t from, uint64_t to)
{
    prepared_checking *c = work;
    const mw_mesh *mesh = &c->p->mesh;
    for (uint32_t v = (uint32_t)from; v < to; v++) {
        if (to - v > RECORDS_AHEAD)
            check_ask(mesh->vertex_number, mesh->vertex_slot[v + RECORDS_AHEAD]);
        if (mesh->vertex_slot[v] >= mesh->point_count ||
            mesh->vertex_number[mesh->vertex_slot[v]] != v)
            checking_note(c, v);
    }
}

/* Has the record three vertices that exist, each once, with finite coordinates? */
static bool record_has_vertices(const mw_triangle *t, const mw_point *point, uint32_t points)
{
    if (t->v[3] != t->v[0]) return false;
    for (int k = 0; k < 3; k++)
        if (t->v[k] >= points || !mw__is_finite(point[t->v[k]])) return false;
    return mw__has_three_vertices(t);
}

typedef enum link_state { LINK_WRONG, LINK_NONE, LINK_OPPOSITE, LINK_CLASHING } link_state;

/* Does edge k of record t lead to an edge of the same two vertices, which leads back? */
static link_state record_link_state(const mw_triangle *tri, uint32_t count, uint32_t t, uint32_t k)
{
    const uint32_t link = tri[t].link[k];
    if (link == MW_NONE) return LINK_NONE;
    const uint32_t other = mw__link_triangle(link), edge = mw__link_edge(link);
    if (other >= count || edge > 2 || tri[other].link[edge] != mw__link(t, k)) return LINK_WRONG;
    const uint32_t a = tri[t].v[k], b = tri[t].v[k + 1], u = tri[other].v[edge],
                   w = tri[other].v[edge + 1];
    if (u == b && w == a) return LINK_OPPOSITE;
    return u == a && w == b ? LINK_CLASHING : LINK_WRONG;
}

static bool triangle_is_sound(const mw_mesh *mesh, uint32_t t)
{
    const mw_triangle *tri = &mesh->tri[t];
    const uint32_t number = tri->user & MW_USER_MASK;
    return record_has_vertices(tri, mesh->point, mesh->point_count) && !(tri->user & MW_GHOST) &&
           number < mesh->tri_count && mw__triangle_slot(mesh, number) == t;
}

static void triangle_ask(const mw_mesh *mesh, uint32_t t)
{
    const mw_triangle *tri = &mesh->tri[t];
    check_ask(mesh->triangle_slot, tri->user & MW_USER_MASK);
    for (int k = 0; k < 3; k++) __builtin_prefetch(&mesh->tri[mw__link_triangle(tri->link[k])]);
}

/* The triangles of the mesh: counter-clockwise or flat, each number once. */
static void triangles_check(void *work, uint64_t from, uint64_t to)
{
    prepared_checking *c = work;
    const mw_mesh *mesh = &c->p->mesh;
    uint64_t flat = 0, reversed = 0, border = 0, clashing = 0;
    for (uint32_t t = (uint32_t)from; t < to; t++) {
        const mw_triangle *tri = &mesh->tri[t];
        if (to - t > RECORDS_AHEAD) triangle_ask(mesh, t + RECORDS_AHEAD);
        if (!triangle_is_sound(mesh, t)) {
            checking_note(c, t);
            return;
        }
        const double area =
            mw__orient2d(mesh->point[tri->v[0]], mesh->point[tri->v[1]], mesh->point[tri->v[2]]);
        if (area < 0) checking_note(c, t);
        flat += area == 0;
        reversed += (tri->user & MW_REVERSED) != 0;
        for (uint32_t k = 0; k < 3; k++) {
            const link_state state = record_link_state(mesh->tri, mesh->tri_count, t, k);
            if (state == LINK_WRONG) checking_note(c, t);
            border += state == LINK_NONE;
            clashing += state == LINK_CLASHING;
        }
    }
    atomic_fetch_add(&c->flat, flat);
    atomic_fetch_add(&c->reversed, reversed);
    atomic_fetch_add(&c->border, border);
    atomic_fetch_add(&c->clashing, clashing);
}

/* Does p lie in a counter-clockwise triangle, its border included? */
static bool triangle_has_point(const mw_mesh *mesh, const mw_triangle *tri, mw_point p)
{
    for (int k = 0; k < 3; k++)
        if (mw__orient2d(mesh->point[tri->v[k]], mesh->point[tri->v[k + 1]], p) < 0) return false;
    return true;
}

/* A tile of a triangle: the triangle itself, with vertices at the same places, or a piece of it. */
static bool tile_is_in_triangle(const mw_prepared *p, const mw_triangle *tile)
{
    const mw_mesh *mesh = &p->mesh;
    const uint32_t number = tile->user & MW_USER_MASK;
    if (number >= mesh->tri_count) return false;
    const mw_triangle *tri = &mesh->tri[mw__triangle_slot(mesh, number)];
    if (tri->user != tile->user || !mw__has_area(mesh->point, tri)) return false;
    for (int k = 0; k < 3; k++) {
        const mw_point at = mesh->point[tile->v[k]];
        if (p->locator.tiling.cut ? !triangle_has_point(mesh, tri, at)
                                  : !mw__points_equal(at, mesh->point[tri->v[k]]))
            return false;
    }
    return true;
}

/* The tiles come in the order of the slots of their triangles, then the ghosts. Pieces of a
 * triangle follow each other. */
static uint64_t tile_rank(const mw_prepared *p, uint32_t t)
{
    const mw_tiling *tiling = &p->locator.tiling;
    const uint32_t number = tiling->tri[t].user & MW_USER_MASK;
    return number < p->mesh.tri_count ? mw__triangle_slot(&p->mesh, number) : UINT64_MAX;
}

static bool tile_follows(const mw_prepared *p, uint32_t t, uint64_t *covered)
{
    const uint64_t rank = tile_rank(p, t), before = t > 0 ? tile_rank(p, t - 1) : 0;
    const bool another = t == 0 || rank != before;
    *covered += another;
    return t == 0 || rank > before || (rank == before && p->locator.tiling.cut);
}

static bool tile_is_named(const mw_prepared *p, uint32_t t, uint64_t *covered)
{
    const mw_tiling *tiling = &p->locator.tiling;
    const mw_triangle *tile = &tiling->tri[t];
    if (t < tiling->tri_count - tiling->ghost_count)
        return tile_is_in_triangle(p, tile) && tile_follows(p, t, covered);
    const uint32_t hole = tile->user & MW_USER_MASK;
    return tile->user & MW_GHOST && !(tile->user & MW_REVERSED) &&
           (hole < tiling->hole_count || hole == MW_POCKET);
}

/* The tiles: with an area, counter-clockwise, edge to edge. */
static void tiles_check(void *work, uint64_t from, uint64_t to)
{
    prepared_checking *c = work;
    const mw_tiling *tiling = &c->p->locator.tiling;
    uint64_t border = 0, covered = 0;
    for (uint32_t t = (uint32_t)from; t < to; t++) {
        const mw_triangle *tile = &tiling->tri[t];
        if (!record_has_vertices(tile, tiling->point, tiling->point_count) ||
            !mw__has_area(tiling->point, tile) || !tile_is_named(c->p, t, &covered)) {
            checking_note(c, t);
            return;
        }
        for (uint32_t k = 0; k < 3; k++) {
            const link_state state = record_link_state(tiling->tri, tiling->tri_count, t, k);
            if (state != LINK_NONE && state != LINK_OPPOSITE) checking_note(c, t);
            border += state == LINK_NONE;
        }
    }
    atomic_fetch_add(&c->border, border);
    atomic_fetch_add(&c->covered, covered);
}

/* The owner of a vertex has it; and no tile with a lower number does (tiles_check_owners). */
static void owners_check(void *work, uint64_t from, uint64_t to)
{
    prepared_checking *c = work;
    const mw_mesh *mesh = &c->p->mesh;
    const uint32_t *owner = c->p->locator.tiling.owner;
    for (uint32_t v = (uint32_t)from; v < to; v++) {
        if (to - v > 2 * RECORDS_AHEAD) {
            check_ask(mesh->triangle_slot, owner[v + 2 * RECORDS_AHEAD]);
            const uint32_t o = owner[v + RECORDS_AHEAD];
            if (o < mesh->tri_count) __builtin_prefetch(&mesh->tri[mw__triangle_slot(mesh, o)]);
        }
        if (owner[v] == MW_NONE) continue;
        if (owner[v] >= mesh->tri_count || !mw__is_finite(mesh->point[v])) {
            checking_note(c, v);
            continue;
        }
        const mw_triangle *tri = &mesh->tri[mw__triangle_slot(mesh, owner[v])];
        const bool corner = tri->v[0] == v || tri->v[1] == v || tri->v[2] == v;
        if (!mw__has_area(mesh->point, tri) ||
            !(corner || triangle_has_point(mesh, tri, mesh->point[v])))
            checking_note(c, v);
    }
}

static void tiles_check_owners(void *work, uint64_t from, uint64_t to)
{
    prepared_checking *c = work;
    const mw_tiling *tiling = &c->p->locator.tiling;
    for (uint32_t t = (uint32_t)from; t < to; t++) {
        const mw_triangle *tile = &tiling->tri[t];
        for (int k = 0; k < 3 && !(tile->user & MW_GHOST); k++)
            if (tiling->owner[tile->v[k]] > (tile->user & MW_USER_MASK)) checking_note(c, t);
    }
}

/* --- mesh and tiling -------------------------------------------------------------------------- */

/* *border and *clashing become the numbers of edges without a link, and of links on one side. */
static mw_status check_mesh(const mw_prepared *p, mw_job *job, uint64_t *border, uint64_t *clashing,
                            mw_error *error)
{
    const mw_mesh *mesh = &p->mesh;
    prepared_checking c = {.p = p, .bad = UINT64_MAX};
    mw__job_stage(job, "checking triangles", 0.3);
    mw_status status = check_records(&c, MW_PART_VERTEX_SLOTS, vertex_slots_check, job, error);
    if (!status) status = check_records(&c, MW_PART_TRIANGLES, triangles_check, job, error);
    if (status) return status;
    *border = c.border;
    *clashing = c.clashing;
    /* without `opposite` a mesh does not know its border */
    if (c.flat != mesh->flat_count || c.reversed != mesh->reversed_count ||
        (mesh->opposite && (c.clashing > 0 || c.border != mesh->border_count)))
        return mw__prepared_fail(p, error, "it has more or fewer triangles than its header says");
    return MW_OK;
}

/* Do the tiles, each of which has been checked, fill a convex polygon? */
static bool tiles_are_convex(const mw_tiling *tiling, uint64_t border)
{
    const mw_mesh tiles = {.point = tiling->point,
                           .tri = tiling->tri,
                           .point_count = tiling->point_count,
                           .tri_count = tiling->tri_count,
                           .border_count = (uint32_t)border,
                           .opposite = true};
    return mw__mesh_is_convex(&tiles);
}

static mw_status check_tiling(const mw_prepared *p, uint64_t border, uint64_t clashing, mw_job *job,
                              mw_error *error)
{
    const mw_tiling *tiling = &p->locator.tiling;
    prepared_checking c = {.p = p, .bad = UINT64_MAX};
    mw__job_stage(job, "checking tiles", 0.3);
    mw_status status = check_records(&c, MW_PART_TILES, tiles_check, job, error);
    if (status) return status;
    if (!tiling->borrowed) {
        border = c.border;
        if (c.covered != (uint64_t)p->mesh.tri_count - p->mesh.flat_count)
            return mw__prepared_fail(p, error, "part 'tiles': a triangle has no tile");
    } else if (clashing > 0) {
        return mw__prepared_fail(p, error, "part 'triangles': two lie on the same side of an edge");
    }
    if (!tiles_are_convex(tiling, border))
        return mw__prepared_fail(p, error, "its triangles do not fill a convex polygon");
    status = check_records(&c, MW_PART_OWNERS, owners_check, job, error);
    if (status) return status;
    if (!mw__job_ranges(job, tiling->tri_count, tiles_check_owners, &c))
        return mw__fail_memory(error);
    return c.bad == UINT64_MAX ? MW_OK
                               : mw__prepared_fail(p, error,
                                                   "part 'owners': tile %" PRIu64
                                                   " has a lower number than the owner of a corner",
                                                   c.bad);
}

mw_status mw__prepared_check(const mw_prepared *p, mw_job *job, mw_error *error)
{
    uint64_t border = 0, clashing = 0;
    mw_status status = check_sums(p, job, error);
    if (!status) status = check_mesh(p, job, &border, &clashing, error);
    if (!status) status = check_tiling(p, border, clashing, job, error);
    if (status) return status;
    mw__job_stage(job, "checking the guide", 0.1);
    return mw__prepared_check_guide(p, error);
}
