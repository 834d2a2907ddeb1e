/* partition_links.h - partitions of a mesh, and the links within one. Private. */
#ifndef MW_SRC_MESH_PARTITION_LINKS_H
#define MW_SRC_MESH_PARTITION_LINKS_H

#include "mesh/match.h"

/* A partition: the vertices from `base` up to, not including, base + size, and the triangles whose
 * lowest vertex is one of these. Triangles are sorted by their lowest vertex: `first` up to, not
 * including, `end`. */
typedef struct mw_partition {
    uint32_t base, size, first, end;
} mw_partition;

static MW_INLINE bool mw__partition_has(mw_partition partition, uint32_t vertex)
{
    return vertex - partition.base < partition.size;
}

/* Strays: half-edges that belong to the partition, as their lower vertex is in it, but whose
 * triangles belong to others. 4 * triangle + edge, in any order. */
typedef struct mw_strays {
    const uint32_t *half;
    uint32_t count;
} mw_strays;

/* Memory for linking a partition, used again for the next one. */
typedef struct mw_link_workspace {
    struct mw_edge_entry *entry;
    struct mw_vertex_block *block;
    uint32_t *table;
    size_t entries, blocks; /* capacity */
} mw_link_workspace;

/* Link the triangles of a partition, which have no links yet, and the strays, along the edges whose
 * lower vertex is in the partition. Adds the results to *links. The workspace is zero at first.
 * Returns false when out of memory. */
bool mw__partition_link(mw_triangle *tri, mw_partition partition, mw_strays strays,
                        mw_link_workspace *workspace, mw_links *links);
void mw__link_workspace_release(mw_link_workspace *workspace);

#endif
