/* test_io_layouts.c - meshes in netCDF: each layout, and what is wrong in them. Files are written
 * here; those of models are looked at where they are present. Skipped without libnetcdf. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "io/netcdf/netcdf_output.h"
#include "support/files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void need_libnetcdf(void)
{
    if (mw_netcdf_version(NULL, 0)) return;
    print_message("left out: libnetcdf is not found\n");
    skip();
}

/* Six vertices, a quadrilateral and two triangles:
 *
 *     3-----4-----5        faces 0 1 4 3, 1 2 4, 2 5 4
 *     |     | \   |
 *     0-----1-----2  */
static const double xs[6] = {0, 1, 2, 0, 1, 2}, ys[6] = {0, 0, 0, 1, 1, 1};
static const int64_t quads[3][4] = {{0, 1, 4, 3}, {1, 2, 4, -1}, {2, 5, 4, -1}};
static const int64_t halves[4][3] = {{0, 1, 4}, {0, 4, 3}, {1, 2, 4}, {2, 5, 4}};

/* A file that is written in steps: names of variables, attributes, then values. */
typedef struct writing {
    mw_netcdf_output *output;
    int node, face, corner;
} writing;

static writing begin(const char *path, const char *node, const char *face, size_t faces,
                     size_t corners)
{
    writing w = {0};
    mw_error error;
    if (mw__netcdf_output_open(path, &w.output, &error)) fail_msg("%s", error.message);
    w.node = mw__netcdf_output_dimension(w.output, node, 6);
    w.face = mw__netcdf_output_dimension(w.output, face, faces);
    w.corner = mw__netcdf_output_dimension(w.output, "corners", corners);
    return w;
}

static int define(const writing *w, const char *name, mw_netcdf_type type, int a, int b)
{
    int dimensions[2] = {a, b};
    size_t rank = a < 0 ? 0 : b < 0 ? 1 : 2;
    return mw__netcdf_output_variable(w->output, name, type, rank, dimensions);
}

static void end(const writing *w)
{
    mw_error error;
    if (mw__netcdf_output_close(w->output, true, &error)) fail_msg("%s", error.message);
}

static void put_vertices(const writing *w, int variable, const double *values)
{
    mw__netcdf_output_doubles(w->output, variable, (size_t[]){0}, (size_t[]){6}, values);
}

/* Corners of faces, counted from `first`; `turned`: the corner is the first dimension. */
static void put_faces(const writing *w, int variable, const int64_t *corners, size_t faces,
                      size_t width, int64_t first, int64_t none, bool turned)
{
    int64_t values[60];
    for (size_t f = 0; f < faces; f++)
        for (size_t k = 0; k < width; k++) {
            int64_t corner = corners[f * width + k];
            values[turned ? k * faces + f : f * width + k] = corner < 0 ? none : corner + first;
        }
    mw__netcdf_output_integers(w->output, variable, (size_t[]){0, 0},
                               (size_t[]){turned ? width : faces, turned ? faces : width}, values);
}

static mw_mesh_file read_layout(const char *path, const char *layout)
{
    mw_mesh_file file;
    mw_error error;
    mw_file_options options = {.layout = layout};
    if (mw_read_mesh(path, &options, &file, &error)) fail_msg("%s", error.message);
    return file;
}

