/* test_io_mesh.c - readers of meshes: what they take. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/write_mesh_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static void expect_square(const char *name, const char *text)
{
    mw_mesh_file file = mesh_file_read_text(name, text);
    mesh_file_expect_triangles(&file, 4, 2, square_triangles);
    mesh_file_expect_points(&file, square_points);
    mw_mesh_file_release(&file);
}

static void test_off(void **state)
{
    (void)state;
    expect_square("a.off", "OFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 3\n");
    expect_square("a.off", "OFF 4 2\n" SQUARE_BODY "3 0 1 2\n3 0 2 3 255 0 0\n");
    expect_square("a.off",
                  "OFF\r\n4 2 0\r\n0 0 0\r\n1 0 0\r\n1 1 .5\r\n0 1 0\r\n3 0 1 2\r\n3 0 2 3\r\n");
    expect_square("a.off", "OFF\r4 2 0\r0 0 0\r1 0 0\r1 1 .5\r0 1 0\r3 0 1 2\r3 0 2 3\r");
    expect_square("a.off", "\xef\xbb\xbfOFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 3");
    expect_square("a.off", "# made by hand\n\nOFF # faces\n\n4 1 5 # counts\n\n" SQUARE_BODY
                           "\n4  0\t1 2 3 # last\n# end\n\n");
    expect_square(
        "a.off",
        "COFF\n4 1 0\n0 0 0 255 0 0 255\n1 0 0 1 2 3 4\n1 1 .5\n0 1 0\n4 0 1 2 3 0.1 0.2 0.3 1\n");
    expect_square("a.off",
                  "NOFF\n4 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 .5 0 0 1\n0 1 0 0 0 1\n4 0 1 2 3\n");
    expect_square("a.off", "STCNOFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 3\n");
    /* the contents tell the format, whatever the name */
    expect_square("a.txt", "OFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 3\n");
    expect_square("a.ply", "OFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 3\n");
    mw_mesh_file file = mesh_file_read_text("none.off", "OFF\n0 0 0\n");
    mesh_file_expect_triangles(&file, 0, 0, NULL);
    mw_mesh_file_release(&file);
    file = mesh_file_read_text("odd.off", "OFF\n3 0 0\nnan -inf -0.0\n1e308 1e-320 1.5D3\n3 4 5\n");
    assert_true(isnan(file.points[0]) && file.points[1] == -INFINITY && signbit(file.points[2]));
    assert_true(file.points[3] == 1e308 && file.points[4] == 1e-320 && file.points[5] == 1500);
    mw_mesh_file_release(&file);
}

static void test_obj(void **state)
{
    (void)state;
    expect_square("a.obj", SQUARE_V "f 1 2 3 4\n");
    expect_square("a.obj", "mtllib x.mtl\no thing\n" SQUARE_V
                           "vt 0 0\nvn 0 0 1\ng a b\nusemtl m\ns off\nf 1/1/1 2//1 3/1 4\nl 1 2\n");
    expect_square("a.obj", SQUARE_V "f -4 -3 -2 -1\n");
    expect_square("a.obj", "f 1 2 3 4\n" SQUARE_V); /* faces may come first */
    expect_square("a.obj", SQUARE_V "f 1 \\\n2 3\\\r\n 4\n");
    expect_square("a.obj", "v 0 0 \\\n0\nv 1 0 0 1.0\nv 1 1 .5 0.1 0.2 0.3\n  v  0\t1  0\r\nf 1// "
                           "2// 3// 4// # face\n");
    expect_square("a.obj", SQUARE_V "f 1 2 3\nf 1 3 4\\");
    expect_square("a.txt", "# by hand\n" SQUARE_V "f 1 2 3\nf 1 3 4\n");
    mw_mesh_file file = mesh_file_read_text("cloud.obj", "v 0 0 0\n");
    mesh_file_expect_triangles(&file, 1, 0, NULL);
    mw_mesh_file_release(&file);
}

