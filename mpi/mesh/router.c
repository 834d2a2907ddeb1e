/* router.c - boxes of all ranks, in a tree. */
#include "mpi/mesh/router.h"

#include <math.h>
#include <stdlib.h>

enum { FAN = 8, MOST_LEVELS = 12 };

/* Boxes of one rank: 64, but fewer if all ranks together would have more than 2^20. */
static uint32_t boxes_of_a_rank(int ranks)
{
    enum { MOST = 64, ALL = 1 << 20 };
    const uint32_t share = ALL / (uint32_t)ranks;
    return share < 1 ? 1 : share > MOST ? MOST : share;
}

static mwp_box box_empty(int32_t rank)
{
    return (mwp_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, rank, 0};
}

static void box_add(mwp_box *box, const double low[2], const double high[2])
{
    for (int k = 0; k < 2; k++) {
        box->low[k] = fmin(box->low[k], low[k]);
        box->high[k] = fmax(box->high[k], high[k]);
    }
}

/* --- the boxes of this rank ------------------------------------------------------------------- */

static void box_add_triangle(mwp_box *box, const mw_mesh *mesh, uint32_t t)
{
    uint32_t v[3];
    double p[2];
    mw_mesh_triangle(mesh, t, v);
    for (int k = 0; k < 3; k++) {
        mw_mesh_vertex(mesh, v[k], p);
        box_add(box, p, p);
    }
}

/* Runs of triangles along a Hilbert curve; triangles from `count` on are not the rank's own. */
static mw_status boxes_of_mesh(const mw_mesh *mesh, uint32_t count, uint32_t most, int rank,
                               mwp_box *box, uint32_t *made, mwp_error *error)
{
    *made = 0;
    if (!mesh) return MW_OK;
    mw_error from;
    const uint32_t all = mw_mesh_triangle_count(mesh);
    uint32_t *order = mwp__alloc(all, sizeof *order);
    if (!order) return mwp__fail_memory(error);
    if (mw_mesh_hilbert_order(mesh, order, NULL, &from)) {
        free(order);
        return mwp__fail_as(error, &from);
    }
    for (uint32_t run = 0; run < most; run++) {
        mwp_box next = box_empty(rank);
        const uint32_t begin = (uint32_t)((uint64_t)all * run / most),
                       end = (uint32_t)((uint64_t)all * (run + 1) / most);
        for (uint32_t i = begin; i < end; i++)
            if (order[i] < count) box_add_triangle(&next, mesh, order[i]);
        if (next.low[0] <= next.high[0]) box[(*made)++] = next;
    }
    free(order);
    return MW_OK;
}

/* --- the tree --------------------------------------------------------------------------------- */

static bool router_build(mwp_router *router, const mwp_parcels *all)
{
    size_t total = all->total, n = all->total;
    router->count = (uint32_t)all->total;
    for (; n > 1; total += n) n = (n + FAN - 1) / FAN;
    router->box = mwp__alloc(total, sizeof *router->box);
    router->level = mwp__alloc(MOST_LEVELS + 1, sizeof *router->level);
    if (!router->box || !router->level) return false;
    for (size_t i = 0; i < all->total; i++) router->box[i] = ((const mwp_box *)all->records)[i];
    size_t begin = 0, end = all->total;
    router->level[0] = 0;
    router->level[router->levels = 1] = end;
    while (end - begin > 1) {
        size_t next = end;
        for (size_t i = begin; i < end; i++) {
            if ((i - begin) % FAN == 0) router->box[next++] = box_empty(-1);
            box_add(&router->box[next - 1], router->box[i].low, router->box[i].high);
        }
        begin = end;
        end = next;
        router->level[++router->levels] = end;
    }
    return true;
}

/* --- the grid --------------------------------------------------------------------------------- */

enum { SIDE = MWP_GRID_SIDE, MOST_BOXES = 64 * 64 };