/* The four triangles of the mesh, whatever the cut of the quadrilateral. */
static void expect_mesh(const mw_mesh_file *file, double x0)
{
    assert_int_equal(file->point_count, 6);
    assert_int_equal(file->triangle_count, 4);
    for (size_t v = 0; v < 6; v++) {
        assert_true(fabs(file->points[3 * v] - (x0 + xs[v])) < 1e-12);
        assert_true(fabs(file->points[3 * v + 1] - ys[v]) < 1e-12);
    }
    double area = 0;
    for (size_t t = 0; t < 4; t++) {
        const double *p[3];
        for (size_t k = 0; k < 3; k++) p[k] = file->points + 3 * file->triangles[3 * t + k];
        area +=
            (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
    }
    assert_true(fabs(area - 4) < 1e-12);
}

typedef struct ugrid_form {
    int64_t first;
    int stated; /* -1: start_index is not there */
    bool turned;
    mw_netcdf_type type;
} ugrid_form;

static void write_ugrid(const char *path, ugrid_form form, const char *unit)
{
    writing w = begin(path, "node", "face", 3, 4);
    int mesh = define(&w, "mesh", MW_NETCDF_INT, -1, -1);
    int x = define(&w, "px", MW_NETCDF_DOUBLE, w.node, -1);
    int y = define(&w, "py", MW_NETCDF_DOUBLE, w.node, -1);
    int corners = form.turned ? define(&w, "table", form.type, w.corner, w.face)
                              : define(&w, "table", form.type, w.face, w.corner);
    int depth = define(&w, "depth", MW_NETCDF_SHORT, w.node, -1);
    mw__netcdf_output_text(w.output, mesh, "cf_role", "mesh_topology");
    mw__netcdf_output_number(w.output, mesh, "topology_dimension", MW_NETCDF_INT, 2);
    mw__netcdf_output_text(w.output, mesh, "node_coordinates", "py  px");
    mw__netcdf_output_text(w.output, mesh, "face_node_connectivity", "table");
    mw__netcdf_output_text(w.output, mesh, "face_dimension", "face");
    mw__netcdf_output_text(w.output, x, "standard_name", "projection_x_coordinate");
    mw__netcdf_output_text(w.output, y, "standard_name", "projection_y_coordinate");
    mw__netcdf_output_text(w.output, x, "units", unit);
    mw__netcdf_output_number(w.output, corners, "_FillValue", form.type, -7);
    if (form.stated >= 0)
        mw__netcdf_output_number(w.output, corners, "start_index", MW_NETCDF_INT, form.stated);
    mw__netcdf_output_number(w.output, depth, "scale_factor", MW_NETCDF_DOUBLE, 0.5);
    mw__netcdf_output_number(w.output, depth, "add_offset", MW_NETCDF_DOUBLE, -10);
    mw__netcdf_output_number(w.output, depth, "missing_value", MW_NETCDF_SHORT, 99);
    mw__netcdf_output_defined(w.output);
    put_vertices(&w, x, xs);
    put_vertices(&w, y, ys);
    put_faces(&w, corners, quads[0], 3, 4, form.first, -7, form.turned);
    put_vertices(&w, depth, (double[]){0, 1, 2, 99, 4, 5});
    end(&w);
}

static void test_ugrid(void **state)
{
    (void)state;
    need_libnetcdf();
    static const ugrid_form forms[] = {
        {0, 0, false, MW_NETCDF_INT},   {1, 1, false, MW_NETCDF_INT},
        {0, -1, false, MW_NETCDF_INT},  {1, -1, false, MW_NETCDF_INT64},
        {0, 0, true, MW_NETCDF_INT},    {1, 1, true, MW_NETCDF_DOUBLE},
        {1, 1, false, MW_NETCDF_SHORT},
    };
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        write_ugrid("a.nc", forms[i], "m");
        mw_mesh_file file = read_layout("a.nc", NULL);
        expect_mesh(&file, 0);
        assert_int_equal(file.first_number, forms[i].first);
        assert_int_equal(file.face_count, 3);
        assert_non_null(file.faces);
        assert_int_equal(file.faces[0], 0);
        assert_int_equal(file.faces[1], 0);
        assert_int_equal(file.faces[3], 2);
        assert_int_equal(file.field_count, 1);
        assert_string_equal(file.field_names[0], "depth");
        assert_true(file.fields[0][1] == -9.5 && file.fields[0][5] == -7.5);
        assert_true(isnan(file.fields[0][3]));
        assert_null(file.crs);
        mw_mesh_file_release(&file);
    }
    files_clear();
}

