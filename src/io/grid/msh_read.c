/* MSH of Gmsh, versions 2.2, 4.0 and 4.1, as text and as bytes. Read are the vertices, and the
 * triangles and quadrilaterals; their physical group becomes the triangle field "physical" (0:
 * none), and lines of named physical groups mark edges. Points and volumes are passed over;
 * elements of higher order are refused. Numbers may have gaps: vertices are counted as they come,
 * faces too. */
#include "io/grid/grid_readers.h"
#include "io/grid/number_list.h"
#include "io/grid/value_source.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A name of a physical group, or the physical group of an entity. */
typedef struct msh_group {
    int64_t dimension, number;
    int64_t physical;
    char *name;
} msh_group;

typedef struct msh_groups {
    msh_group *items;
    size_t count, room;
} msh_groups;

typedef struct msh_mesh {
    mw_value_source values;
    mw_mesh_builder *builder;
    int version;      /* 22, 40 or 41 */
    size_t word_size; /* bytes of counts and tags of 4.1 as bytes */
    mw_rank_list vertices;
    msh_groups names, entities;
    mw_number_list physical; /* of each face */
    mw_integer_list edges;   /* three numbers each: physical group, two vertices */
    bool grouped, have_nodes, have_elements;
    int64_t other; /* a type of element that was passed over; 0: none */
} msh_mesh;

static const mw_number_type msh_int = {MW_NUMBER_SIGNED, 4};
static const mw_number_type msh_real = {MW_NUMBER_FLOAT, 8};

static mw_number_type msh_size(const msh_mesh *m)
{
    return (mw_number_type){MW_NUMBER_UNSIGNED, m->word_size};
}

static mw_source *msh_source(const msh_mesh *m)
{
    return m->values.source;
}

static mw_status msh_integer(msh_mesh *m, const char *what, int64_t *value, mw_error *error)
{
    return mw__value_integer(&m->values, msh_int, what, value, error);
}

static mw_status msh_count(msh_mesh *m, const char *what, int64_t *value, mw_error *error)
{
    mw_number_type type = m->version == 41 ? msh_size(m) : (mw_number_type){MW_NUMBER_UNSIGNED, 8};
    mw_status status = mw__value_integer(&m->values, type, what, value, error);
    if (!status && *value < 0)
        status = mw__source_fail(msh_source(m), error, "the %s is %" PRId64, what, *value);
    return status;
}

static mw_status msh_skip_reals(msh_mesh *m, int64_t count, mw_error *error)
{
    mw_status status = MW_OK;
    double ignored;
    for (int64_t i = 0; !status && i < count; i++)
        status = mw__value_double(&m->values, msh_real, "number", &ignored, error);
    return status;
}

