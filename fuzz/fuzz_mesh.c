/* Meshes from any bytes, held against brute force: the check, the mesh, its description and its
 * tiling.
 *
 * Byte 0: kind of index, stride, whether some coordinates are not finite; byte 1: exponent of all
 * coordinates; byte 2: number of points. Then two bytes a point, three a triangle: numbers of
 * vertices, one or two of them out of range. */
#include "oracle/domain_oracle.h"
#include "support/meshes.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include "tiling/tiling_create.h"

#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MAX_POINTS = 32, MAX_TRIANGLES = 24, MAX_STRIDE = 4 };

typedef struct input {
    /* with small integers, which stand for the coordinates at the end of the range if those are
     * not finite */
    arrays a;
    double points[MAX_POINTS * MAX_STRIDE];
    int32_t int32[3 * MAX_TRIANGLES];
    int64_t int64[3 * MAX_TRIANGLES];
    mw_arrays view;
    bool finite, in_range; /* of the vertices that triangles use; of the numbers */
} input;

static void require(bool right)
{
    if (!right) abort();
}

static double coordinate(uint8_t byte, bool special)
{
    if (special && byte == 127) return NAN;
    if (special && byte == 128) return INFINITY;
    return ldexp((int8_t)byte, domain_oracle_exponent);
}

static void read_points(input *in, const uint8_t *data, size_t count, size_t stride, bool special)
{
    for (size_t i = 0; i < count; i++) {
        arrays_point(&in->a, (int8_t)data[2 * i], (int8_t)data[2 * i + 1]);
        for (size_t k = 0; k < 2; k++)
            in->points[i * stride + k] = coordinate(data[2 * i + k], special);
    }
    in->view.points = in->points;
    in->view.point_count = count;
    in->view.point_stride = stride;
}

static void read_triangles(input *in, const uint8_t *data, size_t count)
{
    in->in_range = in->finite = true;
    for (size_t i = 0; i < 3 * count; i++) {
        uint32_t v = data[i] % (in->a.point_count + 2);
        in->a.triangles[i] = v;
        in->int32[i] = v > in->a.point_count ? -1 : (int32_t)v;
        in->int64[i] = v > in->a.point_count ? INT64_C(1) << 32 : (int64_t)v;
        if (v >= in->a.point_count) in->in_range = false;
        for (size_t k = 0; k < 2 && v < in->a.point_count; k++)
            in->finite &= isfinite(in->points[v * in->view.point_stride + k]);
    }
    in->a.triangle_count = (uint32_t)count;
    in->view.triangle_count = count;
}

/* Returns false if the bytes are too few. */
static bool read_input(input *in, const uint8_t *data, size_t size)
{
    static const int exponents[] = {0, 0, 0, 0, -1074, -600, 900, 1016};
    if (size < 3) return false;
    size_t count = data[2] % (MAX_POINTS + 1), stride = 2 + (data[0] >> 2) % 3;
    if (size < 3 + 2 * count) return false;
    domain_oracle_exponent = exponents[data[1] % 8];
    in->a = arrays_make(MAX_POINTS, MAX_TRIANGLES);
    read_points(in, data + 3, count, stride, data[0] >> 5 & 1);
    size_t triangles = (size - 3 - 2 * count) / 3;
    read_triangles(in, data + 3 + 2 * count, triangles < MAX_TRIANGLES ? triangles : MAX_TRIANGLES);
    in->view.integer_type = (mw_integer_type)(data[0] % 3);
    const void *indices[] = {in->a.triangles, in->int32, in->int64};
    in->view.triangles = indices[in->view.integer_type];
    return true;
}

/* Returns whether the check takes it for an embedding; *usable: whether a mesh can be made of it.
 * */
static bool try_check(const input *in, bool *usable)
{
    mw_check check;
    require(mw_check_arrays(&in->view, NULL, &check, NULL) == MW_OK);
    bool embedding = check.valid, sound = true;
    *usable = true;
    for (size_t i = 0; i < check.defect_count; i++) {
        const mw_defect *d = &check.defects[i];
        char text[200];
        mw_defect_describe(d, text, sizeof text);
        require(d->kind < MW_DEFECT_COUNT && d->triangle < in->a.triangle_count);
        require(i == 0 || d->kind >= check.defects[i - 1].kind);
        if (d->kind != MW_DEFECT_FLAT) sound = false;
        if (d->kind <= MW_DEFECT_NON_MANIFOLD_EDGE) *usable = false;
    }
    mw_check_release(&check);
    require(embedding == sound);
    require(*usable == (in->in_range && in->finite && domain_oracle_is_usable(&in->a)));
    if (*usable) require(embedding == domain_oracle_is_embedding(&in->a));
    return embedding;
}

static void try_tiling(const input *in, const mw_mesh *mesh, bool embedding)
{
    mw_tiling tiling;
    mw_error error = {0};
    mw_status status = mw__tiling_create(mesh, (mw_tiling_options){0}, MW_ALONE, &tiling, &error);
    require(embedding ? status == MW_OK : status == MW_ERROR_INPUT && error.message[0] != 0);
    if (status == MW_OK) mw__tiling_release(&tiling);
    require(mw__tiling_create(mesh, (mw_tiling_options){.any = true}, MW_ALONE, &tiling, &error) ==
                MW_OK &&
            tiling.embedding == embedding);
    require(!embedding || domain_oracle_fault(&in->a, &tiling) == NULL);
    mw__tiling_release(&tiling);
}

static void try_mesh(const input *in, bool tolerant, mw_mesh_layout layout, bool expected,
                     bool embedding)
{
    mw_mesh *mesh;
    mw_mesh_options options = {.tolerant = tolerant, .layout = layout, .threads = 1};
    mw_mesh_info info;
    mw_error error = {0};
    mw_status status = mw_mesh_create(&in->view, &options, &mesh, &error);
    require(status == (expected ? MW_OK : MW_ERROR_INPUT));
    if (!mesh) return;
    require(mw_mesh_describe(mesh, NULL, &info, &error) == MW_OK && info.embedding == embedding);
    require(info.components <= info.vertices && info.border_loops <= info.border_edges);
    try_tiling(in, mesh, embedding);
    mw_mesh_destroy(mesh);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = {0};
    if (read_input(&in, data, size)) {
        bool usable, embedding = try_check(&in, &usable);
        try_mesh(&in, false, MW_LAYOUT_HILBERT, usable, embedding);
        try_mesh(&in, false, MW_LAYOUT_AS_GIVEN, usable, embedding);
        try_mesh(&in, true, MW_LAYOUT_AUTO, in.in_range, embedding);
        arrays_free(&in.a);
    }
    return 0;
}