static void test_ply_ascii(void **state)
{
    (void)state;
#define PLY_XYZ "property float x\nproperty double y\nproperty float32 z\n"
    expect_square("a.ply",
                  "ply\nformat ascii 1.0\ncomment c\nobj_info i\nelement vertex 4\n" PLY_XYZ
                  "element face 1\nproperty list uchar int vertex_indices\nend_header\n" SQUARE_BODY
                  "4 0 1 2 3\n");
    expect_square(
        "a.ply",
        "ply\nformat ascii 1.0\nelement face 2\nproperty list int8 uint16 vertex_index\nproperty "
        "uchar red\n"
        "element vertex 4\nproperty list uchar int extra\n" PLY_XYZ
        "element edge 1\nproperty int a\n"
        "end_header\n3 0 1 2 255\n3 0 2 3 0\n1 7 0 0 0\n0 1 0 0\n2 7 8 1 1 .5\n0 0 1 0\n9\n\n");
    mw_mesh_file file = mesh_file_read_text(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float y\nproperty int8 quality\n"
        "property float x\nproperty float t\nend_header\n1 -3 2 0.25\n\n3 nan 4 inf\n");
    assert_int_equal(file.point_count, 2);
    assert_false(file.has_z);
    mesh_file_expect_points(&file, (const double[]){2, 1, 0, 4, 3, 0});
    assert_int_equal(file.field_count, 2);
    assert_string_equal(file.field_names[0], "quality");
    assert_string_equal(file.field_names[1], "t");
    assert_true(file.fields[0][0] == -3 && isnan(file.fields[0][1]));
    assert_true(file.fields[1][0] == 0.25 && file.fields[1][1] == INFINITY);
    mw_mesh_file_release(&file);
    /* an element without properties has no data, whatever its count */
    file = mesh_file_read_text(
        "a.ply", "ply\nformat ascii 1.0\nelement nothing 999999999999\nelement vertex 1\n" PLY_XYZ
                 "end_header\n1 2 3\n");
    mesh_file_expect_points(&file, (const double[]){1, 2, 3});
    mw_mesh_file_release(&file);
}

/* Reads a mesh of text and expects these triangles, and the face of each. */
static void expect_cut(const char *name, const char *text, size_t count, const uint32_t *triangles,
                       const uint32_t *faces)
{
    mw_mesh_file file = mesh_file_read_text(name, text);
    mesh_file_expect_triangles(&file, file.point_count, count, triangles);
    if (!faces) assert_null(file.faces);
    for (size_t t = 0; faces && t < count; t++) assert_int_equal(file.faces[t], faces[t]);
    assert_int_equal(file.face_count, faces ? faces[count - 1] + 1 : count);
    assert_int_equal(file.first_number, strstr(name, ".obj") ? 1 : 0);
    mw_mesh_file_release(&file);
}
#define CUT(name, text, count, faces, ...)                                                         \
    expect_cut(name, text, count, (const uint32_t[]){__VA_ARGS__}, faces)

/* Quadrilaterals are cut along the shorter diagonal, whichever corner comes first, and whether
 * their vertices come before or behind them. */
static void test_quadrilaterals(void **state)
{
    (void)state;
    static const uint32_t two[] = {0, 0}, mixed[] = {0, 1, 1, 2};
#define KITE "v 0 0 0\nv 3 0 0\nv 4 2 0\nv 0 1 0\n"
    CUT("a.obj", KITE "f 1 2 3 4\n", 2, two, 1, 2, 3, 1, 3, 0);
    CUT("a.obj", KITE "f 3 4 1 2\n", 2, two, 1, 2, 3, 1, 3, 0);
    CUT("a.obj", "f 3 4 1 2\n" KITE, 2, two, 1, 2, 3, 1, 3, 0);
    CUT("a.obj", KITE "f 4 3 2 1\n", 2, two, 1, 0, 3, 1, 3, 2);
    CUT("a.obj", "f 1 2 3\nf 4 3 2 1\nf 1 2 4\n" KITE, 4, mixed, 0, 1, 2, 1, 0, 3, 1, 3, 2, 0, 1,
        3);
    /* diagonals of one length: the lowest vertex decides */
    CUT("a.off", "OFF\n4 1 0\n0 1 0\n0 0 0\n1 0 0\n1 1 0\n4 1 2 3 0\n", 2, two, 0, 1, 2, 0, 2, 3);
    CUT("a.off", "OFF\n4 1 0\n1 0 0\n0 1 0\n0 0 0\n1 1 0\n4 2 0 3 1\n", 2, two, 0, 3, 1, 0, 1, 2);
    /* a corner on a straight line between its neighbours: no triangle is flat, however long */
    CUT("a.off", "OFF\n4 1 0\n0 0 0\n5 0 0\n6 0 0\n5.5 9 0\n4 0 1 2 3\n", 2, two, 1, 2, 3, 1, 3, 0);
    /* a wall is looked at from the side */
    CUT("a.off", "OFF\n4 1 0\n0 0 0\n3 0 0\n4 0 2\n0 0 1\n4 0 1 2 3\n", 2, two, 1, 2, 3, 1, 3, 0);
    CUT("a.off", "OFF\n4 1 0\n0 0 0\n0 3 0\n0 4 2\n0 0 1\n4 0 1 2 3\n", 2, two, 1, 2, 3, 1, 3, 0);
    /* a corner named twice in a row is one corner; a triangle is left as it is */
    CUT("a.off", "OFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 2\n", 1, NULL, 0, 1, 2);
    CUT("a.off", "OFF\n4 1 0\n" SQUARE_BODY "5 0 1 1 2 0\n", 1, NULL, 0, 1, 2);
    CUT("a.off", "OFF\n4 1 0\n" SQUARE_BODY "3 0 1 1\n", 1, NULL, 0, 1, 1);
    CUT("a.off", "OFF\n4 1 0\n" SQUARE_BODY "4 3 3 3 3\n", 1, NULL, 3, 3, 3);
}