/* Packed by gzip, it is read from memory. */
/* A corner table turned round is recognised by its shape if no attribute names its dimension. */
static void test_turned_by_shape(void **state)
{
    (void)state;
    enum { FACES = 15 };
    need_libnetcdf();
    writing w = begin("shape.nc", "node", "face", FACES, 4);
    int mesh = define(&w, "mesh", MW_NETCDF_INT, -1, -1);
    int x = define(&w, "px", MW_NETCDF_DOUBLE, w.node, -1);
    int y = define(&w, "py", MW_NETCDF_DOUBLE, w.node, -1);
    int corners = define(&w, "table", MW_NETCDF_INT, w.corner, w.face);
    mw__netcdf_output_text(w.output, mesh, "cf_role", "mesh_topology");
    mw__netcdf_output_number(w.output, mesh, "topology_dimension", MW_NETCDF_INT, 2);
    mw__netcdf_output_text(w.output, mesh, "node_coordinates", "px py");
    mw__netcdf_output_text(w.output, mesh, "face_node_connectivity", "table");
    mw__netcdf_output_number(w.output, corners, "_FillValue", MW_NETCDF_INT, -7);
    mw__netcdf_output_defined(w.output);
    int64_t faces[FACES][4];
    for (size_t f = 0; f < FACES; f++) memcpy(faces[f], quads[f % 3], sizeof faces[f]);
    put_vertices(&w, x, xs);
    put_vertices(&w, y, ys);
    put_faces(&w, corners, faces[0], FACES, 4, 0, -7, true);
    end(&w);
    mw_mesh_file file = read_layout("shape.nc", NULL);
    assert_int_equal(file.face_count, FACES);
    mw_mesh_file_release(&file);
    files_clear();
}

static void test_packed(void **state)
{
    (void)state;
    need_libnetcdf();
    write_ugrid("a.nc", (ugrid_form){1, 1, false, MW_NETCDF_INT}, "m");
    size_t size;
    char *contents = files_read("a.nc", &size);
    files_write_gzip("b.nc.gz", (bytes){contents, size});
    mw_mesh_file file = read_layout("b.nc.gz", "ugrid");
    expect_mesh(&file, 0);
    mw_mesh_file_release(&file);
    mw_error error;
    for (size_t cut = 4; cut < size; cut += size / 23 + 1) {
        files_write("c.nc", (bytes){contents, cut});
        assert_int_equal(mw_read_mesh("c.nc", NULL, &file, &error), MW_ERROR_INPUT);
        files_expect_error(&error, MW_ERROR_INPUT, -1, "c.nc: ");
    }
    free(contents);
    files_clear();
}

typedef struct named_form {
    const char *layout, *node, *face, *corners, *x, *y;
    int64_t first;
    bool turned;
    const char *crs;
} named_form;

static void write_named(const char *path, const named_form *form)
{
    writing w = begin(path, form->node, form->face, 4, 3);
    int x = define(&w, form->x, MW_NETCDF_DOUBLE, w.node, -1);
    int y = define(&w, form->y, MW_NETCDF_DOUBLE, w.node, -1);
    int corners = form->turned ? define(&w, form->corners, MW_NETCDF_INT, w.corner, w.face)
                               : define(&w, form->corners, MW_NETCDF_INT, w.face, w.corner);
    mw__netcdf_output_number(w.output, MW_NETCDF_OUTPUT_FILE, "xllcorner", MW_NETCDF_DOUBLE, 1000);
    mw__netcdf_output_number(w.output, MW_NETCDF_OUTPUT_FILE, "zone", MW_NETCDF_INT, 55);
    mw__netcdf_output_text(w.output, MW_NETCDF_OUTPUT_FILE, "datum", "wgs84");
    mw__netcdf_output_text(w.output, MW_NETCDF_OUTPUT_FILE, "projection", "UTM");
    mw__netcdf_output_number(w.output, MW_NETCDF_OUTPUT_FILE, "false_northing", MW_NETCDF_INT,
                             10000000);
    mw__netcdf_output_defined(w.output);
    double radians[2][6];
    bool turn = strcmp(form->layout, "mpas") == 0 || strcmp(form->layout, "icon") == 0;
    for (size_t v = 0; v < 6; v++) {
        radians[0][v] = xs[v] * (turn ? 3.14159265358979323846 / 180 : 1);
        radians[1][v] = ys[v] * (turn ? 3.14159265358979323846 / 180 : 1);
    }
    put_vertices(&w, x, radians[0]);
    put_vertices(&w, y, radians[1]);
    put_faces(&w, corners, halves[0], 4, 3, form->first, 0, form->turned);
    end(&w);
}

