/* partition_links.c - links triangles along the edges whose lower vertices are in one partition, by
 * a hash table.
 *
 * Of two neighbours with the same orientation, one runs along their edge upwards, from the lower
 * vertex to the upper one; the other runs downwards. So the half-edges that go down are put into a
 * hash table, and those that go up look for them there. This is done for a block of vertices at a
 * time: its half-edges stay in the first-level cache, and few entries of the table collide. Entries
 * of earlier blocks have lower numbers, so they are recognised and the table is never cleared. At
 * its lowest vertex a triangle has one half-edge of either direction; their positions are known
 * beforehand. The third half-edge is sorted in. A block that is not simple is matched vertex by
 * vertex. */
#include "mesh/partition_links.h"

#include <stdlib.h>
#include <string.h>

enum {
    BLOCK_SHIFT = 6, /* a block has 2^6 vertices; partitions begin with a block */
    BLOCK = 1 << BLOCK_SHIFT,
    MOST_ENTRIES = 1024, /* half-edges of a simple block; 384 are expected */
    TABLE_BITS = 13
};

/* A half-edge by its vertices. The key is the lower vertex, in the upper bits, and the upper
 * one. */
typedef struct mw_edge_entry {
    uint64_t key;
    uint32_t half; /* 4 * triangle + edge */
    uint32_t next; /* of an entry that goes down: the previous one with the same table index */
} mw_edge_entry;

/* The entries of a block: those from `from` on go down, those from `middle` on go up. Either group
 * begins with the block's own entries, those at the lowest vertices of triangles, in the order of
 * the triangles: the entry of triangle t has number t + own[up]. */
typedef struct mw_vertex_block {
    uint32_t from, middle, own[2];
    /* The number of other entries that go down and up; then where the next one goes. */
    uint32_t next[2];
    /* End of the triangles with their lowest vertex in the block, from the partition's first. */
    uint32_t triangles;
} mw_vertex_block;

/* --- blocks --- */

static MW_INLINE mw_vertex_block *block_of(mw_vertex_block *block, mw_partition partition,
                                           uint32_t vertex)
{
    return &block[(vertex - partition.base) >> BLOCK_SHIFT];
}

/* The corner with the lowest vertex. */
static MW_INLINE uint32_t triangle_low_corner(const uint32_t v[3])
{
    uint32_t low = mw__lowest_of_three(v[0], v[1], v[2]);
    return (uint32_t)(v[1] == low) + 2 * (uint32_t)(v[2] == low);
}

/* The vertices that stray i runs from and to. Its triangle may be anywhere in memory. */
static MW_INLINE const uint32_t *stray_ends(const mw_triangle *tri, mw_strays strays, uint32_t i)
{
    enum { AHEAD = 16 };
    if (i + AHEAD < strays.count)
        __builtin_prefetch(&tri[mw__link_triangle(strays.half[i + AHEAD])]);
    return &tri[mw__link_triangle(strays.half[i])].v[mw__link_edge(strays.half[i])];
}

static MW_INLINE void block_count_other(mw_vertex_block *block, mw_partition partition,
                                        uint32_t from, uint32_t to)
{
    block_of(block, partition, from < to ? from : to)->next[from < to]++;
}

static void blocks_count_edges(const mw_triangle *tri, mw_partition partition, mw_strays strays,
                               mw_vertex_block *block)
{
    for (uint32_t t = partition.first; t < partition.end; t++) {
        const uint32_t *v = tri[t].v;
        uint32_t k = triangle_low_corner(v), x = v[k + 1], y = v[mw__prev(k)];
        block_of(block, partition, v[k])->triangles = t + 1 - partition.first;
        if (MW_LIKELY(mw__partition_has(partition, x < y ? x : y)))
            block_count_other(block, partition, x, y);
    }
    for (uint32_t i = 0; i < strays.count; i++) {
        const uint32_t *ends = stray_ends(tri, strays, i);
        block_count_other(block, partition, ends[0], ends[1]);
    }
}

