/* test_io_ugrid.c - what a topology of UGRID may say, and what is wrong in it. Skipped without
 * libnetcdf. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "io/netcdf/netcdf_output.h"
#include "support/files.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void need_libnetcdf(void)
{
    if (mw_netcdf_version(NULL, 0)) return;
    print_message("left out: libnetcdf is not found\n");
    skip();
}

/* Two triangles over four vertices; what is NULL or 0 is as it should be. */
typedef struct topology {
    const char *coordinates, *connectivity; /* "": no such attribute */
    const char *start;                      /* start_index: a text; NULL: none */
    double start_number;                    /* where start_text is NULL and this is not 0 */
    bool turned, named_by_centre, flat_table, square_axis, real;
    size_t corners;
    double odd; /* a corner of the second face */
} topology;

enum { NODES = 4, FACES = 2 };

static int dimension_variable(mw_netcdf_output *output, const char *name, mw_netcdf_type type,
                              size_t rank, int a, int b)
{
    return mw__netcdf_output_variable(output, name, type, rank, (int[]){a, b});
}

static void write_values(mw_netcdf_output *output, const topology *t, int x, int y, int table,
                         size_t width)
{
    static const double xs[NODES] = {0, 1, 1, 0}, ys[NODES] = {0, 0, 1, 1},
                        faces[FACES][4] = {{0, 1, 2, -9}, {0, 2, 3, -9}};
    double values[16];
    const double first = t->start ? strcmp(t->start, "1") == 0 : t->start_number == 1 ? 1 : 0;
    if (!t->square_axis) mw__netcdf_output_doubles(output, x, (size_t[]){0}, (size_t[]){NODES}, xs);
    mw__netcdf_output_doubles(output, y, (size_t[]){0}, (size_t[]){NODES}, ys);
    if (t->flat_table) return;
    for (size_t f = 0; f < FACES; f++)
        for (size_t k = 0; k < width; k++)
            values[t->turned ? k * FACES + f : f * width + k] =
                faces[f][k] < 0 ? -9 : faces[f][k] + first;
    if (t->odd != 0) values[t->turned ? FACES + 1 : width + 1] = t->odd;
    mw__netcdf_output_doubles(output, table, (size_t[]){0, 0},
                              (size_t[]){t->turned ? width : FACES, t->turned ? FACES : width},
                              values);
}

static void write_topology(const topology *t)
{
    mw_netcdf_output *output;
    mw_error error;
    const size_t width = t->corners ? t->corners : 4;
    if (mw__netcdf_output_open("u.nc", &output, &error)) fail_msg("%s", error.message);
    const int node = mw__netcdf_output_dimension(output, "node", NODES),
              face = mw__netcdf_output_dimension(output, "face", FACES),
              corner = mw__netcdf_output_dimension(output, "corner", width);
    const int mesh = dimension_variable(output, "mesh", MW_NETCDF_INT, 0, 0, 0),
              x = dimension_variable(output, "px", MW_NETCDF_DOUBLE, t->square_axis ? 2 : 1, node,
                                     node),
              y = dimension_variable(output, "py", MW_NETCDF_DOUBLE, 1, node, 0),
              middle = dimension_variable(output, "mx", MW_NETCDF_DOUBLE, 1, face, 0),
              table = dimension_variable(output, "table", MW_NETCDF_DOUBLE, t->flat_table ? 1 : 2,
                                         t->turned ? corner : face, t->turned ? face : corner);
    (void)middle;
    mw__netcdf_output_text(output, mesh, "cf_role", "mesh_topology");
    mw__netcdf_output_number(output, mesh, "topology_dimension", MW_NETCDF_INT, 2);
    const char *coordinates = t->coordinates ? t->coordinates : "px py",
               *connectivity = t->connectivity ? t->connectivity : "table";
    if (*coordinates) mw__netcdf_output_text(output, mesh, "node_coordinates", coordinates);
    if (*connectivity) mw__netcdf_output_text(output, mesh, "face_node_connectivity", connectivity);
    if (t->named_by_centre) mw__netcdf_output_text(output, mesh, "face_coordinates", "mx mx");
    mw__netcdf_output_text(output, x, "standard_name", "projection_x_coordinate");
    mw__netcdf_output_text(output, y, "standard_name", "projection_y_coordinate");
    mw__netcdf_output_number(output, table, "_FillValue", MW_NETCDF_DOUBLE, -9);
    if (t->start)
        mw__netcdf_output_text(output, table, "start_index", t->start);
    else if (t->start_number != 0)
        mw__netcdf_output_number(output, table, "start_index",
                                 t->real ? MW_NETCDF_DOUBLE : MW_NETCDF_INT, t->start_number);
    mw__netcdf_output_defined(output);
    write_values(output, t, x, y, table, width);
    if (mw__netcdf_output_close(output, true, &error)) fail_msg("%s", error.message);
}