/* The group is left without a name if there is no memory for it. */
static mw_status msh_add_group(msh_groups *groups, msh_group group, mw_error *error)
{
    if (groups->count == groups->room) {
        size_t room = groups->room < 16 ? 16 : groups->room + groups->room / 2;
        msh_group *items = mw__realloc(groups->items, room, sizeof *items);
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

/* --- the header --- */

static mw_status msh_read_format(msh_mesh *m, mw_error *error)
{
    double version;
    int64_t binary, size;
    mw_status status = mw__value_double(&m->values, msh_real, "version", &version, error);
    if (!status) status = mw__value_word_integer(&m->values, "kind of file", &binary, error);
    if (!status) status = mw__value_word_integer(&m->values, "size of numbers", &size, error);
    if (status) return status;
    m->version = version >= 2 && version < 3     ? 22
                 : version >= 4 && version < 4.1 ? 40
                 : version >= 4.1 && version < 5 ? 41
                                                 : 0;
    m->word_size = (size_t)size;
    if (!m->version)
        return mw__source_fail(msh_source(m), error,
                               "version %g of MSH is not read; there are 2.2, 4.0 and 4.1",
                               version);
    if (m->version == 40 && binary)
        return mw__source_fail(msh_source(m), error, "MSH 4.0 as bytes is not read");
    if (size != 8 && !(size == 4 && m->version == 41))
        return mw__source_fail(msh_source(m), error, "numbers of %" PRId64 " bytes are not read",
                               size);
    if (!binary) return MW_OK;
    const unsigned char *bytes;
    msh_source(m)->binary = true;
    status = mw__value_bytes(&m->values, 4, &bytes, error);
    if (status) return status;
    m->values.binary = true;
    m->values.big = bytes[0] == 0;
    return MW_OK;
}

/* --- names and entities --- */

/* dimension number "name" */
static mw_status msh_read_names(msh_mesh *m, mw_error *error)
{
    int64_t count;
    mw_status status = mw__value_word_count(&m->values, "number of names", &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        msh_group group = {0};
        status = mw__value_word_integer(&m->values, "dimension", &group.dimension, error);
        if (!status)
            status = mw__value_word_integer(&m->values, "number of a group", &group.number, error);
        if (status) return status;
        char *name = mw__value_rest(&m->values), *end = strrchr(name, '"');
        name = strchr(name, '"');
        if (!name || name == end)
            return mw__source_fail(msh_source(m), error, "a group has no name in quotes");
        *end = 0;
        group.name = strdup(name + 1);
        if (!group.name) return mw__fail_memory(error);
        status = msh_add_group(&m->names, group, error);
    }
    return status;
}

/* One entity: number, its box, its physical groups, and, except for points, what bounds it. */
static mw_status msh_read_entity(msh_mesh *m, int64_t dimension, mw_error *error)
{
    msh_group entity = {.dimension = dimension};
    int64_t count, ignored;
    mw_status status = msh_integer(m, "number of an entity", &entity.number, error);
    if (!status) status = msh_skip_reals(m, dimension == 0 && m->version == 41 ? 3 : 6, error);
    if (!status) status = msh_count(m, "number of groups", &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        status = msh_integer(m, "physical group", i == 0 ? &entity.physical : &ignored, error);
    }
    if (!status && dimension > 0) {
        status = msh_count(m, "number of bounds", &count, error);
        for (int64_t i = 0; !status && i < count; i++)
            status = msh_integer(m, "bound", &ignored, error);
    }
    return status ? status : msh_add_group(&m->entities, entity, error);
}

static mw_status msh_read_entities(msh_mesh *m, mw_error *error)
{
    int64_t counts[4];
    mw_status status = MW_OK;
    for (int d = 0; !status && d < 4; d++)
        status = msh_count(m, "number of entities", &counts[d], error);
    for (int d = 0; !status && d < 4; d++)
        for (int64_t i = 0; !status && i < counts[d]; i++) status = msh_read_entity(m, d, error);
    return status;
}

static int msh_compare_groups(const void *one, const void *other)
{
    const msh_group *a = one, *b = other;
    if (a->dimension != b->dimension) return a->dimension < b->dimension ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

static const msh_group *msh_find_group(const msh_groups *groups, int64_t dimension, int64_t number)
{
    const msh_group wanted = {.dimension = dimension, .number = number};
    return groups->count
               ? bsearch(&wanted, groups->items, groups->count, sizeof wanted, msh_compare_groups)
               : NULL;
}

static void msh_sort_groups(msh_groups *groups)
{
    if (groups->count)
        qsort(groups->items, groups->count, sizeof *groups->items, msh_compare_groups);
}

/* --- vertices --- */

static mw_status msh_read_vertex(msh_mesh *m, bool numbered, mw_error *error)
{
    double xyz[3];
    int64_t number;
    mw_status status = MW_OK;
    if (numbered) {
        status = msh_integer(m, "number of a vertex", &number, error);
        if (!status) status = mw__integers_add(&m->vertices.numbers, number, error);
    }
    for (int k = 0; !status && k < 3; k++)
        status = mw__value_double(&m->values, msh_real, "coordinate", &xyz[k], error);
    if (status) return status;
    m->builder->file->has_z |= xyz[2] != 0;
    return mw__build_point(m->builder, xyz[0], xyz[1], xyz[2], error);
}

/* Vertices in blocks: in 4.1 the numbers of a block come first, then its coordinates. */
static mw_status msh_read_vertex_block(msh_mesh *m, mw_error *error)
{
    int64_t dimension, ignored, parametric, count, number;
    mw_status status = msh_integer(m, m->version == 41 ? "dimension" : "number of an entity",
                                   m->version == 41 ? &dimension : &ignored, error);
    if (!status) status = msh_integer(m, "entity", m->version == 41 ? &ignored : &dimension, error);
    if (!status) status = msh_integer(m, "kind of vertices", &parametric, error);
    if (!status) status = msh_count(m, "number of vertices", &count, error);
    for (int64_t i = 0; !status && m->version == 41 && i < count; i++) {
        status = msh_count(m, "number of a vertex", &number, error);
        if (!status) status = mw__integers_add(&m->vertices.numbers, number, error);
    }
    for (int64_t i = 0; !status && i < count; i++) {
        status = msh_read_vertex(m, m->version == 40, error);
        if (!status && parametric)
            status = msh_skip_reals(m, dimension > 0 && dimension < 4 ? dimension : 0, error);
    }
    return status;
}

static mw_status msh_read_vertices(msh_mesh *m, mw_error *error)
{
    int64_t blocks = 0, count, ignored;
    mw_status status = MW_OK;
    if (m->have_nodes)
        return mw__source_fail(msh_source(m), error, "the vertices come a second time");
    m->have_nodes = true;
    if (m->version == 22)
        status = mw__value_word_count(&m->values, "number of vertices", &count, error);
    if (!status && m->version != 22) status = msh_count(m, "number of blocks", &blocks, error);
    if (!status && m->version != 22) status = msh_count(m, "number of vertices", &count, error);
    if (!status && m->version == 41) status = msh_count(m, "least number", &ignored, error);
    if (!status && m->version == 41) status = msh_count(m, "largest number", &ignored, error);
    for (int64_t i = 0; !status && m->version == 22 && i < count; i++)
        status = msh_read_vertex(m, true, error);
    for (int64_t i = 0; !status && i < blocks; i++) status = msh_read_vertex_block(m, error);
    return status;
}

/* Sorted numbers lead to ranks, and these to where the vertices stand. */
static mw_status msh_sort_vertices(msh_mesh *m, mw_error *error)
{
    size_t twice;
    mw_status status = mw__ranks_sort(&m->vertices, &twice, error);
    if (!status && twice != SIZE_MAX)
        status =
            mw__source_fail(msh_source(m), error,
                            "vertex %zu of the file has the same number as another one", twice + 1);
    m->builder->points_complete = true;
    return status;
}

static mw_status msh_find_vertex(msh_mesh *m, int64_t number, int64_t *vertex, mw_error *error)
{
    size_t rank = mw__ranks_find(&m->vertices, number);
    if (rank == SIZE_MAX)
        return mw__source_fail(msh_source(m), error, "vertex %" PRId64 " does not exist", number);
    *vertex = (int64_t)mw__ranks_position(&m->vertices, rank) + 1;
    return MW_OK;
}

/* --- elements --- */

enum { MSH_LINE = 1, MSH_TRIANGLE = 2, MSH_QUADRILATERAL = 3, MSH_TYPE_COUNT = 32 };

/* How many vertices an element of a type has; 0: not known. */
static int msh_corners(int64_t type)
{
    static const uint8_t counts[MSH_TYPE_COUNT] = {0,  2,  3,  4,  4, 8, 6,  5,  3,  6, 9,
                                                   10, 27, 18, 14, 1, 8, 20, 15, 13, 9, 10,
                                                   12, 15, 15, 21, 4, 5, 6,  20, 35, 56};
    return type > 0 && type < MSH_TYPE_COUNT ? counts[type] : 0;
}

static bool msh_is_face_of_higher_order(int64_t type)
{
    return type == 9 || type == 10 || type == 16 || (type >= 20 && type <= 25);
}

static mw_status msh_check_type(msh_mesh *m, int64_t type, mw_error *error)
{
    if (msh_corners(type) == 0)
        return mw__source_fail(msh_source(m), error, "elements of type %" PRId64 " are not read",
                               type);
    if (msh_is_face_of_higher_order(type))
        return mw__source_fail(msh_source(m), error,
                               "elements of type %" PRId64
                               " have vertices on their sides; make a mesh of first order",
                               type);
    return MW_OK;
}

/* The corners of one element. */
static mw_status msh_read_element(msh_mesh *m, int64_t type, int64_t physical, mw_error *error)
{
    int corners = msh_corners(type);
    bool face = type == MSH_TRIANGLE || type == MSH_QUADRILATERAL;
    bool edge = type == MSH_LINE && physical != 0;
    mw_number_type number_type = m->version == 41 ? msh_size(m) : msh_int;
    mw_status status = MW_OK;
    if (edge) status = mw__integers_add(&m->edges, physical, error);
    if (face) mw__build_face(m->builder);
    for (int k = 0; !status && k < corners; k++) {
        int64_t number, vertex = 0;
        status = mw__value_integer(&m->values, number_type, "corner", &number, error);
        if (!status && (face || edge)) status = msh_find_vertex(m, number, &vertex, error);
        if (!status && face) status = mw__build_corner(m->builder, vertex, error);
        if (!status && edge) status = mw__integers_add(&m->edges, vertex, error);
    }
    if (!face) {
        if (corners > 3) m->other = type;
        return status;
    }
    if (!status) status = mw__build_face_end(m->builder, error);
    m->grouped |= physical != 0;
    return status ? status : mw__numbers_add(&m->physical, (double)physical, error);
}

/* 2.2: number, type, count of tags, tags, corners; the first tag is the physical group. As bytes
 * elements of one type and count of tags follow one another. */
static mw_status msh_read_elements_22(msh_mesh *m, mw_error *error)
{
    int64_t count, number, type = 0, tags = 0, run = 0, tag;
    mw_status status = mw__value_word_count(&m->values, "number of elements", &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        int64_t physical = 0;
        if (!m->values.binary) status = msh_integer(m, "number of an element", &number, error);
        if (!status && run == 0) {
            status = msh_integer(m, "type of an element", &type, error);
            run = 1;
            if (!status && m->values.binary)
                status = msh_integer(m, "count of elements", &run, error);
            if (!status) status = msh_integer(m, "count of tags", &tags, error);
            if (!status) status = msh_check_type(m, type, error);
            if (!status && (run <= 0 || tags < 0))
                status = mw__source_fail(msh_source(m), error, "a count that is negative or 0");
        }
        run--;
        if (!status && m->values.binary)
            status = msh_integer(m, "number of an element", &number, error);
        for (int64_t k = 0; !status && k < tags; k++)
            status = msh_integer(m, "tag", k == 0 ? &physical : &tag, error);
        if (!status) status = msh_read_element(m, type, physical, error);
    }
    return status;
}

/* 4.x: blocks of elements of one entity and one type. */
static mw_status msh_read_element_block(msh_mesh *m, mw_error *error)
{
    int64_t dimension, entity, type, count, number;
    bool new = m->version == 41;
    mw_status status = msh_integer(m, "entity", new ? &dimension : &entity, error);
    if (!status) status = msh_integer(m, "entity", new ? &entity : &dimension, error);
    if (!status) status = msh_integer(m, "type of elements", &type, error);
    if (!status) status = msh_count(m, "count of elements", &count, error);
    if (!status) status = msh_check_type(m, type, error);
    if (status) return status;
    const msh_group *group = msh_find_group(&m->entities, dimension, entity);
    for (int64_t i = 0; !status && i < count; i++) {
        status = new ? msh_count(m, "number of an element", &number, error)
                     : msh_integer(m, "number of an element", &number, error);
        if (!status) status = msh_read_element(m, type, group ? group->physical : 0, error);
    }
    return status;
}

static mw_status msh_read_elements(msh_mesh *m, mw_error *error)
{
    int64_t blocks, ignored;
    if (!m->have_nodes || m->have_elements)
        return mw__source_fail(msh_source(m), error,
                               m->have_nodes ? "the elements come a second time"
                                             : "elements before the vertices");
    m->have_elements = true;
    msh_sort_groups(&m->entities);
    mw_status status = msh_sort_vertices(m, error);
    if (status) return status;
    if (m->version == 22) return msh_read_elements_22(m, error);
    status = msh_count(m, "number of blocks", &blocks, error);
    for (int i = 0; !status && i < (m->version == 41 ? 3 : 1); i++)
        status = msh_count(m, "number of elements", &ignored, error);
    for (int64_t i = 0; !status && i < blocks; i++) status = msh_read_element_block(m, error);
    return status;
}

/* --- all of it --- */

static mw_status msh_skip_lines(msh_mesh *m, const char *end, mw_error *error)
{
    char *line;
    mw_status status;
    do status = mw__value_line(&m->values, &line, error);
    while (!status && line && strncmp(mw__skip_blanks(line), end, strlen(end)) != 0);
    if (!status && !line)
        status = mw__source_fail(msh_source(m), error, "the file ends before %s", end);
    return status;
}

/* Pass over a section, whatever is in it: as bytes it may hold line ends and NULs, which no line
 * has, so its end is looked for byte by byte. */
static mw_status msh_skip_section(msh_mesh *m, const char *name, mw_error *error)
{
    char end[80];
    size_t matched = 0;
    const unsigned char *byte;
    mw_status status = MW_OK;
    snprintf(end, sizeof end, "$End%s", name + 1);
    m->values.rest = NULL;
    if (!m->values.binary) return msh_skip_lines(m, end, error);
    while (!status && end[matched]) {
        status = mw__value_bytes(&m->values, 1, &byte, error);
        if (!status) matched = *byte == (unsigned char)end[matched] ? matched + 1 : *byte == '$';
    }
    return status;
}

/* The word that ends a section. */
static mw_status msh_end_section(msh_mesh *m, const char *name, mw_error *error)
{
    char *word;
    mw_status status = mw__value_word(&m->values, &word, error);
    if (status) return status;
    if (!word || strncmp(word, "$End", 4) != 0 || strcmp(word + 4, name + 1) != 0)
        return mw__source_fail(msh_source(m), error, "expected $End%s", name + 1);
    return MW_OK;
}

static mw_status msh_read_section(msh_mesh *m, const char *word, mw_error *error)
{
    static const struct {
        const char *name;
        mw_status (*read)(msh_mesh *m, mw_error *error);
    } sections[] = {{"$MeshFormat", msh_read_format},
                    {"$PhysicalNames", msh_read_names},
                    {"$Entities", msh_read_entities},
                    {"$Nodes", msh_read_vertices},
                    {"$Elements", msh_read_elements}};
    char name[64];
    if (*word != '$' || strlen(word) >= sizeof name)
        return mw__source_fail(msh_source(m), error, "expected a section ('$...'), found '%s'",
                               mw__excerpt(word).text);
    strcpy(name, word);
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
        if (strcmp(name, sections[i].name) != 0) continue;
        if ((i == 0) != (m->version == 0))
            return mw__source_fail(msh_source(m), error,
                                   i == 0 ? "a second $MeshFormat" : "no $MeshFormat before this");
        mw_status status = sections[i].read(m, error);
        return status ? status : msh_end_section(m, name, error);
    }
    return msh_skip_section(m, name, error);
}

/* Edges of lines that have a physical group; it is called by its name, else by its number. */
static mw_status msh_build_edges(msh_mesh *m, mw_error *error)
{
    mw_status status = MW_OK;
    int64_t marked = 0;
    msh_sort_groups(&m->names);
    for (size_t i = 0; !status && i < m->edges.count; i += 3) {
        const int64_t *edge = m->edges.values + i;
        if (edge[0] != marked) {
            char number[32];
            const msh_group *group = msh_find_group(&m->names, 1, edge[0]);
            snprintf(number, sizeof number, "%" PRId64, edge[0]);
            status = mw__build_mark(m->builder, group ? group->name : number, error);
            marked = edge[0];
        }
        if (!status) status = mw__build_edge(m->builder, edge[1], edge[2], error);
    }
    return status;
}

static mw_status msh_read_sections(msh_mesh *m, mw_error *error)
{
    char *word;
    mw_status status;
    m->builder->first_number = 1;
    while (!(status = mw__value_word(&m->values, &word, error)) && word) {
        status = msh_read_section(m, word, error);
        if (status) return status;
    }
    if (status) return status;
    if (!m->have_nodes)
        return mw__source_fail(msh_source(m), error, "no vertices ($Nodes) in this file");
    if (m->builder->file->face_count == 0 && m->other)
        return mw__source_fail(msh_source(m), error,
                               "no triangles nor quadrilaterals, but elements of type %" PRId64,
                               m->other);
    if (m->grouped)
        status = mw__build_face_field(m->builder, "physical", m->physical.values, error);
    return status ? status : msh_build_edges(m, error);
}

static void msh_release_groups(msh_groups *groups)
{
    for (size_t i = 0; i < groups->count; i++) free(groups->items[i].name);
    free(groups->items);
}

mw_status mw__read_msh(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    msh_mesh m = {.values = {.source = source}, .builder = builder};
    mw_status status = msh_read_sections(&m, error);
    mw__ranks_release(&m.vertices);
    msh_release_groups(&m.names);
    msh_release_groups(&m.entities);
    free(m.physical.values);
    free(m.edges.values);
    return status;
}
