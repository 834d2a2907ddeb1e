/* test_io_shared.c - files of the world, where the shared data are present: the counts that others
 * counted. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include "support/files.h"

#include <math.h>
#include <stdio.h>

static const struct {
    const char *name;
    size_t points, triangles;
} meshes[] = {
    {"surface/pawn.obj", 154, 304},
    {"surface/triceratops.off.gz", 2832, 5660},
    {"surface/cow.off.gz", 2904, 5804},
    {"surface/fandisk.off.gz", 6475, 12946},
    {"surface/gargoyle.off.gz", 10002, 20000},
    {"surface/venus_remesh.off.gz", 8671, 17338},
    {"surface/mannequin.off.gz", 11703, 23402},
    {"surface/dinosaur.off.gz", 14050, 28096},
    {"surface/horse.off.gz", 19851, 39698},
    {"surface/skull.off.gz", 20002, 40000},
    {"surface/bunny_closed.off.gz", 34835, 69666},
    {"surface/bunny_zipper.ply.gz", 35947, 69451},
    {"surface/armadillo.off.gz", 26002, 52000},
    {"surface/venus_100k.off.gz", 50002, 100000},
    {"surface/igea.ply.gz", 134345, 268686},
    {"surface/lucy_low.ply.gz", 49987, 99970},
    {"surface/elephant.off.gz", 2775, 5558},
    {"surface/anchor_dense.off.gz", 3793, 7598},
    {"surface/turbine.off.gz", 9210, 18460},
    {"surface/cheese.off.gz", 8629, 17786},
    {"surface/knot2.off.gz", 5760, 11520},
    {"surface/bones.off.gz", 2154, 4204},
    {"surface/lion_head.off.gz", 8356, 16674},
    {"surface/shark_holes.off.gz", 5246, 10192},
    {"surface/plate_holes.stl", 618, 1252},
    {"surface/rabbit.obj", 644, 1252},
    {"star/eros_7790.obj.gz", 3897, 7790},
    {"star/psyche.obj", 1148, 2292},
    {"star/kw4_alpha.obj.gz", 4586, 9168},
    {"star/sphere_1620.off", 812, 1620},
    {"star/geosphere.off", 162, 320},
    {"star/ellipsoid.off", 162, 320},
    {"star/star.off", 14, 24},
    {"star/tripod.off", 24, 44},
    {"star/sphere_1280.obj", 642, 1280},
    {"star/brain_pial_left.off.gz", 10242, 20480},
    {"star/brain_sphere_left.off.gz", 10242, 20480},
    {"terrain/mountain.obj.gz", 25600, 50562},
    {"terrain/terrain.stl.gz", 1813, 3498},
    {"domain/greenland.node.gz", 33343, 64125},
    {"domain/greenland.ele.gz", 33343, 64125},
    {"domain/greenland", 33343, 64125},
    {"ocean/malpasset.node.gz", 13541, 26000},
    {"bad/blobby_shuffled.off.gz", 2027, 4050},
    {"bad/boeing.off", 2741, 2564},
    {"bad/comments.off", 8, 12},
    {"bad/degtri_sliding.off", 8, 8},
    {"bad/gargoyle_scan.off.gz", 21001, 40348},
    {"bad/polygon_mesh.off.gz", 16344, 32245},
    {"bad/tet_shuffled.off", 4, 4},
    {"bad/tetra_intersected_by_triangle.off", 7, 5},
    {"bad/fan3.obj", 5, 3},
    {"bad/hourglass_ico.obj", 23, 40},
    {"bad/joined_tetrahedra.obj", 5, 8},
    {"bad/moebius.obj", 280, 448},
    {"bad/nancolor.obj", 8, 12},
    {"bad/negative_indices.obj", 8, 12},
    {"bad/pawn_nan.obj", 154, 304},
    {"bad/point_cloud.obj", 3, 0},
    {"bad/brain_pieces.ply.gz", 18844, 36752},
    {"bad/crlf_header.ply", 8, 12},
    {"bad/non_manif_hole.ply", 432, 755},
    {"bad/points_emptyface.ply", 1024, 0},
    {"bad/busted.stl.gz", 1941, 3878},
    {"bad/empty.stl", 0, 0},
    {"bad/soup.stl", 300, 100},
    {"bad/mesh_with_numbering_gaps.2dm", 5, 3},
    {"bad/unordered_ids.2dm", 5, 3},
    {"cad/circle_in_square.msh", 133, 232},
    {"cad/hole8170_v40.msh.gz", 8449, 16340},
    {"cad/naca0012.su2.gz", 5233, 10216},
    {"cad/naca64a010_hybrid.su2.gz", 6532, 12897},
    {"cad/square_binary.msh", 4, 2},
    {"cad/square_disc.vtk", 101, 154},
    {"cad/stator.su2.gz", 17447, 34388},
    {"cad/t1.msh", 428, 774},
    {"cad/t11_triangles.vtu", 682, 1321},
    {"cad/t1_binary.msh", 428, 774},
    {"ocean/3slopes.2dm.gz", 11261, 21030},
    {"ocean/alaska.14.gz", 15876, 27757},
    {"ocean/bay_delta_coarse.gr3.gz", 9220, 14263},
    {"ocean/double_le.slf.gz", 17830, 35093},
    {"ocean/headland_44k.msh.gz", 22083, 43998},
    {"ocean/hydraul_006.2dm.gz", 1419, 2535},
    {"ocean/malpasset.slf.gz", 13541, 26000},
    {"ocean/north_sea.msh.gz", 6565, 10920},
    {"ocean/overflow.14.gz", 2716, 4978},
    {"ocean/schism_triquad.ll", 112, 168},
    {"ocean/shinnecock.14.gz", 3070, 5780},
    {"ocean/tidal_flats.slf.gz", 648, 1030},
    {"tet/hand.msh.gz", 7234, 9556},
};

static void test_meshes(void **state)
{
    (void)state;
    if (!files_shared("README.md")) skip();
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        mw_mesh_file file;
        mw_error error;
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", MW_TEST_SHARED, meshes[i].name);
        if (mw_read_mesh(path, NULL, &file, &error) != MW_OK) fail_msg("%s", error.message);
        if (file.point_count != meshes[i].points || file.triangle_count != meshes[i].triangles)
            fail_msg("%s: %zu vertices, %zu triangles", path, file.point_count,
                     file.triangle_count);
        for (size_t k = 0; k < 3 * file.triangle_count; k++)
            assert_true(file.triangles[k] < file.point_count);
        mw_mesh_file_release(&file);
    }
}

static const struct {
    const char *name, *says;
    int64_t line;
} refused[] = {
    {"bad/cow_truncated.off", "a face announces 3 corners, but has 1", 5277},
    {"bad/invalid.off", "a face has 0 corners", 6},
    {"bad/out_of_memory.off", "ends after 14 of 353535235358 vertices", 16},
    {"bad/box_longline.obj", "face 1 with 936 corners is not convex", 24},
    {"bad/wallhole.obj", "face 2 with 11 corners is not convex", 283},
    {"bad/malformed.obj", "'0' is not a vertex number", 28},
    {"bad/not_enough_indices.obj", "a face has 2 corners", 9},
    {"bad/crash.ply", "NUL byte", 7},
    {"bad/issue623.ply", "ends before its last value", 14},
    {"bad/payload.ply", "the format has to be", 2},
    {"bad/not_a_mesh_file.2dm", "a 2DM file begins with MESH2D", 1},
    {"cad/impeller.vtk.gz", "face 327 with 4 corners is not convex", 8351},
    {"bad/mobius_strip.mesh", "not a mesh in a known format", -1},
    {"tet/box.node", "the elements have 4 corners", 1},
    {"terrain/volcano.asc", "not a mesh in a known format", -1},
    {"terrain/1.2-with-color.las", "not a mesh in a known format", -1},
};

static void test_refused(void **state)
{
    (void)state;
    if (!files_shared("README.md")) skip();
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        mw_mesh_file file;
        mw_error error;
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", MW_TEST_SHARED, refused[i].name);
        assert_int_equal(mw_read_mesh(path, NULL, &file, &error), MW_ERROR_INPUT);
        files_expect_error(&error, MW_ERROR_INPUT, refused[i].line, refused[i].says);
    }
}

/* Points, and the corner and the extent that the list of the data, or the header of the file,
 * gives. */