/* Convex faces with more corners are fans from the lowest vertex. */
static void test_polygons(void **state)
{
    (void)state;
    static const uint32_t three[] = {0, 0, 0}, two[] = {0, 0};
    CUT("a.off", "OFF\n5 1 0\n2 2 0\n0 2 0\n-1 1 0\n0 0 0\n2 0 0\n5 2 3 4 0 1\n", 3, three, 0, 1, 2,
        0, 2, 3, 0, 3, 4);
    /* from vertex 0, the triangle 0 1 2 would be flat */
    CUT("a.off", "OFF\n5 1 0\n0 0 0\n1 0 0\n2 0 0\n2 2 0\n0 2 0\n5 0 1 2 3 4\n", 3, three, 1, 2, 3,
        1, 3, 4, 1, 4, 0);
    /* what has no area has flat triangles, which the check of the mesh names */
    CUT("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 3 2 1 0\n", 2, two, 0, 3, 2, 0, 2, 1);
}

/* Faces that are not convex are refused, with their number and their line. */
static void test_concave(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *message;
    } cases[] = {
        {"a.off", "OFF\n4 1 0\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 0 1 2 3\n",
         "a.off:7: face 0 with 4 corners is not convex; cut it into convex faces"},
        {"a.obj", "f 1 2 4\nf 1 2 3 4\nv 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\n",
         "a.obj:2: face 2 with 4 corners is not convex; cut it into convex faces"},
        /* the corner that turns the other way comes first, second, last */
        {"a.off", "OFF\n4 1 0\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 2 3 0 1\n", "is not convex"},
        {"a.off", "OFF\n4 1 0\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 1 2 3 0\n", "is not convex"},
        {"a.off", "OFF\n4 1 0\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 3 0 1 2\n", "is not convex"},
        /* crossing itself; a star that turns left only; a face that goes back on itself */
        {"a.off", "OFF\n4 1 0\n0 0 0\n4 4 0\n4 0 0\n0 4 0\n4 0 1 2 3\n", "is not convex"},
        {"a.off", "OFF\n5 1 0\n0 3 0\n-2 -3 0\n3 1 0\n-3 1 0\n2 -3 0\n5 0 1 2 3 4\n",
         "is not convex"},
        {"a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 0 2\n", "is not convex"},
        /* a bay hidden by two corners at each place */
        {"a.off",
         "OFF\n8 1 0\n4 0 0\n4 0 0\n1 1 0\n1 1 0\n0 4 0\n0 4 0\n0 0 0\n0 0 0\n8 0 1 2 3 4 5 6 7\n",
         "is not convex"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mw_mesh_file file;
        mw_error error;
        files_write_text(cases[i].name, cases[i].text);
        assert_int_equal(mw_read_mesh(cases[i].name, NULL, &file, &error), MW_ERROR_INPUT);
        if (!strstr(error.message, cases[i].message)) fail_msg("%s", error.message);
        files_clear();
    }
}

/* Strips of triangles: every second one turned, -1 between strips, corners repeated to join them.
 */