static void grid_add_box(mwp_router *r, const mwp_box *box)
{
    const uint32_t begin = mwp__grid_place(r, box->low[0], 0),
                   end = mwp__grid_place(r, box->high[0], 0);
    for (uint32_t row = mwp__grid_place(r, box->low[1], 1);
         row <= mwp__grid_place(r, box->high[1], 1); row++)
        for (uint32_t column = begin; column <= end; column++) {
            int32_t *cell = &r->cell[row * SIDE + column];
            if (*cell == MWP_CELL_EMPTY)
                *cell = box->rank;
            else if (*cell != box->rank)
                *cell = MWP_CELL_SEVERAL;
        }
}

/* Without memory for it, or where a side has no finite length, there is no grid. */
static void router_make_grid(mwp_router *r)
{
    if (r->count == 0 || r->count > MOST_BOXES) return;
    r->all = r->box[r->level[r->levels - 1]];
    for (int axis = 0; axis < 2; axis++) {
        r->scale[axis] = SIDE / (r->all.high[axis] - r->all.low[axis]);
        if (!(r->scale[axis] > 0 && r->scale[axis] < INFINITY)) return;
    }
    r->cell = mwp__alloc(SIDE * SIDE, sizeof *r->cell);
    if (!r->cell) return;
    for (size_t i = 0; i < SIDE * SIDE; i++) r->cell[i] = MWP_CELL_EMPTY;
    for (uint32_t i = 0; i < r->count; i++) grid_add_box(r, &r->box[i]);
}

/* --- all of it -------------------------------------------------------------------------------- */

mw_status mwp__router_create(mwp_router *router, const mwp_wire *wire, const mw_mesh *mesh,
                             uint32_t triangles, mwp_error *error)
{
    const uint32_t most = boxes_of_a_rank(wire->size);
    uint32_t made = 0;
    mwp_parcels all = {0};
    *router = (mwp_router){0};
    mwp_box *mine = mwp__alloc(most, sizeof *mine);
    mw_status status = mine ? boxes_of_mesh(mesh, triangles, most, wire->rank, mine, &made, error)
                            : mwp__fail_memory(error);
    status = mwp__wire_gather(wire, status, mine, made, sizeof *mine, &all, error);
    if (!status)
        status = mwp__wire_agree(wire, router_build(router, &all) ? MW_OK : mwp__fail_memory(error),
                                 error);
    if (!status) router_make_grid(router);
    mwp__parcels_release(&all);
    free(mine);
    return status;
}

void mwp__router_release(mwp_router *router)
{
    free(router->box);
    free(router->level);
    free(router->cell);
    *router = (mwp_router){0};
}

size_t mwp__router_bytes(const mwp_router *router)
{
    const size_t cells = router->cell ? SIDE * SIDE * sizeof *router->cell : 0;
    return cells + (router->levels ? router->level[router->levels] * sizeof *router->box : 0);
}

/* --- look-ups --------------------------------------------------------------------------------- */

/* Boxes come in the order of ranks, so a rank that comes again is the last one. */
static int router_descend(const mwp_router *r, uint32_t level, size_t node, const double p[2],
                          int *ranks, int count)
{
    const mwp_box *box = &r->box[r->level[level] + node];
    if (!mwp__box_has(box, p)) return count;
    if (level == 0) {
        if (count == 0 || ranks[count - 1] != box->rank) ranks[count++] = box->rank;
        return count;
    }
    const size_t size = r->level[level] - r->level[level - 1];
    const size_t end = (node + 1) * FAN < size ? (node + 1) * FAN : size;
    for (size_t child = node * FAN; child < end; child++)
        count = router_descend(r, level - 1, child, p, ranks, count);
    return count;
}

int mwp__router_find(const mwp_router *router, const double point[2], int *ranks)
{
    const mwp_router *r = router;
    if (r->count == 0) return 0;
    ranks[0] = mwp__router_cell(r, point);
    if (ranks[0] != MWP_CELL_SEVERAL) return ranks[0] != MWP_CELL_EMPTY;
    return router_descend(r, r->levels - 1, 0, point, ranks, 0);
}
