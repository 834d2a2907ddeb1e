/* part_sets.h - connected parts: disjoint sets (union-find), each represented by its lowest member.
 */
#ifndef MW_CLI_LINES_PART_SETS_H
#define MW_CLI_LINES_PART_SETS_H

#include <stdint.h>

/* The lowest member of the set of a part. parent[part] is the part itself at the beginning. */
static inline uint32_t part_root(uint32_t *parent, uint32_t part)
{
    while (parent[part] != part) part = parent[part] = parent[parent[part]];
    return part;
}

static inline void part_join(uint32_t *parent, uint32_t a, uint32_t b)
{
    uint32_t p = part_root(parent, a), q = part_root(parent, b);
    parent[p > q ? p : q] = p > q ? q : p;
}

#endif
