#include "io/grid/msh_source.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* --- numbers --- */

mw_number_type mw__msh_size(const mw_msh_source *m)
{
    return (mw_number_type){MW_NUMBER_UNSIGNED, m->word_size};
}

mw_status mw__msh_integer(mw_msh_source *m, const char *what, int64_t *value, mw_error *error)
{
    static const mw_number_type integer = {MW_NUMBER_SIGNED, 4};
    return mw__value_integer(&m->values, integer, what, value, error);
}

mw_status mw__msh_count(mw_msh_source *m, const char *what, int64_t *value, mw_error *error)
{
    mw_number_type type =
        m->version == 41 ? mw__msh_size(m) : (mw_number_type){MW_NUMBER_UNSIGNED, 8};
    mw_status status = mw__value_integer(&m->values, type, what, value, error);
    if (!status && *value < 0)
        status = mw__source_fail(m->values.source, error, "the %s is %" PRId64, what, *value);
    return status;
}

mw_status mw__msh_real(mw_msh_source *m, const char *what, double *value, mw_error *error)
{
    static const mw_number_type real = {MW_NUMBER_FLOAT, 8};
    return mw__value_double(&m->values, real, what, value, error);
}

mw_status mw__msh_skip_reals(mw_msh_source *m, int64_t count, mw_error *error)
{
    mw_status status = MW_OK;
    double ignored;
    for (int64_t i = 0; !status && i < count; i++)
        status = mw__msh_real(m, "number", &ignored, error);
    return status;
}

static mw_status msh_skip_integers(mw_msh_source *m, const char *what, int64_t count,
                                   mw_error *error)
{
    mw_status status = MW_OK;
    int64_t ignored;
    for (int64_t i = 0; !status && i < count; i++)
        status = mw__msh_integer(m, what, &ignored, error);
    return status;
}

/* --- groups --- */

/* The group is left without a name if there is no memory for it. */
static mw_status msh_add_group(mw_msh_groups *groups, mw_msh_group group, mw_error *error)
{
    if (groups->count == groups->room) {
        size_t room = groups->room < 16 ? 16 : groups->room + groups->room / 2;
        mw_msh_group *items = mw__realloc(groups->items, room, sizeof *items);
        if (!items) {
            free(group.name);
            return mw__fail_memory(error);
        }
        groups->items = items;
        groups->room = room;
    }
    groups->items[groups->count++] = group;
    return MW_OK;
}

static int msh_compare_groups(const void *one, const void *other)
{
    const mw_msh_group *a = one, *b = other;
    if (a->dimension != b->dimension) return a->dimension < b->dimension ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

const mw_msh_group *mw__msh_find_group(const mw_msh_groups *groups, int64_t dimension,
                                       int64_t number)
{
    const mw_msh_group wanted = {.dimension = dimension, .number = number};
    return groups->count
               ? bsearch(&wanted, groups->items, groups->count, sizeof wanted, msh_compare_groups)
               : NULL;
}

void mw__msh_sort_groups(mw_msh_groups *groups)
{
    if (groups->count)
        qsort(groups->items, groups->count, sizeof *groups->items, msh_compare_groups);
}

static void msh_release_groups(mw_msh_groups *groups)
{
    for (size_t i = 0; i < groups->count; i++) free(groups->items[i].name);
    free(groups->items);
}

void mw__msh_release(mw_msh_source *m)
{
    msh_release_groups(&m->names);
    msh_release_groups(&m->entities);
}

/* --- sections --- */

/* dimension number "name" */
mw_status mw__msh_read_names(mw_msh_source *m, mw_error *error)
{
    int64_t count;
    mw_status status = mw__value_word_count(&m->values, "number of names", &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        mw_msh_group group = {0};
        status = mw__value_word_integer(&m->values, "dimension", &group.dimension, error);
        if (!status)
            status = mw__value_word_integer(&m->values, "number of a group", &group.number, error);
        if (status) return status;
        char *name = mw__value_rest(&m->values), *end = strrchr(name, '"');
        name = strchr(name, '"');
        if (!name || name == end)
            return mw__source_fail(m->values.source, error, "a group has no name in quotes");
        *end = 0;
        group.name = strdup(name + 1);
        if (!group.name) return mw__fail_memory(error);
        status = msh_add_group(&m->names, group, error);
    }
    return status;
}

/* What follows the box of an entity: its physical groups, of which the first counts, and, except
 * for points, what bounds it. A negative number is a group whose entities are turned round. */
static mw_status msh_finish_entity(mw_msh_source *m, mw_msh_group *entity, mw_error *error)
{
    int64_t count = 0;
    mw_status status = mw__msh_count(m, "number of groups", &count, error);
    if (!status && count > 0) {
        status = mw__msh_integer(m, "physical group", &entity->physical, error);
        if (!status && entity->physical < 0) entity->physical = 0 - entity->physical;
        if (!status) status = msh_skip_integers(m, "physical group", count - 1, error);
    }
    if (!status && entity->dimension > 0) {
        status = mw__msh_count(m, "number of bounds", &count, error);
        if (!status) status = msh_skip_integers(m, "bound", count, error);
    }
    return status ? status : msh_add_group(&m->entities, *entity, error);
}

/* Number, box, physical groups, bounds. */
static mw_status msh_read_entity(mw_msh_source *m, int64_t dimension, mw_error *error)
{
    mw_msh_group entity = {.dimension = dimension};
    mw_status status = mw__msh_integer(m, "number of an entity", &entity.number, error);
    if (!status) status = mw__msh_skip_reals(m, dimension == 0 && m->version == 41 ? 3 : 6, error);
    return status ? status : msh_finish_entity(m, &entity, error);
}

/* Number, dimension and number of the whole, partitions, box, physical groups, bounds. */
static mw_status msh_read_part(mw_msh_source *m, int64_t dimension, mw_error *error)
{
    mw_msh_group entity = {.dimension = dimension};
    int64_t count;
    mw_status status = mw__msh_integer(m, "number of an entity", &entity.number, error);
    if (!status) status = msh_skip_integers(m, "whole of an entity", 2, error);
    if (!status) status = mw__msh_count(m, "number of partitions", &count, error);
    if (!status) status = msh_skip_integers(m, "partition", count, error);
    if (!status) status = mw__msh_skip_reals(m, dimension == 0 ? 3 : 6, error);
    return status ? status : msh_finish_entity(m, &entity, error);
}

typedef mw_status msh_entity_reader(mw_msh_source *m, int64_t dimension, mw_error *error);

/* The numbers of points, curves, surfaces and volumes, and then these. */
static mw_status msh_read_all(mw_msh_source *m, msh_entity_reader *read, mw_error *error)
{
    int64_t counts[4];
    mw_status status = MW_OK;
    for (int d = 0; !status && d < 4; d++)
        status = mw__msh_count(m, "number of entities", &counts[d], error);
    for (int d = 0; !status && d < 4; d++)
        for (int64_t i = 0; !status && i < counts[d]; i++) status = read(m, d, error);
    return status;
}

mw_status mw__msh_read_entities(mw_msh_source *m, mw_error *error)
{
    return msh_read_all(m, msh_read_entity, error);
}

mw_status mw__msh_read_partitions(mw_msh_source *m, mw_error *error)
{
    int64_t ignored, ghosts;
    mw_status status = mw__msh_count(m, "number of partitions", &ignored, error);
    if (!status) status = mw__msh_count(m, "number of ghost entities", &ghosts, error);
    for (int64_t i = 0; !status && i < ghosts; i++)
        status = msh_skip_integers(m, "ghost entity", 2, error);
    return status ? status : msh_read_all(m, msh_read_part, error);
}