static void test_named(void **state)
{
    (void)state;
    need_libnetcdf();
    static const named_form forms[] = {
        {"fvcom", "node", "nele", "nv", "lon", "lat", 1, true, "EPSG:4326"},
        {"fvcom", "node", "nele", "nv", "x", "y", 1, true, NULL},
        {"adcirc", "node", "nele", "element", "x", "y", 1, false, NULL},
        {"anuga", "number_of_points", "number_of_volumes", "volumes", "x", "y", 0, false,
         "EPSG:32755"},
        {"schism", "n", "f", "SCHISM_hgrid_face_nodes", "SCHISM_hgrid_node_x",
         "SCHISM_hgrid_node_y", 1, false, NULL},
        {"fesom", "nod2", "elem", "elements", "lon", "lat", 1, true, "EPSG:4326"},
        {"icon", "vertex", "cell", "vertex_of_cell", "vlon", "vlat", 1, true, "EPSG:4326"},
        {"mpas", "nCells", "nVertices", "cellsOnVertex", "lonCell", "latCell", 1, false,
         "EPSG:4326"},
        {"mpas", "nCells", "nVertices", "cellsOnVertex", "xCell", "yCell", 1, false, NULL},
    };
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        named_form form = forms[i];
        bool anuga = strcmp(form.layout, "anuga") == 0, metres = form.x[0] == 'x';
        if (metres && strcmp(form.layout, "mpas") == 0) form.layout = "metres";
        write_named("a.nc", &form);
        for (int named = 0; named < 2; named++) {
            mw_mesh_file file = read_layout("a.nc", named ? forms[i].layout : NULL);
            expect_mesh(&file, anuga ? 1000 : 0);
            assert_int_equal(file.first_number, form.first);
            if (anuga)
                assert_string_equal(file.crs, "EPSG:32755");
            else if (form.crs)
                assert_string_equal(file.crs, form.crs);
            else
                assert_null(file.crs);
            mw_mesh_file_release(&file);
        }
    }
    files_clear();
}

/* MPAS: the triangles at the border of the cells have fewer corners, and are left out. */
static void test_dual(void **state)
{
    (void)state;
    need_libnetcdf();
    writing w = begin("a.nc", "nCells", "nVertices", 3, 3);
    int x = define(&w, "lonCell", MW_NETCDF_DOUBLE, w.node, -1);
    int y = define(&w, "latCell", MW_NETCDF_DOUBLE, w.node, -1);
    int corners = define(&w, "cellsOnVertex", MW_NETCDF_INT, w.face, w.corner);
    mw__netcdf_output_defined(w.output);
    put_vertices(&w, x, xs);
    put_vertices(&w, y, ys);
    static const int64_t border[3][3] = {{1, 2, -1}, {0, 1, 4}, {-1, 4, 5}};
    put_faces(&w, corners, border[0], 3, 3, 1, 0, false);
    end(&w);
    mw_mesh_file file = read_layout("a.nc", NULL);
    assert_int_equal(file.triangle_count, 1);
    assert_int_equal(file.triangles[2], 4);
    mw_mesh_file_release(&file);
    files_clear();
}

static void expect_refused(const char *layout, mw_status wanted, const char *says)
{
    mw_mesh_file file;
    mw_error error;
    mw_file_options options = {.layout = layout};
    assert_int_equal(mw_read_mesh("a.nc", &options, &file, &error), wanted);
    files_expect_error(&error, wanted, -1, says);
}