static void blocks_sum_counts(mw_partition partition, uint32_t blocks, mw_vertex_block *block)
{
    uint32_t sum = 1, own = 0; /* no entry has number 0 */
    for (mw_vertex_block *b = block; b < block + blocks; b++) {
        uint32_t begin = own;
        if (b->triangles > own) own = b->triangles;
        b->from = sum;
        for (int up = 0; up < 2; up++) {
            uint32_t others = b->next[up];
            if (up) b->middle = sum;
            b->own[up] = sum - begin - partition.first;
            b->next[up] = sum + (own - begin);
            sum += own - begin + others;
        }
    }
}

static MW_INLINE void entry_put(mw_edge_entry *to, uint32_t lower, uint32_t upper, uint32_t half)
{
    to->key = (uint64_t)lower << 32 | upper;
    to->half = half;
}

static MW_INLINE void entry_put_other(mw_edge_entry *entry, mw_vertex_block *block,
                                      mw_partition partition, uint32_t from, uint32_t to,
                                      uint32_t half)
{
    uint32_t low = from < to ? from : to, high = from < to ? to : from;
    entry_put(&entry[block_of(block, partition, low)->next[from < to]++], low, high, half);
}

static void entries_fill(const mw_triangle *tri, mw_partition partition, mw_strays strays,
                         mw_vertex_block *block, mw_edge_entry *entry)
{
    for (uint32_t t = partition.first; t < partition.end; t++) {
        const uint32_t *v = tri[t].v;
        uint32_t k = triangle_low_corner(v), low = v[k], x = v[k + 1], y = v[mw__prev(k)];
        const mw_vertex_block *b = block_of(block, partition, low);
        uint32_t up = b->own[1] + t, down = b->own[0] + t;
        entry_put(&entry[up], low, x, mw__link(t, k));
        entry_put(&entry[down], low, y, mw__link(t, mw__prev(k)));
        if (MW_LIKELY(mw__partition_has(partition, x < y ? x : y)))
            entry_put_other(entry, block, partition, x, y, mw__link(t, mw__next(k)));
    }
    for (uint32_t i = 0; i < strays.count; i++) {
        const uint32_t *ends = stray_ends(tri, strays, i);
        entry_put_other(entry, block, partition, ends[0], ends[1], strays.half[i]);
    }
}

/* --- matching --- */

static MW_INLINE uint32_t table_index(uint64_t key)
{
    return (uint32_t)(key * UINT64_C(0x9e3779b97f4a7c15) >> (64 - TABLE_BITS));
}

/* Enter the half-edges that go down into the table. Returns false where two have the same edge. */
static bool table_enter(mw_edge_entry *entry, uint32_t *table, const mw_vertex_block *b)
{
    for (uint32_t i = b->from; i < b->middle; i++) {
        uint32_t *last = &table[table_index(entry[i].key)], j = *last;
        entry[i].next = j;
        *last = i;
        for (; MW_UNLIKELY(j >= b->from); j = entry[j].next)
            if (entry[j].key == entry[i].key) return false;
    }
    return true;
}

/* Does an entry from `from` up to, not including, i have the key of entry i? */
static bool entry_is_double(const mw_edge_entry *entry, uint32_t from, uint32_t i)
{
    while (from < i && entry[from].key != entry[i].key) from++;
    return from < i;
}

/* Every half-edge that goes up looks for its mate. Those without a mate move to the front, so that
 * two of the same edge are found among them. Returns false where an edge has more than two halves,
 * or two that both go up. */
static bool entries_find_mates(mw_triangle *tri, mw_edge_entry *entry, const uint32_t *table,
                               const mw_vertex_block *b, mw_links *links)
{
    uint32_t end = b->next[1], single = b->middle;
    for (uint32_t i = b->middle; i < end; i++) {
        uint32_t j = table[table_index(entry[i].key)];
        while (MW_UNLIKELY(entry[j].key != entry[i].key) && j >= b->from) j = entry[j].next;
        if (MW_LIKELY(j >= b->from)) {
            uint32_t *mates = mw__half_edge_link(tri, entry[j].half);
            if (MW_UNLIKELY(*mates != MW_NONE)) return false;
            *mates = entry[i].half;
            *mw__half_edge_link(tri, entry[i].half) = entry[j].half;
        } else {
            mw_edge_entry alone = entry[i];
            entry[i] = entry[single];
            entry[single] = alone;
            if (entry_is_double(entry, b->middle, single++)) return false;
        }
    }
    links->linked += 2 * (uint64_t)(end - single);
    return true;
}