static void test_ply_strips(void **state)
{
    (void)state;
    mw_mesh_file file = mesh_file_read_text(
        "a.ply", "ply\nformat ascii 1.0\nelement vertex 6\n" PLY_XYZ "element tristrips 2\n"
                 "property list int int vertex_indices\nend_header\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n"
                 "0 0 0\n0 0 0\n9 0 1 2 3 -1 3 4 5 -1\n6 0 1 2 2 3 4\n");
    mesh_file_expect_triangles(&file, 6, 5,
                               (const uint32_t[]){0, 1, 2, 2, 1, 3, 3, 4, 5, 0, 1, 2, 3, 2, 4});
    mw_mesh_file_release(&file);
}

/* Every type in both byte orders; the same values all over. */
static void test_ply_binary(void **state)
{
    (void)state;
    static const char *const types[] = {"char", "uchar", "short",  "ushort", "int",
                                        "uint", "int64", "uint64", "float",  "double"};
    static const size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    const bool here_big = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
    for (int big = 0; big < 2; big++) {
        char file_bytes[2048];
        size_t n =
            (size_t)sprintf(file_bytes, "ply\nformat binary_%s_endian 1.0\nelement vertex 3\n",
                            big ? "big" : "little");
        for (int k = 0; k < 10; k++)
            n += (size_t)sprintf(file_bytes + n, "property %s p%d\n", types[k], k);
        n += (size_t)sprintf(file_bytes + n,
                             "property float x\nproperty double y\nelement face 1\n"
                             "property list ushort short vertex_indices\nend_header\n");
#define PUT(type, value)                                                                           \
    do {                                                                                           \
        type put_ = (type)(value);                                                                 \
        unsigned char raw_[8];                                                                     \
        memcpy(raw_, &put_, sizeof put_);                                                          \
        for (size_t b_ = 0; b_ < sizeof put_; b_++)                                                \
            file_bytes[n++] = (char)raw_[big != here_big ? sizeof put_ - 1 - b_ : b_];             \
    } while (0)
        for (int v = 0; v < 3; v++) {
            PUT(int8_t, -100 - v);
            PUT(uint8_t, 200 + v);
            PUT(int16_t, -30000 - v);
            PUT(uint16_t, 60000 + v);
            PUT(int32_t, -2000000000 - v);
            PUT(uint32_t, 4000000000u + (unsigned)v);
            PUT(int64_t, -5000000000 - v);
            PUT(uint64_t, 5000000000 + v);
            PUT(float, 0.5 + v);
            PUT(double, 0.1 + v);
            PUT(float, v);
            PUT(double, v *v);
        }
        PUT(uint16_t, 3);
        PUT(int16_t, 2);
        PUT(int16_t, 1);
        PUT(int16_t, 0);
#undef PUT
        mw_mesh_file file = mesh_file_read_bytes("a.ply", (bytes){file_bytes, n});
        mesh_file_expect_triangles(&file, 3, 1, (const uint32_t[]){2, 1, 0});
        assert_int_equal(file.field_count, 10);
        for (int v = 0; v < 3; v++) {
            const double wanted[] = {-100 - v,          200 + v,          -30000 - v, 60000 + v,
                                     -2000000000.0 - v, 4000000000.0 + v, -5e9 - v,   5e9 + v,
                                     0.5 + v,           0.1 + v};
            for (int k = 0; k < 10; k++) assert_true(file.fields[k][v] == wanted[k]);
            assert_true(file.points[3 * v] == v && file.points[3 * v + 1] == v * v &&
                        file.points[3 * v + 2] == 0);
        }
        mw_mesh_file_release(&file);
        /* cut anywhere, the file is refused */
        size_t header = n - 8 - 3 * (sizes[0] + sizes[1] + 2 + 2 + 4 + 4 + 8 + 8 + 4 + 8 + 4 + 8);
        for (size_t cut = 0; cut < n; cut++) {
            mw_error error;
            files_write("cut.ply", (bytes){file_bytes, cut});
            assert_int_equal(mw_read_mesh("cut.ply", NULL, &file, &error), MW_ERROR_INPUT);
            if (cut > header) files_expect_error(&error, MW_ERROR_INPUT, -1, "cut.ply: at byte ");
        }
    }
    files_clear();
}