static void test_numbers(void **state)
{
    (void)state;
    need_libnetcdf();
    write_ugrid("a.nc", (ugrid_form){0, 1, false, MW_NETCDF_INT}, "m");
    expect_refused(NULL, MW_ERROR_INPUT,
                   "a.nc: variable table: face 1 names vertex 0, which does not exist: there are "
                   "6, counted from 1 as start_index tells; the layout 'NAME:0' counts from 0");
    mw_mesh_file file = read_layout("a.nc", "ugrid:0");
    expect_mesh(&file, 0);
    mw_mesh_file_release(&file);
    write_ugrid("a.nc", (ugrid_form){3, -1, false, MW_NETCDF_INT}, "m");
    expect_refused(NULL, MW_ERROR_INPUT, "a.nc: variable table: face 2 names vertex 8");
    write_ugrid("a.nc", (ugrid_form){1, 1, false, MW_NETCDF_INT}, "m");
    expect_refused("fvcom", MW_ERROR_INPUT, "a.nc: no mesh in the layout fvcom");
    expect_refused("fvco", MW_ERROR_ARGUMENT, "no layout 'fvco'");
    expect_refused("ugrid:2", MW_ERROR_ARGUMENT, "after the colon");
    files_clear();
}

static void test_crs(void **state)
{
    (void)state;
    need_libnetcdf();
    static const struct {
        const char *attribute, *text, *crs;
    } mappings[] = {
        {"crs_wkt", "PROJCRS[\"a\",\n  BASE]", "PROJCRS[\"a\", BASE]"},
        {"spatial_ref", "GEOGCS[\"b\"]", "GEOGCS[\"b\"]"},
        {"epsg_code", "EPSG:25832", "EPSG:25832"},
        {"EPSG_code", "25833", "EPSG:25833"},
    };
    for (size_t i = 0; i < sizeof mappings / sizeof *mappings; i++) {
        writing w = begin("a.nc", "node", "nele", 4, 3);
        int x = define(&w, "x", MW_NETCDF_DOUBLE, w.node, -1);
        int y = define(&w, "y", MW_NETCDF_DOUBLE, w.node, -1);
        int corners = define(&w, "element", MW_NETCDF_INT, w.face, w.corner);
        int crs = define(&w, "projection", MW_NETCDF_INT, -1, -1);
        int depth = define(&w, "depth", MW_NETCDF_DOUBLE, w.node, -1);
        mw__netcdf_output_text(w.output, crs, mappings[i].attribute, mappings[i].text);
        mw__netcdf_output_text(w.output, depth, "grid_mapping", "projection: x y");
        mw__netcdf_output_defined(w.output);
        put_vertices(&w, x, xs);
        put_vertices(&w, y, ys);
        put_vertices(&w, depth, ys);
        put_faces(&w, corners, halves[0], 4, 3, 1, 0, false);
        end(&w);
        mw_mesh_file file = read_layout("a.nc", NULL);
        assert_string_equal(file.crs, mappings[i].crs);
        mw_mesh_file_release(&file);
    }
    files_clear();
}

/* ICON's files of fields hold the corners of each cell, not a table: corners at one place become
 * one vertex. */
static void test_bounds(void **state)
{
    (void)state;
    need_libnetcdf();
    writing w = begin("a.nc", "none", "cell", 4, 3);
    double corners[2][12];
    int x = define(&w, "clon_bnds", MW_NETCDF_DOUBLE, w.face, w.corner);
    int y = define(&w, "clat_bnds", MW_NETCDF_DOUBLE, w.face, w.corner);
    mw__netcdf_output_defined(w.output);
    for (size_t i = 0; i < 12; i++) {
        corners[0][i] = xs[halves[i / 3][i % 3]] * (3.14159265358979323846 / 180);
        corners[1][i] = ys[halves[i / 3][i % 3]] * (3.14159265358979323846 / 180);
    }
    mw__netcdf_output_doubles(w.output, x, (size_t[]){0, 0}, (size_t[]){4, 3}, corners[0]);
    mw__netcdf_output_doubles(w.output, y, (size_t[]){0, 0}, (size_t[]){4, 3}, corners[1]);
    end(&w);
    mw_mesh_file file = read_layout("a.nc", NULL);
    assert_int_equal(file.point_count, 6);
    assert_int_equal(file.triangle_count, 4);
    for (size_t i = 0; i < 12; i++) {
        const double *p = file.points + 3 * (size_t)file.triangles[i];
        assert_true(fabs(p[0] - xs[halves[i / 3][i % 3]]) < 1e-12);
        assert_true(fabs(p[1] - ys[halves[i / 3][i % 3]]) < 1e-12);
    }
    mw_mesh_file_release(&file);
    files_clear();
}

