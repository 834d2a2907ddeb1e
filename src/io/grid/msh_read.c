/* MSH of Gmsh, versions 2.2, 4.0 and 4.1, as text and as bytes. Read are the vertices, and the
 * triangles and quadrilaterals; their physical group becomes the triangle field "physical" (0:
 * none), and lines of named physical groups mark edges. Values of vertices and elements become
 * fields. Points and volumes are passed over; elements of higher order are refused. Numbers may
 * have gaps: vertices are counted as they come, faces too. */
#include "io/grid/grid_readers.h"
#include "io/grid/msh_data.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct msh_mesh {
    mw_msh_source in;
    mw_mesh_builder *builder;
    mw_rank_list vertices;
    mw_rank_list faces;      /* their numbers among all elements */
    mw_number_list physical; /* of each face */
    mw_integer_list edges;   /* three numbers each: physical group, two vertices */
    bool grouped, have_nodes, have_elements, faces_sorted;
    int64_t other; /* a type of element that was passed over; 0: none */
} msh_mesh;

static mw_source *msh_source(const msh_mesh *m)
{
    return m->in.values.source;
}

/* --- the header --- */

static mw_status msh_read_format(msh_mesh *m, mw_error *error)
{
    double version;
    int64_t binary, size;
    mw_status status = mw__msh_real(&m->in, "version", &version, error);
    if (!status) status = mw__value_word_integer(&m->in.values, "kind of file", &binary, error);
    if (!status) status = mw__value_word_integer(&m->in.values, "size of numbers", &size, error);
    if (status) return status;
    m->in.version = version >= 2 && version < 3     ? 22
                    : version >= 4 && version < 4.1 ? 40
                    : version >= 4.1 && version < 5 ? 41
                                                    : 0;
    m->in.word_size = (size_t)size;
    if (!m->in.version)
        return mw__source_fail(msh_source(m), error,
                               "MSH version %g is not read, only 2.2, 4.0 and 4.1", version);
    if (m->in.version == 40 && binary)
        return mw__source_fail(msh_source(m), error,
                               "binary MSH 4.0 is not read; save it as text, or as 4.1");
    if (size != 8 && !(size == 4 && m->in.version == 41))
        return mw__source_fail(
            msh_source(m), error,
            "numbers of %" PRId64 " bytes are not read, only of 8 (in MSH 4.1 also of 4)", size);
    if (!binary) return MW_OK;
    const unsigned char *bytes;
    msh_source(m)->binary = true;
    status = mw__value_bytes(&m->in.values, 4, &bytes, error);
    if (status) return status;
    m->in.values.binary = true;
    m->in.values.big = bytes[0] == 0;
    return MW_OK;
}

/* --- vertices --- */

static mw_status msh_read_vertex(msh_mesh *m, bool numbered, mw_error *error)
{
    double xyz[3];
    int64_t number;
    mw_status status = MW_OK;
    if (numbered) {
        status = mw__msh_integer(&m->in, "number of a vertex", &number, error);
        if (!status) status = mw__integers_add(&m->vertices.numbers, number, error);
    }
    for (int k = 0; !status && k < 3; k++)
        status = mw__msh_real(&m->in, "coordinate", &xyz[k], error);
    if (status) return status;
    m->builder->file->has_z |= xyz[2] != 0;
    return mw__build_point(m->builder, xyz[0], xyz[1], xyz[2], error);
}