/* Group the half-edges of the block by their lower vertices. Those of vertex i of the block go to
 * half[first[i]] up to, not including, half[first[i + 1]]. Removes the links that they have. */
static void block_split_by_vertex(mw_triangle *tri, const mw_edge_entry *entry, uint32_t n,
                                  mw_half_edge *half, uint32_t *first)
{
    uint32_t next[BLOCK] = {0}, sum = 0;
    for (uint32_t i = 0; i < n; i++) next[(entry[i].key >> 32) % BLOCK]++;
    for (uint32_t v = 0; v < BLOCK; v++) {
        first[v] = sum;
        sum += next[v];
        next[v] = first[v];
    }
    first[BLOCK] = sum;
    for (uint32_t i = 0; i < n; i++) {
        *mw__half_edge_link(tri, entry[i].half) = MW_NONE;
        half[next[(entry[i].key >> 32) % BLOCK]++] =
            (mw_half_edge){(uint32_t)entry[i].key, entry[i].half};
    }
}

/* Match any half-edges, linked or not. */
static bool block_match_each(mw_triangle *tri, const mw_edge_entry *entry, const mw_vertex_block *b,
                             mw_links *links)
{
    uint32_t n = b->next[1] - b->from, first[BLOCK + 1];
    mw_half_edge *half = mw__alloc(n, sizeof *half);
    if (!half) return false;
    block_split_by_vertex(tri, entry + b->from, n, half, first);
    bool done = true;
    for (uint32_t v = 0; v < BLOCK && done; v++)
        done = mw__half_edges_match(tri, half + first[v], first[v + 1] - first[v], links);
    free(half);
    return done;
}

static bool block_match(mw_triangle *tri, const mw_link_workspace *workspace,
                        const mw_vertex_block *b, mw_links *links)
{
    mw_edge_entry *entry = workspace->entry;
    bool simple = b->next[1] - b->from <= MOST_ENTRIES && table_enter(entry, workspace->table, b) &&
                  entries_find_mates(tri, entry, workspace->table, b, links);
    return simple || block_match_each(tri, entry, b, links);
}

/* --- all --- */

static bool link_workspace_reserve(mw_link_workspace *workspace, size_t entries, size_t blocks)
{
    if (workspace->entries < entries) {
        free(workspace->entry);
        workspace->entries = entries + entries / 4;
        workspace->entry = mw__alloc_lines(workspace->entries, sizeof *workspace->entry);
        if (!workspace->entry) workspace->entries = 0;
    }
    if (workspace->blocks < blocks) {
        free(workspace->block);
        workspace->blocks = blocks;
        workspace->block = mw__alloc_lines(workspace->blocks, sizeof *workspace->block);
        if (!workspace->block) workspace->blocks = 0;
    }
    if (!workspace->table)
        workspace->table = mw__alloc_lines((size_t)1 << TABLE_BITS, sizeof *workspace->table);
    return workspace->entry && workspace->block && workspace->table;
}

bool mw__partition_link(mw_triangle *tri, mw_partition partition, mw_strays strays,
                        mw_link_workspace *workspace, mw_links *links)
{
    uint32_t blocks = (partition.size >> BLOCK_SHIFT) + 1;
    size_t entries = 3 * (size_t)(partition.end - partition.first) + strays.count + 1;
    if (!link_workspace_reserve(workspace, entries, blocks)) return false;
    memset(workspace->block, 0, blocks * sizeof *workspace->block);
    memset(workspace->table, 0, sizeof *workspace->table << TABLE_BITS);
    workspace->entry[0] = (mw_edge_entry){0};
    blocks_count_edges(tri, partition, strays, workspace->block);
    blocks_sum_counts(partition, blocks, workspace->block);
    entries_fill(tri, partition, strays, workspace->block, workspace->entry);
    bool done = true;
    for (uint32_t i = 0; i < blocks && done; i++)
        done = block_match(tri, workspace, &workspace->block[i], links);
    return done;
}

void mw__link_workspace_release(mw_link_workspace *workspace)
{
    free(workspace->entry);
    free(workspace->block);
    free(workspace->table);
}
