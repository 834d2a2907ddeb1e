/* rank_boxes.c - which rank has a triangle, and which ranks a point is asked of. */
#include "bench/ranks/rank_boxes.h"

#include <math.h>
#include <stdlib.h>

/* Those of mpi/mesh/router.c. */
enum { FAN = 8, MOST_BOXES = 64, ALL_BOXES = 1 << 20, BOX_BYTES = 40 };

bool rank_boxes_create(rank_boxes *b, const mw_mesh *mesh)
{
    const uint32_t n = mw_mesh_triangle_count(mesh);
    mw_error error;
    *b = (rank_boxes){.triangles = n,
                      .order = malloc(n * sizeof *b->order),
                      .place = malloc(n * sizeof *b->place)};
    if (!b->order || !b->place) return false;
    if (mw_mesh_hilbert_order(mesh, b->order, NULL, &error) != MW_OK) return false;
    for (uint32_t i = 0; i < n; i++) b->place[b->order[i]] = i;
    return true;
}

void rank_boxes_release(rank_boxes *b)
{
    free(b->order);
    free(b->place);
    free(b->box);
    *b = (rank_boxes){0};
}

static rank_box rank_box_empty(uint32_t rank)
{
    return (rank_box){{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, rank};
}

static void rank_box_add(rank_box *box, const double low[2], const double high[2])
{
    for (int k = 0; k < 2; k++) {
        box->low[k] = fmin(box->low[k], low[k]);
        box->high[k] = fmax(box->high[k], high[k]);
    }
}

/* The box of triangles `begin` to `end` along the curve. */
static rank_box rank_box_of_run(const rank_boxes *b, const mw_mesh *mesh, size_t begin, size_t end,
                                uint32_t rank)
{
    rank_box box = rank_box_empty(rank);
    uint32_t v[3];
    double p[2];
    for (size_t i = begin; i < end; i++) {
        mw_mesh_triangle(mesh, b->order[i], v);
        for (int k = 0; k < 3; k++) {
            mw_mesh_vertex(mesh, v[k], p);
            rank_box_add(&box, p, p);
        }
    }
    return box;
}

static size_t rank_begin(uint64_t triangles, uint32_t ranks, uint64_t rank)
{
    return (size_t)(triangles * rank / ranks);
}

/* The boxes of all ranks, as many as there are; returns their number. */
static size_t rank_boxes_fill(rank_boxes *b, const mw_mesh *mesh)
{
    const uint32_t n = b->triangles, share = ALL_BOXES / b->ranks;
    const uint32_t most = share < 1 ? 1 : share > MOST_BOXES ? MOST_BOXES : share;
    size_t made = 0;
    for (uint32_t rank = 0; rank < b->ranks; rank++) {
        const size_t begin = rank_begin(n, b->ranks, rank);
        const size_t count = rank_begin(n, b->ranks, rank + 1) - begin;
        for (size_t run = 0; run < most; run++) {
            const size_t from = begin + count * run / most, to = begin + count * (run + 1) / most;
            if (from < to) b->box[made++] = rank_box_of_run(b, mesh, from, to, rank);
        }
    }
    return made;
}

static void rank_boxes_stack(rank_boxes *b)
{
    size_t begin = 0, end = b->level[1];
    for (b->levels = 1; end - begin > 1; b->levels++) {
        size_t next = end;
        for (size_t i = begin; i < end; i++) {
            if ((i - begin) % FAN == 0) b->box[next++] = rank_box_empty(0);
            rank_box_add(&b->box[next - 1], b->box[i].low, b->box[i].high);
        }
        begin = end;
        end = next;
        b->level[b->levels + 1] = end;
    }
}

bool rank_boxes_cut(rank_boxes *b, const mw_mesh *mesh, uint32_t ranks)
{
    const size_t most = (size_t)ranks * MOST_BOXES;
    free(b->box);
    b->ranks = ranks;
    /* the levels above add a seventh, and at most one box each */
    b->box = malloc((most + most / (FAN - 1) + 16) * sizeof *b->box);
    if (!b->box) return false;
    b->level[0] = 0;
    b->level[1] = rank_boxes_fill(b, mesh);
    rank_boxes_stack(b);
    return true;
}

uint32_t rank_boxes_owner(const rank_boxes *b, uint32_t triangle)
{
    const uint64_t n = b->triangles, place = b->place[triangle];
    uint32_t rank = (uint32_t)(place * b->ranks / n);
    while (rank_begin(n, b->ranks, rank + 1) <= place) rank++;
    while (rank_begin(n, b->ranks, rank) > place) rank--;
    return rank;
}

static bool rank_box_has(const rank_box *box, const double p[2])
{
    return p[0] >= box->low[0] && p[0] <= box->high[0] && p[1] >= box->low[1] &&
           p[1] <= box->high[1];
}

/* Boxes come in the order of ranks, so a rank that comes again is the last one. */
static uint32_t rank_boxes_descend(const rank_boxes *b, uint32_t level, size_t node,
                                   const double p[2], uint32_t *ranks, uint32_t count)
{
    const rank_box *box = &b->box[b->level[level] + node];
    if (!rank_box_has(box, p)) return count;
    if (level == 0) {
        if (count == 0 || ranks[count - 1] != box->rank) ranks[count++] = box->rank;
        return count;
    }
    const size_t size = b->level[level] - b->level[level - 1];
    const size_t end = (node + 1) * FAN < size ? (node + 1) * FAN : size;
    for (size_t child = node * FAN; child < end; child++)
        count = rank_boxes_descend(b, level - 1, child, p, ranks, count);
    return count;
}

uint32_t rank_boxes_find(const rank_boxes *b, const double point[2], uint32_t *ranks)
{
    return rank_boxes_descend(b, b->levels - 1, 0, point, ranks, 0);
}

size_t rank_boxes_bytes(const rank_boxes *b)
{
    return b->level[b->levels] * BOX_BYTES;
}
