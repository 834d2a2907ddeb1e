/* test_io_grid.c - readers of the meshes of simulations: what they take, and that no file that is
 * cut short or altered does harm. */
#define _GNU_SOURCE /* memmem */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/grid_bytes.h"
#include "base/random.h"
#include "io/grid/grid_readers.h"
#include "io/grid/value_source.h"
#include "support/environment.h"
#include "support/write_mesh_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the mesh of grid_bytes.h has to be. */
typedef struct grid_wanted {
    int first_number;
    double shift[2];
    bool q, physical; /* fields */
    bool triangles;   /* the quadrilateral came as two faces */
} grid_wanted;

static void expect_grid(const char *name, bytes contents, const grid_wanted *w)
{
    static const double xy[] = {0, 0, 2, 0, 2, 2, 0, 2, 4, 0};
    static const uint32_t corners[] = {0, 1, 2, 0, 2, 3, 1, 4, 2}, faces[] = {0, 0, 1};
    mw_mesh_file file = mesh_file_read_bytes(name, contents);
    mesh_file_expect_triangles(&file, 5, 3, corners);
    for (size_t i = 0; i < 10; i++)
        assert_true(file.points[3 * (i / 2) + i % 2] == xy[i] + w->shift[i % 2]);
    assert_int_equal(file.face_count, w->triangles ? 3 : 2);
    for (size_t t = 0; t < 3 && !w->triangles; t++) assert_int_equal(file.faces[t], faces[t]);
    assert_int_equal(file.first_number, w->first_number);
    assert_int_equal(file.field_count, w->q ? 1 : 0);
    if (w->q) assert_string_equal(file.field_names[0], "q");
    for (size_t v = 0; v < 5 && w->q; v++) assert_true(file.fields[0][v] == 10.0 * (double)v);
    assert_int_equal(file.triangle_field_count, w->physical ? 1 : 0);
    if (w->physical) {
        assert_string_equal(file.triangle_field_names[0], "physical");
        assert_true(file.triangle_fields[0][0] == 7 && file.triangle_fields[0][1] == 7 &&
                    file.triangle_fields[0][2] == 0);
    }
    mw_mesh_file_release(&file);
}

static void expect_grid_bytes(const char *name, grid_bytes g, const grid_wanted *w)
{
    expect_grid(name, (bytes){g.bytes, g.size}, w);
    grid_release(&g);
}

#define FORT14_XY "1 0 0 0\n2 2 0 10\n3 2 2 20\n4 0 2 30\n5 4 0 4D1\n"
static const char fort14_text[] =
    "a title\n2 5 ! elements, vertices\n" FORT14_XY "1 4 1 2 3 4\n2 3 2 5 3\n"
    "1 = open\n2\n2 ! boundary 1\n4\n1\n"
    "1 = land\n3\n3 24 ! a barrier\n1 2 0.5\n2 3 0.5\n5 4 0.5\n";

static void test_fort14(void **state)
{
    (void)state;
    static const char *const names[] = {"fort.14", "a.14", "a.grd", "hgrid.gr3", "hgrid.ll"};
    for (size_t i = 0; i < 5; i++) {
        mw_mesh_file file = mesh_file_read_text(names[i], fort14_text);
        assert_int_equal(file.triangle_count, 3);
        assert_int_equal(file.first_number, 1);
        assert_string_equal(file.field_names[0], "depth");
        assert_true(file.fields[0][4] == 40 && !file.has_z);
        assert_int_equal(file.mark_count, 2);
        assert_string_equal(file.mark_names[0], "open 1");
        assert_string_equal(file.mark_names[1], "land 1 type 24");
        assert_int_equal(file.edge_count, 5); /* both sides of the barrier */
        static const uint32_t edges[][3] = {{3, 0, 0}, {0, 1, 1}, {1, 2, 1}, {1, 4, 1}, {2, 3, 1}};
        for (size_t e = 0; e < 5; e++) {
            assert_int_equal(file.edges[e].vertex[0], edges[e][0]);
            assert_int_equal(file.edges[e].vertex[1], edges[e][1]);
            assert_int_equal(file.edges[e].mark, edges[e][2]);
        }
        if (i == 4)
            assert_string_equal(file.crs, "EPSG:4326");
        else
            assert_null(file.crs);
        mw_mesh_file_release(&file);
    }
    /* neither boundaries nor their types need be there */
    mw_mesh_file file =
        mesh_file_read_text("a.gr3", "\n1 3\n1 0 0 -5\n2 1 0 1\n3 0 1 1\n1 3 1 2 3\n"
                                     "0\n0\n1\n2\n2 = land boundary 1\n1\n2\n");
    assert_true(file.fields[0][0] == -5);
    assert_string_equal(file.mark_names[0], "land 1 type 0");
    mw_mesh_file_release(&file);
    file = mesh_file_read_text("a.gr3", "\n1 3\n1 0 0 -5\n2 1 0 1\n3 0 1 1\n1 3 1 2 3\n");
    assert_int_equal(file.mark_count, 0);
    mw_mesh_file_release(&file);
}