/* Dimensions that the file cannot hold; a table of texts; axes of different lengths. */
static void test_wrong(void **state)
{
    (void)state;
    need_libnetcdf();
    /* an attribute with a name of 4 GB: libnetcdf would ask for the memory */
    files_write("a.nc", BYTES("CDF\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\14\0\0\0\1\xff\xff\xff\xf0"
                              "aaaaaaaaaaaaaaaaaaaaaaaa"));
    expect_refused(NULL, MW_ERROR_INPUT, "damaged: a name of 4294967280 bytes");
    /* a text of 4 GB; a name longer than netCDF's, which libnetcdf would copy past its end */
    files_write("a.nc", BYTES("CDF\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\14\0\0\0\1\0\0\0\1"
                              "a\0\0\0\0\0\0\2\xff\xff\xff\xf0"
                              "aaaaaaaaaaaaaaaa"));
    expect_refused(NULL, MW_ERROR_INPUT, "the data end early");
    files_write("a.nc", BYTES("CDF\1\0\0\0\0\0\0\0\12\0\0\0\1\0\0\1\1aaaa"));
    expect_refused(NULL, MW_ERROR_INPUT, "damaged: a name of 257 bytes");
    for (int wrong = 0; wrong < 5; wrong++) {
        static const char *const says[] = {
            "a.nc: variable element: 3000000000 values are announced",
            "a.nc: variable element: it holds no numbers",
            "a.nc: variable y: its dimensions are not those of x",
            "a.nc: variable element: face 1 has fewer than 3 corners",
            "a.nc: variable element: face 1 (from 1): a corner is missing before vertex 3",
        };
        writing w = begin("a.nc", "node", "nele", wrong == 0 ? 1000000000 : 4, 3);
        int x = define(&w, "x", MW_NETCDF_DOUBLE, w.node, -1);
        int y = define(&w, "y", MW_NETCDF_DOUBLE, wrong == 2 ? w.corner : w.node, -1);
        mw_netcdf_type type = wrong == 1 ? MW_NETCDF_CHAR : MW_NETCDF_INT;
        int corners = define(&w, "element", type, w.face, w.corner);
        mw__netcdf_output_defined(w.output);
        put_vertices(&w, x, xs);
        if (wrong != 2) put_vertices(&w, y, ys);
        static const int64_t faces[2][3] = {{1, -9, -9}, {1, -9, 3}};
        if (wrong > 2)
            mw__netcdf_output_integers(w.output, corners, (size_t[]){0, 0}, (size_t[]){1, 3},
                                       faces[wrong - 3]);
        if (wrong > 2)
            for (size_t f = 1; f < 4; f++)
                mw__netcdf_output_integers(w.output, corners, (size_t[]){f, 0}, (size_t[]){1, 3},
                                           (int64_t[]){1, 2, 3});
        end(&w);
        expect_refused(NULL, MW_ERROR_INPUT, says[wrong]);
    }
    files_clear();
}