static const struct {
    const char *name;
    size_t count, width;
    double low[2], extent[2], tolerance;
} clouds[] = {
    {"terrain/autzen_ground.xyz.gz", 26107, 3, {636001.8, 848935.8}, {1177.46, 562.05}, 0.06},
    {"terrain/topography_ground.xyz.gz", 12056, 3, {273357.2, 5274357}, {285.677, 285.679}, 0.8},
    {"terrain/delft_ground.xyz.gz", 196255, 3, {84808.3, 447412.8}, {191.697, 228.498}, 0.06},
    {"terrain/crop_4_6_ground.xyz.gz", 9003, 3, {1639600, 1454500}, {199.97, 199.98}, 0.06},
    {"terrain/no2_stations.xyz", 74, 3, {6.195867, 47.51801}, {8.55386, 7.40696}, 0.00001},
    {"terrain/1.2-with-color.las", 1065, 3, {635619.85, 848899.7}, {3362.7, 4635.73}, 1e-6},
    {"bad/bad_vlr_count.las", 10, 3, {289814.15, 4320978.61}, {4.35, 1.98}, 1e-6},
    {"ocean/windvectors.csv.gz", 4800, 5, {0.125, 45.125}, {0, 0}, 1e9},
    {"domain/greenland.node.gz", 33343, 2, {0, 0}, {0, 0}, 1e9},
};