/* The first words of other formats are titles as good as any. */
static void test_fort14_titles(void **state)
{
    (void)state;
    static const char *const titles[] = {"g", "v 1.2 of the grid", "OFF the coast", "solid earth",
                                         "MESH2D"};
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++) {
        char text[200];
        snprintf(text, sizeof text, "%s\n1 3\n1 0 0 1\n2 1 0 1\n3 0 1 1\n1 3 1 2 3\n", titles[i]);
        mw_mesh_file file = mesh_file_read_text(i % 2 ? "fort.14" : "hgrid.gr3", text);
        assert_int_equal(file.triangle_count, 1);
        assert_string_equal(file.field_names[0], "depth");
        mw_mesh_file_release(&file);
    }
}

/* Numbers as Fortran writes and reads them: exponents without a letter, commas. */
static void test_fort14_numbers(void **state)
{
    (void)state;
    mw_mesh_file file = mesh_file_read_text(
        "fort.14", "a, b\r\n1 , 3\r\n1,0D0,0,-1.5-105\r\n2, 1.E0 ,0,25.+101\r\n\r\n3 0 1,+2\r\n"
                   "1,3,1,2,3\r\n1,\r\n2\r\n2 0 ! no type here, 24\r\n1,\r\n2,\r\n0\r\n");
    assert_true(file.fields[0][0] == -1.5e-105 && file.fields[0][1] == 25e101);
    assert_true(file.points[3] == 1 && file.fields[0][2] == 2);
    assert_int_equal(file.edge_count, 1);
    mw_mesh_file_release(&file);
    mw_error error;
    files_write_text("fort.14", "a\n1 3\n1 0 0 1.5-05\n");
    assert_int_equal(mw_read_mesh("fort.14", NULL, &file, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, 3, "depth: '1.5-05' is not a number");
}

static const char sms_text[] =
    "MESH2D # SMS\nMESHNAME \"a\"\nNUM_MATERIALS_PER_ELEM 1\n"
    "E3T 9 20 50 30 0\nE4Q 2 10 20 30 40 7\nE2L 11 10 20 1\n"
    "ND 50 4 0 1\nND 10 0 0 0\nND 20 2 0 0\nND 30 2 2 0\nND 40 0 2 0\nNS 10 -20\nBEGPARAMDEF\n";

/* Vertices and faces are counted in the order of their numbers. */
static void test_2dm(void **state)
{
    (void)state;
    mw_mesh_file file = mesh_file_read_text("a.2dm", sms_text);
    static const uint32_t corners[] = {0, 1, 2, 0, 2, 3, 1, 4, 2};
    mesh_file_expect_triangles(&file, 5, 3, corners);
    assert_true(file.has_z && file.points[12] == 4 && file.points[14] == 1);
    assert_true(file.faces[0] == 0 && file.faces[1] == 0 && file.faces[2] == 1);
    assert_string_equal(file.triangle_field_names[0], "material");
    assert_true(file.triangle_fields[0][1] == 7 && file.triangle_fields[0][2] == 0);
    mw_mesh_file_release(&file);
    file =
        mesh_file_read_text("a.txt", "MESH2D\nND 1 0 0 0\nND 2 1 0 0\nND 3 0 1 0\nE3T 1 1 2 3\n");
    assert_int_equal(file.triangle_field_count, 0);
    mw_mesh_file_release(&file);
    /* some programs keep heights of elements there */
    file = mesh_file_read_text("a.2dm", "MESH2D\nND 1 0 0 0\nND 2 1 0 0\nND 3 0 1 0\nND 4 1 1 0\n"
                                        "E3T 2 2 4 3\nE3T 1 1 2 3 -1.25 7\n");
    assert_true(file.triangle_fields[0][0] == -1.25 && file.triangle_fields[0][1] == 0);
    mw_mesh_file_release(&file);
}

static const char su2_text[] =
    "% made by hand\nNDIME= 2\nNELEM= 2\n9 0 1 2 3 0\n5\t1 4 2 1\n% vertices\nNPOIN= 5 5\n"
    "0 0 0\n2 0 1\n2 2 2\n0 2 3\n4 0 4\nNMARK= 2\nMARKER_TAG= wall\nMARKER_ELEMS= 2\n3 0 1\n3 1 4\n"
    "MARKER_TAG= far\nMARKER_ELEMS= 1\n3 4 2 % last\n"
    "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 2\nSEND_RECV= -1\n1 0 0\n1 3 0\n";

static void test_su2(void **state)
{
    (void)state;
    expect_grid("a.su2", BYTES(su2_text), &(grid_wanted){0});
    expect_grid("a.any", BYTES(su2_text), &(grid_wanted){0}); /* a comment comes first */
    mw_mesh_file file = mesh_file_read_text("a.su2", su2_text);
    assert_int_equal(file.edge_count, 3);
    assert_string_equal(file.mark_names[file.edges[2].mark], "far");
    assert_true(file.edges[2].vertex[0] == 4 && file.edges[2].vertex[1] == 2);
    mw_mesh_file_release(&file);
}

#define MSH_NODES "$Nodes\n5\n50 4 0 0\n10 0 0 0\n20 2 0 0\n30 2 2 0\n40 0 2 0\n$EndNodes\n"
#define MSH_22                                                                                     \
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 3 \"the shore\"\n"                 \
    "$EndPhysicalNames\n$Nodes\n5\n10 0 0 0\n20 2 0 0\n30 2 2 0\n40 0 2 0\n50 4 0 0\n$EndNodes\n"  \
    "$Elements\n4\n1 15 2 0 1 10\n2 1 2 3 1 10 20\n3 3 2 7 1 10 20 30 40\n4 2 0 20 50 30\n"        \
    "$EndElements\n"
static const char msh_22_text[] = MSH_22;
static const char msh_41_text[] =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 1 2 0\n1 0 0 0 0\n"
    "1 0 0 0 1 1 1 1 3 2 1 1\n1 0 0 0 1 1 1 1 7 1 1\n2 0 0 0 1 1 1 0 1 1\n$EndEntities\n"
    "$Nodes\n2 5 10 50\n0 1 0 1\n10\n0 0 0\n2 1 1 4\n20\n30\n40\n50\n2 0 0 .1 .2\n2 2 0 .1 .2\n"
    "0 2 0 0 0\n4 0 0 1 1\n$EndNodes\n$Elements\n3 3 1 3\n1 1 1 1\n1 10 20\n2 1 3 1\n"
    "2 10 20 30 40\n2 2 2 1\n3 20 50 30\n$EndElements\n";
static const char msh_40_text[] =
    "$MeshFormat\n4 0 8\n$EndMeshFormat\n$Entities\n1 0 2 0\n1 0 0 0 0 0 0 0\n"
    "1 0 0 0 1 1 1 1 7 1 1\n2 0 0 0 1 1 1 0 1 1\n$EndEntities\n$Nodes\n1 5\n1 2 0 5\n10 0 0 0\n"
    "20 2 0 0\n30 2 2 0\n40 0 2 0\n50 4 0 0\n$EndNodes\n$Elements\n2 2\n1 2 3 1\n2 10 20 30 40\n"
    "2 2 2 1\n3 20 50 30\n$EndElements\n";

static void test_msh(void **state)
{
    (void)state;
    static const grid_wanted wanted = {.first_number = 1, .physical = true};
    expect_grid("a.msh", BYTES(msh_22_text), &wanted);
    expect_grid("a.msh", BYTES(msh_41_text), &wanted);
    expect_grid("a.msh", BYTES(msh_40_text), &wanted);
    for (int big = 0; big < 2; big++) {
        expect_grid_bytes("a.msh", grid_msh(22, big), &wanted);
        expect_grid_bytes("a.dat", grid_msh(41, big), &wanted);
    }
    mw_mesh_file file = mesh_file_read_text("a.msh", msh_22_text);
    assert_int_equal(file.edge_count, 1);
    assert_string_equal(file.mark_names[0], "the shore");
    assert_true(file.edges[0].vertex[0] == 0 && file.edges[0].vertex[1] == 1);
    mw_mesh_file_release(&file);
}

static const char msh_data_text[] = MSH_22
    "$NodeData\n2\n\"water \\ level\"\n\"more\"\n1\n0.5\n3\n0\n1\n2\n50 1.5\n10 -2\n$EndNodeData\n"
    "$NodeData\n1\n\"water \\ level\"\n1\n1.5\n3\n1\n1\n1\n50 9\n$EndNodeData\n"
    "$ElementNodeData\n1\n\"other\"\n$EndElementNodeData\n"
    "$ElementData\n1\nv\n0\n4\n0\n3\n2\n0\n2 7 8 9\n4 1 2 3\n$EndElementData\n";

/* Values of vertices and elements by their numbers, of the first time. */
static void test_msh_data(void **state)
{
    (void)state;
    char text[sizeof msh_data_text];
    mw_mesh_file file = mesh_file_read_text("a.msh", msh_data_text);
    assert_int_equal(file.field_count, 1);
    assert_string_equal(file.field_names[0], "water \\ level");
    assert_true(file.fields[0][4] == 1.5 && file.fields[0][0] == -2 && isnan(file.fields[0][1]));
    assert_int_equal(file.triangle_field_count, 4);
    assert_string_equal(file.triangle_field_names[0], "physical");
    assert_string_equal(file.triangle_field_names[3], "v_2");
    assert_true(isnan(file.triangle_fields[3][0]) && isnan(file.triangle_fields[3][1]));
    assert_true(file.triangle_fields[1][2] == 1 && file.triangle_fields[3][2] == 3);
    mw_mesh_file_release(&file);
    static const struct {
        const char *data, *says;
        int64_t line;
    } bad[] = {{"$NodeData\n1\n\"q\"\n0\n3\n0\n1\n1\n7 1\n$EndNodeData\n", "vertex 7 does not", 31},
               {"$NodeData\n0\n0\n0\n", "the values have no name", 24},
               {"$ElementData\n1\n\"q\"\n0\n3\n0\n10\n1\n", "'q' announces 1 times 10 values", 30},
               {"$ElementData\n1\n\"q\"\n0\n3\n0\n1\n1\n3 x\n", "value: 'x' is not a number", 31}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        mw_error error;
        snprintf(text, sizeof text, "%s%s", msh_22_text, bad[i].data);
        files_write_text("a.msh", text);
        assert_int_equal(mw_read_mesh("a.msh", NULL, &file, &error), MW_ERROR_INPUT);
        files_expect_error(&error, MW_ERROR_INPUT, bad[i].line, bad[i].says);
    }
}

static const char msh_partitions_text[] =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 3 \"shore\"\n$EndPhysicalNames\n"
    "$Entities\n0 1 2 0\n1 0 0 0 1 1 1 1 -3 0\n1 0 0 0 1 1 1 1 -7 1 1\n2 0 0 0 1 1 1 0 1 1\n"
    "$EndEntities\n$PartitionedEntities\n2\n1\n99 1\n1 1 2 0\n1 0 1 1 1 0 0 0 0\n"
    "11 1 1 2 1 2 0 0 0 1 1 1 1 -3 2 1 -1\n21 2 1 1 1 0 0 0 1 1 1 1 -7 0\n"
    "22 2 2 1 2 0 0 0 1 1 1 0 1 11\n$EndPartitionedEntities\n"
    "$Nodes\n1 5 1 5\n2 21 0 5\n1\n2\n3\n4\n5\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n4 0 0\n$EndNodes\n"
    "$Elements\n3 3 1 3\n1 11 1 1\n1 1 2\n2 21 3 1\n2 1 2 3 4\n2 22 2 1\n3 2 5 3\n"
    "$EndElements\n";

/* Elements of a mesh in partitions belong to entities of their own. A negative number is that of a
 * group whose entities are turned round. */
static void test_msh_partitions(void **state)
{
    (void)state;
    static const grid_wanted wanted = {.first_number = 1, .physical = true};
    expect_grid("a.msh", BYTES(msh_partitions_text), &wanted);
    mw_mesh_file file = mesh_file_read_text("a.msh", msh_partitions_text);
    assert_int_equal(file.edge_count, 1);
    assert_string_equal(file.mark_names[0], "shore");
    mw_mesh_file_release(&file);
}

/* Bytes that are no mesh, for a reason. */
static void expect_bad(const grid_bytes *g, const char *says)
{
    mw_mesh_file file;
    mw_error error;
    files_write("a.slf", (bytes){g->bytes, g->size});
    assert_int_equal(mw_read_mesh("a.slf", NULL, &file, &error), MW_ERROR_INPUT);
    if (!strstr(error.message, says)) fail_msg("'%s' does not say '%s'", error.message, says);
}

static void test_selafin(void **state)
{
    (void)state;
    static const grid_wanted wanted = {
        .first_number = 1, .shift = {100, 200}, .q = true, .triangles = true};
    for (int k = 0; k < 4; k++) {
        grid_form form = {.big = k & 1, .wide = k & 2};
        expect_grid_bytes(k == 3 ? "result" : "a.slf", grid_selafin(form), &wanted);
    }
    grid_bytes g = grid_selafin((grid_form){0});
    mw_mesh_file file = mesh_file_read_bytes("a.slf", (bytes){g.bytes, g.size});
    assert_int_equal(file.step_count, 2);
    mw_mesh_file_release(&file);
    /* layers above one another, and elements of another number of corners, are refused */
    static const unsigned char layers[] = {100, 0, 0, 0, 200, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                               sizes[] = {3, 0, 0, 0, 5, 0, 0, 0, 3};
    unsigned char *layer = memmem(g.bytes, g.size, layers, sizeof layers),
                  *corner = memmem(g.bytes, g.size, sizes, sizeof sizes);
    assert_true(layer && corner);
    layer[16] = 2;
    expect_bad(&g, "the elements have 3 corners, in 2 planes");
    layer[16] = 1;
    corner[8] = 5;
    expect_bad(&g, "the elements have 5 corners, in 1 planes");
    grid_release(&g);
}

static const char vtk_text[] =
    "# vtk DataFile Version 2.0\na test\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n0 0 0 "
    "2\n"
    "0 0 2 2 0 0 2 0 4 0 0\nCELLS 3 12\n4 0 1 2 3\n2 0 1\n3 1 4 2\nCELL_TYPES 3\n9 3 5\n"
    "CELL_DATA 3\nSCALARS physical int 1\nLOOKUP_TABLE default\n7 8 0\n"
    "POINT_DATA 5\nFIELD FieldData 1\nq 1 5 double\n0 10 20 30 40\nMETADATA\nINFORMATION 0\n\n";
static const char polydata_text[] =
    "# vtk DataFile Version 3.0\na test\nASCII\nDATASET POLYDATA\nPOINTS 6 float\n0 0 0\n2 0 0\n"
    "2 2 0\n0 2 0\n4 0 0\n4 2 0\nLINES 1 3\n2 0 1\nPOLYGONS 1 5\n4 0 1 2 3\n"
    "TRIANGLE_STRIPS 1 5\n4 1 4 2 5\nPOINT_DATA 6\nSCALARS q float\n0 10 20 30 40 50\n"
    "VECTORS v float\n1 2 3 1 2 3 1 2 3 1 2 3 1 2 3 1 2 3\nCOLOR_SCALARS c 1\n.1 .2 .3 .4 .5 .6\n"
    "LOOKUP_TABLE t 1\n0 0 0 1\n";

static void test_vtk(void **state)
{
    (void)state;
    static const grid_wanted wanted = {.q = true, .physical = true};
    expect_grid("a.vtk", BYTES(vtk_text), &wanted);
    expect_grid_bytes("a.vtk", grid_vtk(true), &wanted);
    expect_grid_bytes("a.any", grid_vtk(false), &wanted);
    mw_mesh_file file = mesh_file_read_text("a.vtk", polydata_text);
    mesh_file_expect_triangles(&file, 6, 4, (const uint32_t[]){0, 1, 2, 0, 2, 3, 1, 4, 2, 2, 4, 5});
    assert_int_equal(file.face_count, 3);
    assert_int_equal(file.field_count, 5);
    assert_string_equal(file.field_names[2], "v_1");
    assert_true(file.fields[2][5] == 2 && file.fields[4][5] == .6);
    mw_mesh_file_release(&file);
}

/* Vectors, tensors and texture coordinates become a field for each number; what is about the file
 * itself is skipped. */
static void test_vtk_fields(void **state)
{
    (void)state;
    static const char text[] =
        "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n"
        "0 0 0 1 0 0 0 1 0\nMETADATA\nINFORMATION 0\n\nVERTICES 2 1\nOFFSETS vtktypeint64\n0 1\n"
        "CONNECTIVITY vtktypeint64\n2\nPOLYGONS 2 3\nOFFSETS vtktypeint64\n0 3\n"
        "CONNECTIVITY vtktypeint64\n0 1 2\nPOINT_DATA 3\nTENSORS s double\n"
        "1 2 3 4 5 6 7 8 9\n11 12 13 14 15 16 17 18 19\n21 22 23 24 25 26 27 28 29\n"
        "TEXTURE_COORDINATES t 2 float\n.25 .5 1.25 1.5 2.25 2.5\nSCALARS p int 2\n"
        "LOOKUP_TABLE default\n31 32 41 42 51 52\nFIELD more 2\na 1 3 double\n61 62 63\nMETADATA\n"
        "INFORMATION 0\n\nb 1 3 int\n71 72 73\n";
    mw_mesh_file file = mesh_file_read_text("a.vtk", text);
    assert_int_equal(file.triangle_count, 1);
    assert_int_equal(file.field_count, 9 + 2 + 2 + 2);
    for (size_t v = 0; v < 3; v++) {
        double at = 10 * (double)v;
        for (size_t k = 0; k < 9; k++) assert_true(file.fields[k][v] == at + (double)(k + 1));
        for (size_t k = 0; k < 2; k++) {
            assert_true(file.fields[9 + k][v] == (double)v + 0.25 * (double)(k + 1));
            assert_true(file.fields[11 + k][v] == at + 31 + (double)k);
            assert_true(file.fields[13 + k][v] == (double)v + 61 + 10 * (double)k);
        }
    }
    assert_string_equal(file.field_names[13], "a");
    assert_string_equal(file.field_names[14], "b");
    mw_mesh_file_release(&file);
}

/* Names with blanks, bits, numbers of points; texts are passed over. */
static void test_vtk_names(void **state)
{
    (void)state;
    static const char head[] = "# vtk DataFile Version 4.2\ntitle\n%s\nDATASET UNSTRUCTURED_GRID\n"
                               "FIELD FieldData 2\n";
    static const char in_text[] =
        "TIME 1 1 double\n3600\nwords 1 2 string\nOFF%0A 1 2\nPOINT_DATA 4\nPOINTS 3 double\n"
        "0 0 0 1 0 0 0 1 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\nPOINT_DATA 3\n"
        "GLOBAL_IDS ids int\n7 8 9\nFIELD FieldData 3\nnames 1 3 string\nA\n\nPOINTS 1 2\n"
        "wet%20%or%3f 1 3 bit\n1 0 1\nq 1 3 int\n1 2 3\n";
    static const char in_bytes[] =
        "TIME 1 1 double\n\0\0\0\0\0\0\0\0\nwords 1 2 string\n\303a\nb\100\0\0\2\n\n\n"
        "POINTS 3 char\n\0\0\0\1\0\0\0\1\0\nCELLS 1 4\n\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2\n"
        "CELL_TYPES 1\n\0\0\0\5\nPOINT_DATA 3\nGLOBAL_IDS ids char\n\7\10\11\nFIELD FieldData 3\n"
        "names 1 3 string\n\300\201\0" /* a length of 256 */;
    static const char rest[] = "\300\nwet%20%or%3f 1 3 bit\n\240\nq 1 3 char\n\1\2\3\n";
    for (int binary = 0; binary < 2; binary++) {
        char file_bytes[1024];
        int size = snprintf(file_bytes, sizeof file_bytes, head, binary ? "BINARY" : "ASCII");
        size_t at = (size_t)size, more = binary ? sizeof in_bytes - 1 : sizeof in_text - 1;
        memcpy(file_bytes + at, binary ? in_bytes : in_text, more);
        at += more;
        if (binary) {
            memset(file_bytes + at, '\n', 256);
            memcpy(file_bytes + at + 256, rest, sizeof rest - 1);
            at += 256 + sizeof rest - 1;
        }
        mw_mesh_file file = mesh_file_read_bytes("a.vtk", (bytes){file_bytes, at});
        assert_int_equal(file.field_count, 3);
        assert_string_equal(file.field_names[0], "ids");
        assert_string_equal(file.field_names[1], "wet %or?");
        assert_string_equal(file.field_names[2], "q");
        for (size_t v = 0; v < 3; v++) {
            assert_true(file.fields[0][v] == 7 + (double)v);
            assert_true(file.fields[1][v] == (v == 1 ? 0 : 1));
            assert_true(file.fields[2][v] == 1 + (double)v);
        }
        mw_mesh_file_release(&file);
    }
}

static const char vtu_text[] =
    "<VTKFile type='UnstructuredGrid'>\n<UnstructuredGrid>\n<Piece NumberOfPoints='5' "
    "NumberOfCells='2'>\n<CellData Scalars='x'>\n<DataArray type='Int32' Name='physical' >7 0"
    "</DataArray></CellData><Points>\n<DataArray type='Float64' NumberOfComponents='3'>\n0 0 0 2 0 "
    "0\n2 2 0 0 2 0 4 0 0\n</DataArray></Points><Cells><DataArray type='Int32' Name='connectivity' "
    "format='ascii'>0 1 2 3 1 4 2</DataArray><DataArray type='Int32' Name='offsets'>4 7</DataArray>"
    "<DataArray type='UInt8' Name='types'>9 5</DataArray></Cells><PointData><DataArray "
    "type='String' Name='words'>97</DataArray><DataArray type='Float32' Name='q'>0 10 20 30 40"
    "</DataArray></PointData></Piece></UnstructuredGrid></VTKFile>\n";

static void test_vtu(void **state)
{
    (void)state;
    static const grid_wanted wanted = {.q = true, .physical = true};
    expect_grid("a.vtu", BYTES(vtu_text), &wanted);
    for (int k = 0; k < 16; k++) {
        grid_form form = {.big = k & 1, .wide = k & 2, .packed = k & 4};
        expect_grid_bytes(k & 1 ? "a.vtu" : "a.any", grid_vtu(form, k & 8), &wanted);
    }
}

/* Characters that XML describes, and what only looks so. */
static void test_vtu_names(void **state)
{
    (void)state;
    char text[sizeof vtu_text + 100];
    const char *name = strstr(vtu_text, "Name='q'");
    snprintf(text, sizeof text,
             "%.*sName='&lt;a&gt; &amp;amp; &quot;&apos;&#65;&#xe9;&#x1F30A;&no; &#0; &'%s",
             (int)(name - vtu_text), vtu_text, name + strlen("Name='q'"));
    mw_mesh_file file = mesh_file_read_text("a.vtu", text);
    assert_string_equal(file.field_names[0], "<a> &amp; \"'A\xc3\xa9\xf0\x9f\x8c\x8a&no; &#0; &");
    mw_mesh_file_release(&file);
}

static void test_npz(void **state)
{
    (void)state;
    static const grid_wanted wanted = {.q = true, .physical = true};
    for (int k = 0; k < 16; k++) {
        grid_form form = {.big = k & 1, .wide = k & 2, .packed = k & 4};
        expect_grid_bytes("a.npz", grid_npz(form, k & 8), &wanted);
    }
}

/* Floats of 16 bits, in either order. */
static void test_halves(void **state)
{
    (void)state;
    static const struct {
        unsigned char bytes[2];
        double value;
    } cases[] = {{{0x3c, 0}, 1},
                 {{0xc0, 0}, -2},
                 {{0, 1}, 0x1p-24},
                 {{4, 0}, 0x1p-14},
                 {{0x7b, 0xff}, 65504},
                 {{0x7c, 0}, INFINITY},
                 {{0xfc, 0}, -INFINITY},
                 {{0x35, 0x55}, 0x1.554p-2},
                 {{0x83, 0xff}, -0x1.ff8p-15}};
    static const mw_number_type half = {MW_NUMBER_FLOAT, 2};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const unsigned char *b = cases[i].bytes, turned[] = {b[1], b[0]};
        assert_true(mw__value_of_bytes(b, half, true) == cases[i].value);
        assert_true(mw__value_of_bytes(turned, half, false) == cases[i].value);
    }
    assert_true(isnan(mw__value_of_bytes((const unsigned char[]){0x7e, 0}, half, true)));
}

typedef mw_status grid_reader(mw_source *source, mw_mesh_builder *builder, mw_error *error);

/* Every file that is cut short, and many that are altered, is refused with its name or read. */
static void expect_no_harm(grid_reader *read, const char *contents, size_t size)
{
    mw_mesh_file file;
    mw_error error;
    mw_source source;
    mw_mesh_builder builder;
    assert_int_equal(mw__source_memory(&source, "a.any", contents, size, &error), MW_OK);
    mw__build_start(&builder, &file, &source);
    mw_status status = read(&source, &builder, &error);
    if (!status) status = mw__build_finish(&builder, &error);
    if (status) {
        assert_true(status == MW_ERROR_INPUT || status == MW_ERROR_LIMIT);
        assert_int_equal(strncmp(error.message, "a.any:", 6), 0);
    } else {
        for (size_t i = 0; i < 3 * file.triangle_count; i++)
            assert_true(file.triangles[i] < file.point_count);
        for (size_t e = 0; e < file.edge_count; e++)
            assert_true(file.edges[e].vertex[0] < file.point_count &&
                        file.edges[e].vertex[1] < file.point_count &&
                        file.edges[e].mark < file.mark_count);
    }
    mw__build_release(&builder);
    mw_mesh_file_release(&file);
    mw__source_close(&source);
}

static void damage(grid_reader *read, grid_bytes g, uint64_t *random)
{
    char *copy = malloc(g.size);
    assert_non_null(copy);
    size_t step = g.size > 400 ? g.size / 200 : 1;
    for (size_t cut = 0; cut < g.size; cut += step) expect_no_harm(read, g.bytes, cut);
    for (int k = 0; k < 300; k++) {
        memcpy(copy, g.bytes, g.size);
        for (int i = 0; i <= k % 3; i++)
            copy[mw__random_below(random, (uint32_t)g.size)] =
                (char)(k % 2 ? mw__random_below(random, 256) : (k % 4 ? 0xff : 0));
        expect_no_harm(read, copy, g.size);
    }
    free(copy);
    grid_release(&g);
}

static grid_bytes grid_copy(const char *text)
{
    return (grid_bytes){strdup(text), strlen(text)};
}

static void test_damaged(void **state)
{
    (void)state;
    uint64_t random = environment_print_seed("test_io_grid", 1);
    damage(mw__read_fort14, grid_copy(fort14_text), &random);
    damage(mw__read_2dm, grid_copy(sms_text), &random);
    damage(mw__read_su2, grid_copy(su2_text), &random);
    damage(mw__read_msh, grid_copy(msh_22_text), &random);
    damage(mw__read_msh, grid_copy(msh_data_text), &random);
    damage(mw__read_msh, grid_copy(msh_41_text), &random);
    damage(mw__read_msh, grid_copy(msh_partitions_text), &random);
    damage(mw__read_msh, grid_msh(22, false), &random);
    damage(mw__read_msh, grid_msh(41, true), &random);
    damage(mw__read_selafin, grid_selafin((grid_form){.big = true}), &random);
    damage(mw__read_vtk, grid_copy(vtk_text), &random);
    damage(mw__read_vtk, grid_copy(polydata_text), &random);
    damage(mw__read_vtk, grid_vtk(false), &random);
    damage(mw__read_vtu, grid_copy(vtu_text), &random);
    damage(mw__read_vtu, grid_vtu((grid_form){.packed = true}, false), &random);
    damage(mw__read_vtu, grid_vtu((grid_form){.packed = true}, true), &random);
    damage(mw__read_npz, grid_npz((grid_form){.wide = true}, false), &random);
    damage(mw__read_npz, grid_npz((grid_form){.packed = true}, false), &random);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fort14),
        cmocka_unit_test(test_fort14_titles),
        cmocka_unit_test(test_fort14_numbers),
        cmocka_unit_test(test_2dm),
        cmocka_unit_test(test_su2),
        cmocka_unit_test(test_msh),
        cmocka_unit_test(test_msh_data),
        cmocka_unit_test(test_selafin),
        cmocka_unit_test(test_msh_partitions),
        cmocka_unit_test(test_vtk),
        cmocka_unit_test(test_vtk_fields),
        cmocka_unit_test(test_vtk_names),
        cmocka_unit_test(test_vtu),
        cmocka_unit_test(test_vtu_names),
        cmocka_unit_test(test_npz),
        cmocka_unit_test(test_halves),
        cmocka_unit_test(test_damaged),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