/* Vertices in blocks: in 4.1 the numbers of a block come first, then its coordinates. */
static mw_status msh_read_vertex_block(msh_mesh *m, mw_error *error)
{
    int64_t dimension, ignored, parametric, count, number;
    mw_status status =
        mw__msh_integer(&m->in, m->in.version == 41 ? "dimension" : "number of an entity",
                        m->in.version == 41 ? &dimension : &ignored, error);
    if (!status)
        status =
            mw__msh_integer(&m->in, "entity", m->in.version == 41 ? &ignored : &dimension, error);
    if (!status) status = mw__msh_integer(&m->in, "kind of vertices", &parametric, error);
    if (!status) status = mw__msh_count(&m->in, "number of vertices", &count, error);
    for (int64_t i = 0; !status && m->in.version == 41 && i < count; i++) {
        status = mw__msh_count(&m->in, "number of a vertex", &number, error);
        if (!status) status = mw__integers_add(&m->vertices.numbers, number, error);
    }
    for (int64_t i = 0; !status && i < count; i++) {
        status = msh_read_vertex(m, m->in.version == 40, error);
        if (!status && parametric)
            status =
                mw__msh_skip_reals(&m->in, dimension > 0 && dimension < 4 ? dimension : 0, error);
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
    if (m->in.version == 22)
        status = mw__value_word_count(&m->in.values, "number of vertices", &count, error);
    if (!status && m->in.version != 22)
        status = mw__msh_count(&m->in, "number of blocks", &blocks, error);
    if (!status && m->in.version != 22)
        status = mw__msh_count(&m->in, "number of vertices", &count, error);
    if (!status && m->in.version == 41)
        status = mw__msh_count(&m->in, "least number", &ignored, error);
    if (!status && m->in.version == 41)
        status = mw__msh_count(&m->in, "largest number", &ignored, error);
    for (int64_t i = 0; !status && m->in.version == 22 && i < count; i++)
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
static mw_status msh_read_element(msh_mesh *m, int64_t number, int64_t type, int64_t physical,
                                  mw_error *error)
{
    int corners = msh_corners(type);
    bool face = type == MSH_TRIANGLE || type == MSH_QUADRILATERAL;
    bool edge = type == MSH_LINE && physical != 0;
    mw_number_type number_type =
        m->in.version == 41 ? mw__msh_size(&m->in) : (mw_number_type){MW_NUMBER_SIGNED, 4};
    mw_status status = MW_OK;
    if (edge) status = mw__integers_add(&m->edges, physical, error);
    if (face) mw__build_face(m->builder);
    for (int k = 0; !status && k < corners; k++) {
        int64_t corner, vertex = 0;
        status = mw__value_integer(&m->in.values, number_type, "corner", &corner, error);
        if (!status && (face || edge)) status = msh_find_vertex(m, corner, &vertex, error);
        if (!status && face) status = mw__build_corner(m->builder, vertex, error);
        if (!status && edge) status = mw__integers_add(&m->edges, vertex, error);
    }
    if (!face) {
        if (corners > 3) m->other = type;
        return status;
    }
    if (!status) status = mw__build_face_end(m->builder, error);
    if (!status) status = mw__integers_add(&m->faces.numbers, number, error);
    m->grouped |= physical != 0;
    return status ? status : mw__numbers_add(&m->physical, (double)physical, error);
}

/* 2.2: number, type, count of tags, tags, corners; the first tag is the physical group. As bytes
 * elements of one type and count of tags follow one another. */
static mw_status msh_read_elements_22(msh_mesh *m, mw_error *error)
{
    int64_t count, number = 0, type = 0, tags = 0, run = 0, tag;
    mw_status status = mw__value_word_count(&m->in.values, "number of elements", &count, error);
    for (int64_t i = 0; !status && i < count; i++) {
        int64_t physical = 0;
        if (!m->in.values.binary)
            status = mw__msh_integer(&m->in, "number of an element", &number, error);
        if (!status && run == 0) {
            status = mw__msh_integer(&m->in, "type of an element", &type, error);
            run = 1;
            if (!status && m->in.values.binary)
                status = mw__msh_integer(&m->in, "count of elements", &run, error);
            if (!status) status = mw__msh_integer(&m->in, "count of tags", &tags, error);
            if (!status) status = msh_check_type(m, type, error);
            if (!status && (run <= 0 || tags < 0))
                status = mw__source_fail(msh_source(m), error, "a count is negative or 0");
        }
        run--;
        if (!status && m->in.values.binary)
            status = mw__msh_integer(&m->in, "number of an element", &number, error);
        for (int64_t k = 0; !status && k < tags; k++)
            status = mw__msh_integer(&m->in, "tag", k == 0 ? &physical : &tag, error);
        if (!status) status = msh_read_element(m, number, type, physical, error);
    }
    return status;
}

/* 4.x: blocks of elements of one entity and one type. */
static mw_status msh_read_element_block(msh_mesh *m, mw_error *error)
{
    int64_t dimension, entity, type, count, number = 0;
    bool new = m->in.version == 41;
    mw_status status = mw__msh_integer(&m->in, "entity", new ? &dimension : &entity, error);
    if (!status) status = mw__msh_integer(&m->in, "entity", new ? &entity : &dimension, error);
    if (!status) status = mw__msh_integer(&m->in, "type of elements", &type, error);
    if (!status) status = mw__msh_count(&m->in, "count of elements", &count, error);
    if (!status) status = msh_check_type(m, type, error);
    if (status) return status;
    const mw_msh_group *group = mw__msh_find_group(&m->in.entities, dimension, entity);
    for (int64_t i = 0; !status && i < count; i++) {
        status = new ? mw__msh_count(&m->in, "number of an element", &number, error)
                     : mw__msh_integer(&m->in, "number of an element", &number, error);
        if (!status) status = msh_read_element(m, number, type, group ? group->physical : 0, error);
    }
    return status;
}

static mw_status msh_read_element_blocks(msh_mesh *m, mw_error *error)
{
    int64_t blocks, ignored;
    mw_status status = mw__msh_count(&m->in, "number of blocks", &blocks, error);
    for (int i = 0; !status && i < (m->in.version == 41 ? 3 : 1); i++)
        status = mw__msh_count(&m->in, "number of elements", &ignored, error);
    for (int64_t i = 0; !status && i < blocks; i++) status = msh_read_element_block(m, error);
    return status;
}

static mw_status msh_read_elements(msh_mesh *m, mw_error *error)
{
    if (!m->have_nodes || m->have_elements)
        return mw__source_fail(msh_source(m), error,
                               m->have_nodes ? "the elements come a second time"
                                             : "the elements stand before the vertices");
    m->have_elements = true;
    mw__msh_sort_groups(&m->in.entities);
    mw_status status = msh_sort_vertices(m, error);
    if (!status)
        status = m->in.version == 22 ? msh_read_elements_22(m, error)
                                     : msh_read_element_blocks(m, error);
    if (!status && m->grouped)
        status = mw__build_face_field(m->builder, "physical", m->physical.values, error);
    return status;
}

/* --- values --- */

static mw_status msh_vertex_data(msh_mesh *m, mw_error *error)
{
    return mw__msh_read_data(&m->in, m->builder, &m->vertices, false, error);
}

static mw_status msh_face_data(msh_mesh *m, mw_error *error)
{
    size_t twice = SIZE_MAX;
    mw_status status = m->faces_sorted ? MW_OK : mw__ranks_sort(&m->faces, &twice, error);
    m->faces_sorted = true;
    if (!status && twice != SIZE_MAX)
        status =
            mw__source_fail(msh_source(m), error,
                            "face %zu of the file has the same number as another one", twice + 1);
    return status ? status : mw__msh_read_data(&m->in, m->builder, &m->faces, true, error);
}

/* --- all of it --- */

static mw_status msh_skip_lines(msh_mesh *m, const char *end, mw_error *error)
{
    char *line;
    mw_status status;
    do status = mw__value_line(&m->in.values, &line, error);
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
    m->in.values.rest = NULL;
    if (!m->in.values.binary) return msh_skip_lines(m, end, error);
    while (!status && end[matched]) {
        status = mw__value_bytes(&m->in.values, 1, &byte, error);
        if (!status) matched = *byte == (unsigned char)end[matched] ? matched + 1 : *byte == '$';
    }
    return status;
}

/* The word that ends a section. */
static mw_status msh_end_section(msh_mesh *m, const char *name, mw_error *error)
{
    char *word;
    mw_status status = mw__value_word(&m->in.values, &word, error);
    if (status) return status;
    if (!word || strncmp(word, "$End", 4) != 0 || strcmp(word + 4, name + 1) != 0)
        return mw__source_fail(msh_source(m), error, "expected $End%s", name + 1);
    return MW_OK;
}

static mw_status msh_read_names(msh_mesh *m, mw_error *error)
{
    return mw__msh_read_names(&m->in, error);
}

static mw_status msh_read_entities(msh_mesh *m, mw_error *error)
{
    return mw__msh_read_entities(&m->in, error);
}

static mw_status msh_read_partitions(msh_mesh *m, mw_error *error)
{
    return mw__msh_read_partitions(&m->in, error);
}

typedef struct msh_section {
    const char *name;
    mw_status (*read)(msh_mesh *m, mw_error *error);
    bool of_41;    /* other versions have it in another form: it is passed over */
    bool of_faces; /* it is passed over where no elements came before it */
} msh_section;

/* The section of that name; NULL: it is passed over. */
static const msh_section *msh_find_section(const msh_mesh *m, const char *name)
{
    static const msh_section sections[] = {
        {.name = "$MeshFormat", .read = msh_read_format},
        {.name = "$PhysicalNames", .read = msh_read_names},
        {.name = "$Entities", .read = msh_read_entities},
        {.name = "$PartitionedEntities", .read = msh_read_partitions, .of_41 = true},
        {.name = "$Nodes", .read = msh_read_vertices},
        {.name = "$Elements", .read = msh_read_elements},
        {.name = "$NodeData", .read = msh_vertex_data, .of_faces = true},
        {.name = "$ElementData", .read = msh_face_data, .of_faces = true}};
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
        const msh_section *section = &sections[i];
        if (strcmp(name, section->name) != 0) continue;
        bool fits =
            (!section->of_41 || m->in.version == 41) && (!section->of_faces || m->have_elements);
        return fits ? section : NULL;
    }
    return NULL;
}

static mw_status msh_read_section(msh_mesh *m, const char *word, mw_error *error)
{
    char name[64];
    if (*word != '$' || strlen(word) >= sizeof name)
        return mw__source_fail(msh_source(m), error, "expected a section ('$...'), found '%s'",
                               mw__excerpt(word).text);
    strcpy(name, word);
    const msh_section *section = msh_find_section(m, name);
    if (!section) return msh_skip_section(m, name, error);
    bool format = section->read == msh_read_format;
    if (format != (m->in.version == 0))
        return mw__source_fail(msh_source(m), error,
                               format ? "there is a second $MeshFormat"
                                      : "there is no $MeshFormat before this section");
    mw_status status = section->read(m, error);
    return status ? status : msh_end_section(m, name, error);
}

/* Edges of lines that have a physical group; it is called by its name, else by its number. */
static mw_status msh_build_edges(msh_mesh *m, mw_error *error)
{
    mw_status status = MW_OK;
    int64_t marked = 0;
    mw__msh_sort_groups(&m->in.names);
    for (size_t i = 0; !status && i < m->edges.count; i += 3) {
        const int64_t *edge = m->edges.values + i;
        if (edge[0] != marked) {
            char number[32];
            const mw_msh_group *group = mw__msh_find_group(&m->in.names, 1, edge[0]);
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
    while (!(status = mw__value_word(&m->in.values, &word, error)) && word) {
        status = msh_read_section(m, word, error);
        if (status) return status;
    }
    if (status) return status;
    if (!m->have_nodes)
        return mw__source_fail(msh_source(m), error, "there are no vertices ($Nodes) in this file");
    if (m->builder->file->face_count == 0 && m->other)
        return mw__source_fail(
            msh_source(m), error,
            "the file has no triangles or quadrilaterals, only elements of type %" PRId64,
            m->other);
    return msh_build_edges(m, error);
}

mw_status mw__read_msh(mw_source *source, mw_mesh_builder *builder, mw_error *error)
{
    msh_mesh m = {.in = {.values = {.source = source}}, .builder = builder};
    mw_status status = msh_read_sections(&m, error);
    mw__ranks_release(&m.vertices);
    mw__ranks_release(&m.faces);
    mw__msh_release(&m.in);
    free(m.physical.values);
    free(m.edges.values);
    return status;
}