static void test_clouds(void **state)
{
    (void)state;
    if (!files_shared("README.md")) skip();
    for (size_t i = 0; i < sizeof clouds / sizeof *clouds; i++) {
        mw_point_reader *reader;
        mw_error error;
        char path[1024];
        double values[8 * 1000], low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
        size_t count, total = 0;
        snprintf(path, sizeof path, "%s/%s", MW_TEST_SHARED, clouds[i].name);
        if (mw_point_reader_open(path, NULL, &reader, &error) != MW_OK)
            fail_msg("%s", error.message);
        size_t width = mw_point_reader_width(reader);
        assert_int_equal(width, clouds[i].width);
        do {
            if (mw_point_reader_read(reader, values, 1000, &count, &error) != MW_OK)
                fail_msg("%s", error.message);
            for (size_t k = 0; k < 2 * count; k++) {
                double v = values[k / 2 * width + k % 2];
                low[k % 2] = fmin(low[k % 2], v);
                high[k % 2] = fmax(high[k % 2], v);
            }
            total += count;
        } while (count > 0);
        mw_point_reader_close(reader);
        assert_int_equal(total, clouds[i].count);
        for (int k = 0; k < 2; k++)
            if (fabs(low[k] - clouds[i].low[k]) > clouds[i].tolerance ||
                fabs(high[k] - low[k] - clouds[i].extent[k]) > clouds[i].tolerance)
                fail_msg("%s: from %.10g, extent %.10g", path, low[k], high[k] - low[k]);
    }
}

/* Ground points only: what the classes of the sample say when its points are counted one by one. */
static void test_ground(void **state)
{
    (void)state;
    const char *path = files_shared("terrain/1.2-with-color.las");
    if (!path) skip();
    mw_point_reader_options options = {.columns = "classification,x"};
    mw_point_reader *reader;
    double values[2 * 2000];
    size_t count, ground = 0;
    assert_int_equal(mw_point_reader_open(path, &options, &reader, NULL), MW_OK);
    assert_int_equal(mw_point_reader_read(reader, values, 2000, &count, NULL), MW_OK);
    assert_int_equal(count, 1065);
    for (size_t i = 0; i < count; i++) ground += values[2 * i] == 2;
    mw_point_reader_close(reader);
    assert_true(ground > 0 && ground < count);
    options.classes[2] = 1;
    assert_int_equal(mw_point_reader_open(path, &options, &reader, NULL), MW_OK);
    assert_int_equal(mw_point_reader_read(reader, values, 2000, &count, NULL), MW_OK);
    assert_int_equal(count, ground);
    mw_point_reader_close(reader);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_meshes), cmocka_unit_test(test_refused),
        cmocka_unit_test(test_clouds), cmocka_unit_test(test_ground)};
    return cmocka_run_group_tests(tests, files_enter, files_leave);
}