/* A vertex twice in a face is read, and the file tells in which variable; a concave face is not. */
static void test_places(void **state)
{
    (void)state;
    need_libnetcdf();
    static const int64_t faces[2][3][4] = {{{0, 1, 4, 3}, {1, 2, 2, -1}, {2, 5, 4, -1}},
                                           {{0, 1, 4, 3}, {1, 2, 4, -1}, {1, 5, 2, 4}}};
    for (int concave = 0; concave < 2; concave++) {
        writing w = begin("a.nc", "node", "nele", 3, 4);
        int x = define(&w, "x", MW_NETCDF_DOUBLE, w.node, -1);
        int y = define(&w, "y", MW_NETCDF_DOUBLE, w.node, -1);
        int corners = define(&w, "element", MW_NETCDF_INT, w.face, w.corner);
        mw__netcdf_output_defined(w.output);
        put_vertices(&w, x, xs);
        put_vertices(&w, y, ys);
        put_faces(&w, corners, faces[concave][0], 3, 4, 1, -9, false);
        end(&w);
        if (concave) {
            expect_refused(NULL, MW_ERROR_INPUT, "a.nc: variable element: face 3 with 4 corners");
            continue;
        }
        mw_mesh_file file = read_layout("a.nc", "adcirc");
        assert_string_equal(file.repeat, "a.nc: variable element: face 2 has vertex 3 twice");
        assert_int_equal(file.triangles[3 * file.repeat_triangle + 1],
                         file.triangles[3 * file.repeat_triangle + 2]);
        mw_mesh_file_release(&file);
    }
    files_clear();
}

/* What is written is UGRID: values per triangle and the coordinate system come back, too. */
static void test_writer(void **state)
{
    (void)state;
    need_libnetcdf();
    write_ugrid("a.nc", (ugrid_form){1, 1, false, MW_NETCDF_INT}, "m");
    mw_mesh_file file = read_layout("a.nc", NULL), back;
    char crs[] = "EPSG:25832", name[] = "cr/s", *names[] = {name};
    double values[4] = {0.5, NAN, -3, 1e300}, *columns[] = {values};
    file.crs = crs;
    file.triangle_field_names = names;
    file.triangle_fields = columns;
    file.triangle_field_count = 1;
    mw_error error;
    if (mw_write_mesh("b.nc", &file, NULL, NULL, &error)) fail_msg("%s", error.message);
    back = read_layout("b.nc", "ugrid");
    assert_memory_equal(back.triangles, file.triangles, 12 * sizeof *file.triangles);
    assert_memory_equal(back.points, file.points, 18 * sizeof *file.points);
    assert_string_equal(back.crs, crs);
    assert_true(isnan(back.fields[0][3]) && back.fields[0][1] == -9.5);
    assert_int_equal(back.triangle_field_count, 1);
    assert_string_equal(back.triangle_field_names[0], "cr_s");
    assert_true(isnan(back.triangle_fields[0][1]) && back.triangle_fields[0][3] == 1e300);
    mw_mesh_file_release(&back);
    char wkt[] = "GEOGCS[\"WGS 84\"]";
    file.crs = wkt;
    assert_int_equal(mw_write_mesh("b.nc", &file, NULL, NULL, &error), MW_OK);
    back = read_layout("b.nc", NULL);
    assert_string_equal(back.crs, wkt);
    mw_mesh_file_release(&back);
    assert_int_equal(mw_write_mesh("-", &file, "netcdf", NULL, &error), MW_ERROR_ARGUMENT);
    files_expect_error(&error, MW_ERROR_ARGUMENT, -1, "a file only");
    file.crs = NULL;
    file.triangle_field_names = NULL;
    file.triangle_fields = NULL;
    file.triangle_field_count = 0;
    mw_mesh_file_release(&file);
    files_clear();
}

/* Faces stay whole, with one value each, and are read as the same triangles; one whose triangles
 * differ is written as triangles. */
