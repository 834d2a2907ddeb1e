/* msh_source.h - what the sections of an MSH file share: numbers, whose sizes depend on the
 * version, and physical groups. Private. */
#ifndef MW_SRC_IO_GRID_MSH_SOURCE_H
#define MW_SRC_IO_GRID_MSH_SOURCE_H

#include "io/grid/value_source.h"

/* A name of a physical group, or the physical group of an entity. */
typedef struct mw_msh_group {
    int64_t dimension, number;
    int64_t physical; /* of an entity; 0: none */
    char *name;       /* of a physical group */
} mw_msh_group;

typedef struct mw_msh_groups {
    mw_msh_group *items;
    size_t count, room;
} mw_msh_groups;

typedef struct mw_msh_source {
    mw_value_source values;
    int version;      /* 22, 40 or 41 */
    size_t word_size; /* bytes of counts and tags of 4.1 as bytes */
    mw_msh_groups names, entities;
} mw_msh_source;

/* Numbers; `what` names them for messages. A negative count is an error. */
mw_status mw__msh_integer(mw_msh_source *m, const char *what, int64_t *value, mw_error *error);
mw_status mw__msh_count(mw_msh_source *m, const char *what, int64_t *value, mw_error *error);
mw_status mw__msh_real(mw_msh_source *m, const char *what, double *value, mw_error *error);
mw_status mw__msh_skip_reals(mw_msh_source *m, int64_t count, mw_error *error);
/* The type of counts and tags in 4.1. */
mw_number_type mw__msh_size(const mw_msh_source *m);

/* The sections $PhysicalNames, $Entities and $PartitionedEntities (of 4.1). */
mw_status mw__msh_read_names(mw_msh_source *m, mw_error *error);
mw_status mw__msh_read_entities(mw_msh_source *m, mw_error *error);
mw_status mw__msh_read_partitions(mw_msh_source *m, mw_error *error);

/* Sort groups, as mw__msh_find_group needs them; NULL: there is no such group. */
void mw__msh_sort_groups(mw_msh_groups *groups);
const mw_msh_group *mw__msh_find_group(const mw_msh_groups *groups, int64_t dimension,
                                       int64_t number);
void mw__msh_release(mw_msh_source *m);

#endif