static void test_ply_crlf_header(void **state)
{
    (void)state;
    static const char contents[] =
        "ply\r\nformat binary_little_endian 1.0\r\nelement vertex 1\r\nproperty uchar x\r\n"
        "property uchar y\r\nend_header\r\n\x0a\x0d";
    mw_mesh_file file = mesh_file_read_bytes("a.ply", BYTES(contents));
    mesh_file_expect_points(&file, (const double[]){10, 13, 0});
    mw_mesh_file_release(&file);
}

static void test_stl(void **state)
{
    (void)state;
    static const char text[] = "solid a name\n" STL_FACET("0 0 0", "1 0 0", "1 1 0.5")
        STL_FACET("-0.0 0 0", "1 1 .5", "0 1 0") "endsolid\n";
    expect_square("a.stl", text);
    expect_square("a.dat", text);
    mw_mesh_file file = mesh_file_read_text("a.stl", text);
    assert_int_equal(file.welded, 2);
    mw_mesh_file_release(&file);
    /* two solids, other letters, no name */
    file = mesh_file_read_text(
        "a.stl", "SOLID\n" STL_FACET("0 0 0", "1 0 0", "0 1 0") "ENDSOLID x\n\nsolid b\n" STL_FACET(
                     "0 0 1", "1 0 1", "0 1 1") "endsolid b\n");
    mesh_file_expect_triangles(&file, 6, 2, (const uint32_t[]){0, 1, 2, 3, 4, 5});
    mw_mesh_file_release(&file);
    char room[512];
    static const float corners[2][9] = {{0, 0, 0, 1, 0, 0, 1, 1, 0.5f},
                                        {-0.0f, 0, 0, 1, 1, 0.5f, 0, 1, 0}};
    static const char *const headers[] = {"made by hand", "solid although binary"};
    for (int h = 0; h < 2; h++) {
        file = mesh_file_read_bytes("b.stl", mesh_file_stl(room, headers[h], 2, corners, 2));
        mesh_file_expect_triangles(&file, 4, 2, square_triangles);
        mesh_file_expect_points(&file, square_points);
        assert_int_equal(file.welded, 2);
        mw_mesh_file_release(&file);
    }
    file = mesh_file_read_bytes("b.stl", mesh_file_stl(room, "", 0, corners, 0));
    mesh_file_expect_triangles(&file, 0, 0, NULL);
    mw_mesh_file_release(&file);
    /* NaN is no position that others share by accident, but reading it is no error */
    static const float odd[1][9] = {{NAN, 0, 0, 1, INFINITY, 0, 1, 1, 0}};
    file = mesh_file_read_bytes("b.stl", mesh_file_stl(room, "", 1, odd, 1));
    assert_int_equal(file.point_count, 3);
    mw_mesh_file_release(&file);
}

static void read_pair(const char *node, const char *ele, const char *path, mw_mesh_file *file)
{
    files_write_text("p.node", node);
    files_write_text("p.ele", ele);
    *file = mesh_file_read(path);
    assert_false(file->welded);
}