static void test_written_faces(void **state)
{
    (void)state;
    need_libnetcdf();
    write_ugrid("a.nc", (ugrid_form){1, 1, false, MW_NETCDF_INT}, "m");
    mw_mesh_file file = read_layout("a.nc", NULL), back;
    char name[] = "u", *names[] = {name};
    double values[4], *columns[] = {values};
    for (size_t t = 0; t < 4; t++) values[t] = file.faces[t] + 0.5;
    file.triangle_field_names = names;
    file.triangle_fields = columns;
    file.triangle_field_count = 1;
    for (size_t faces = file.face_count; faces <= 4; faces++) {
        assert_int_equal(mw_write_mesh("b.nc", &file, NULL, NULL, NULL), MW_OK);
        back = read_layout("b.nc", "ugrid");
        assert_int_equal(back.triangle_count, 4);
        assert_int_equal(back.faces ? back.face_count : back.triangle_count, faces);
        assert_memory_equal(back.triangles, file.triangles, 12 * sizeof *file.triangles);
        assert_memory_equal(back.triangle_fields[0], values, sizeof values);
        for (size_t t = 0; t < 4 && faces == file.face_count; t++)
            assert_int_equal(back.faces[t], file.faces[t]);
        mw_mesh_file_release(&back);
        for (size_t t = 1; t < 4; t++) /* one whole face less */
            if (values[t] == values[t - 1]) {
                values[t] += 7;
                break;
            }
    }
    file.triangle_field_names = NULL;
    file.triangle_fields = NULL;
    file.triangle_field_count = 0;
    mw_mesh_file_release(&file);
    files_clear();
}

/* Counts as other programs found them; shared/data/README.md. */
/* libnetcdf 4.9 of big-endian machines reads the numbers of dimensions in HDF5 files of other
 * machines the wrong way round, its own ncdump, too; such a file is refused there. */
static void expect_not_numbered(const char *path)
{
    mw_mesh_file file;
    mw_error error;
    assert_int_not_equal(mw_read_mesh(path, NULL, &file, &error), MW_OK);
    assert_non_null(strstr(error.message, "dimension"));
}

static void test_models(void **state)
{
    (void)state;
    need_libnetcdf();
    static const struct {
        const char *name;
        size_t vertices, faces;
        const char *crs;
        bool numbered; /* variables of HDF5 with numbers of dimensions */
    } models[] = {
        {"ocean/dflow_simplebox_hex7_map.nc.gz", 720, 810, "EPSG:28992", false},
        {"ocean/ugrid_eleven_points.nc", 11, 13, "EPSG:4326", false},
        {"ocean/ugrid_elevation_nl.nc.gz", 2790, 5248, NULL, true},
        {"ocean/fesom_mesh_diag.nc.gz", 3140, 5839, "EPSG:4326", true},
        {"ocean/ugrid_overlap_rll10_csne4.nc", 683, 856, "EPSG:4326", true},
        {"ocean/fvcom_example.nc", 551, 903, "EPSG:4326", true},
        {"ocean/schism_out2d.nc.gz", 823, 791, NULL, true},
        {"ocean/shinnecock_fort.63.nc", 3070, 5780, "EPSG:4326", false},
        {"ocean/cairns.sww.gz", 2579, 4962, NULL, false},
        {"ocean/icon_5120.nc.gz", 2570, 5120, "EPSG:4326", false},
        {"ocean/tuflowfv_cone.nc.gz", 1497, 2866, NULL, true},
        {"star/mpas_qu1920.nc.gz", 162, 320, "EPSG:4326", false},
    };
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        const char *path = files_shared(models[i].name);
        if (!path) continue;
        if (models[i].numbered && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__) {
            expect_not_numbered(path);
            continue;
        }
        mw_mesh_file file = read_layout(path, NULL);
        assert_int_equal(file.point_count, models[i].vertices);
        assert_int_equal(file.faces ? file.face_count : file.triangle_count, models[i].faces);
        if (models[i].crs)
            assert_string_equal(file.crs, models[i].crs);
        else
            assert_null(file.crs);
        mw_mesh_file_release(&file);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ugrid),         cmocka_unit_test(test_turned_by_shape),
        cmocka_unit_test(test_packed),        cmocka_unit_test(test_named),
        cmocka_unit_test(test_dual),          cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_crs),           cmocka_unit_test(test_wrong),
        cmocka_unit_test(test_models),        cmocka_unit_test(test_writer),
        cmocka_unit_test(test_written_faces), cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_places),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