/* start_index as a number or as a text; corners before faces, if the centres of faces tell which
 * dimension is theirs. */
static void test_forms(void **state)
{
    static const topology forms[] = {
        {.start = NULL},
        {.start = "0"},
        {.start = "1"},
        {.start_number = 1},
        {.start_number = 1, .real = true},
        {.turned = true, .named_by_centre = true},
        {.turned = true, .named_by_centre = true, .start = "1"},
        {.coordinates = "  px   py  "},
        {.corners = 3},
    };
    static const uint32_t wanted[6] = {0, 1, 2, 0, 2, 3};
    (void)state;
    need_libnetcdf();
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        mw_mesh_file file;
        mw_error error;
        write_topology(&forms[i]);
        if (mw_read_mesh("u.nc", NULL, &file, &error)) fail_msg("%zu: %s", i, error.message);
        assert_int_equal(file.point_count, NODES);
        assert_int_equal(file.triangle_count, FACES);
        assert_memory_equal(file.triangles, wanted, sizeof wanted);
        const bool one = (forms[i].start && forms[i].start[0] == '1') || forms[i].start_number == 1;
        assert_int_equal(file.first_number, one);
        assert_true(file.points[3] == 1 && file.points[7] == 1);
        mw_mesh_file_release(&file);
    }
}

static void test_mistakes(void **state)
{
    static const struct {
        topology t;
        const char *says;
    } mistakes[] = {
        {{.coordinates = ""}, "mesh: node_coordinates does not name two variables"},
        {{.coordinates = "px"}, "mesh: node_coordinates does not name two variables"},
        {{.coordinates = "px pz"}, "mesh: node_coordinates names 'pz', which is not there"},
        {{.connectivity = ""}, "mesh: it has no face_node_connectivity: this is no mesh of faces"},
        {{.connectivity = "list"}, "mesh: face_node_connectivity names 'list', which is not there"},
        {{.flat_table = true}, "table: it has 1 dimensions, not two: faces and their corners"},
        {{.corners = 2}, "table: its faces have 2 corners; at least 3 are needed"},
        {{.square_axis = true}, "px: it is a coordinate, but has 2 dimensions"},
        {{.start_number = 2}, "table: start_index is neither 0 nor 1"},
        {{.start_number = 0.5, .real = true}, "table: start_index is neither 0 nor 1"},
        {{.start = "one"}, "table: start_index is neither 0 nor 1"},
        {{.odd = 1.5}, "table: face 1 (from 0): 1.5 is not a vertex number"},
        {{.odd = 1.5, .start = "1"}, "table: face 2 (from 1): 1.5 is not a vertex number"},
        {{.odd = 4}, "table: face "},
        {{.odd = 4, .start = "0"},
         "table: face 1 names vertex 4, which does not exist: there are 4, counted from 0"},
        {{.odd = 5, .start = "1"},
         "table: face 2 names vertex 5, which does not exist: there are 4, counted from 1"},
    };
    (void)state;
    need_libnetcdf();
    for (size_t i = 0; i < sizeof mistakes / sizeof *mistakes; i++) {
        mw_mesh_file file;
        mw_error error;
        write_topology(&mistakes[i].t);
        if (mw_read_mesh("u.nc", NULL, &file, &error) == MW_OK)
            fail_msg("%zu is taken, which should say: %s", i, mistakes[i].says);
        files_expect_error(&error, MW_ERROR_INPUT, -1, mistakes[i].says);
        assert_null(file.points);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forms),
        cmocka_unit_test(test_mistakes),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