static void test_node_ele(void **state)
{
    (void)state;
    mw_mesh_file file;
    static const char zero[] = "4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n",
                      triangles[] = "2 3 0\n0 0 1 2\n1 0 2 3\n";
    static const char *const names[] = {"p.node", "p.ele", "p"};
    for (int i = 0; i < 3; i++) {
        read_pair(zero, triangles, names[i], &file);
        mesh_file_expect_triangles(&file, 4, 2, square_triangles);
        assert_false(file.has_z);
        mw_mesh_file_release(&file);
    }
    /* from 1, attributes, markers, comments, CRLF, a header that says less, six corners,
     * attributes of triangles */
    read_pair("# a comment\r\n4  2  2  1 # counts\r\n 1  0 0  10 0.5  1\r\n\r\n2 1 0 11 nan 1 # "
              "two\r\n3 1 1 12 -1e5 "
              "0\r\n4 0 1 13 0 1\r\n# end",
              "2 6 1\n1 1 2 3 1 2 3 7.5\n2 1 3 4 1 1 1 8\n", "p", &file);
    mesh_file_expect_triangles(&file, 4, 2, square_triangles);
    assert_int_equal(file.field_count, 2);
    assert_string_equal(file.field_names[0], "attribute1");
    assert_string_equal(file.field_names[1], "attribute2");
    assert_true(file.fields[0][0] == 10 && file.fields[0][3] == 13 && isnan(file.fields[1][1]));
    mw_mesh_file_release(&file);
    read_pair("4\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n", "2\n1 0 1 2\n2 0 2 3\n", "p", &file);
    mesh_file_expect_triangles(&file, 4, 2, square_triangles);
    mw_mesh_file_release(&file);
    read_pair("4 3 0 0\n0 0 0 0\n1 1 0 0\n2 1 1 .5\n3 0 1 0\n", triangles, "p", &file);
    mesh_file_expect_points(&file, square_points);
    assert_true(file.has_z);
    mw_mesh_file_release(&file);
    read_pair("# attributes: depth , z\n4 2 2\n0 0 0 7 0\n1 1 0 7 0\n2 1 1 7 .5\n3 0 1 8 0\n",
              triangles, "p", &file);
    mesh_file_expect_points(&file, square_points);
    assert_int_equal(file.field_count, 1);
    assert_string_equal(file.field_names[0], "depth");
    assert_true(file.fields[0][3] == 8);
    mw_mesh_file_release(&file);
    files_clear();
    /* packed: both, or one of them */
    files_write_gzip("q.node.gz", BYTES(zero));
    files_write_gzip("q.ele.gz", BYTES(triangles));
    static const char *const packed[] = {"q.node.gz", "q.ele.gz", "q"};
    for (int i = 0; i < 3; i++) {
        file = mesh_file_read(packed[i]);
        mesh_file_expect_triangles(&file, 4, 2, square_triangles);
        mw_mesh_file_release(&file);
    }
    unlink("q.ele.gz");
    files_write_text("q.ele", triangles);
    file = mesh_file_read("q.ele");
    mw_mesh_file_release(&file);
    unlink("q.ele");
    mw_error error;
    assert_int_equal(mw_read_mesh("q.node.gz", NULL, &file, &error), MW_ERROR_SYSTEM);
    files_expect_error(&error, MW_ERROR_SYSTEM, -1, "q.ele: No such file or directory");
    files_clear();
}

/* Lines with all three kinds of ends, across the borders of blocks. */
static void test_line_ends(void **state)
{
    (void)state;
    static const char *const ends[] = {"\n", "\r\n", "\r"};
    for (int e = 0; e < 3; e++) {
        FILE *out = fopen("lines.off", "wb");
        assert_non_null(out);
        fprintf(out, "OFF%s60000 0 0%s", ends[e], ends[e]);
        for (int i = 0; i < 60000; i++) fprintf(out, "%d 0 %d%s", i, i % 7, ends[e]);
        fclose(out);
        mw_mesh_file file = mesh_file_read("lines.off");
        assert_int_equal(file.point_count, 60000);
        for (size_t i = 0; i < 60000; i++)
            if (file.points[3 * i] != (double)i || file.points[3 * i + 2] != (double)(i % 7))
                fail_msg("vertex %zu", i);
        mw_mesh_file_release(&file);
    }
    files_clear();
}

static void test_standard_input(void **state)
{
    (void)state;
    files_write_text("in.off", "OFF\n4 1 0\n" SQUARE_BODY "4 0 1 2 3\n");
    int saved = dup(STDIN_FILENO);
    assert_non_null(freopen("in.off", "r", stdin));
    mw_mesh_file file = mesh_file_read("-");
    mesh_file_expect_triangles(&file, 4, 2, square_triangles);
    mw_mesh_file_release(&file);
    files_write_text("in.off", "OFF\n4 1 0\n0 0\n");
    assert_non_null(freopen("in.off", "r", stdin));
    mw_error error;
    assert_int_equal(mw_read_mesh("-", NULL, &file, &error), MW_ERROR_INPUT);
    files_expect_error(&error, MW_ERROR_INPUT, 3, "standard input:3: ");
    if (saved >= 0) dup2(saved, STDIN_FILENO);
    close(saved);
    files_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_off),
        cmocka_unit_test(test_obj),
        cmocka_unit_test(test_ply_ascii),
        cmocka_unit_test(test_quadrilaterals),
        cmocka_unit_test(test_polygons),
        cmocka_unit_test(test_concave),
        cmocka_unit_test(test_ply_strips),
        cmocka_unit_test(test_ply_binary),
        cmocka_unit_test(test_ply_crlf_header),
        cmocka_unit_test(test_stl),
        cmocka_unit_test(test_node_ele),
        cmocka_unit_test(test_line_ends),
        cmocka_unit_test(test_standard_input),
    };
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
