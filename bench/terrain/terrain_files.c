#include "bench/terrain/terrain_files.h"
#include "bench/data/dataset.h"
#include "cli/frame/message.h"

#include <dirent.h>
#include <math.h>
#include <meshwalk/meshwalk.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WAVES = 12 };

double terrain_height(double x, double y)
{
    double z = 0, length = TERRAIN_SIDE;
    for (int k = 0; k < WAVES; k++, length /= 1.4) {
        double angle = 2.4 * k, along = x * cos(angle) + y * sin(angle);
        z += length / 10 * sin(8 * atan(1) * along / length + k);
    }
    return z;
}

/* --- the folder ------------------------------------------------------------------------------- */

int terrain_folder_make(char *folder, size_t size)
{
    const char *parent = getenv("TMPDIR");
    int length = snprintf(folder, size, "%s/meshwalk_bench_XXXXXX", parent ? parent : "/tmp");
    if (length < (int)size && mkdtemp(folder)) return 0;
    complain("%s: no folder can be made here", folder);
    *folder = 0;
    return END_RESOURCE;
}

void terrain_folder_remove(const char *folder)
{
    DIR *all = *folder ? opendir(folder) : NULL;
    char name[4096];
    for (struct dirent *entry; all && (entry = readdir(all));)
        if (snprintf(name, sizeof name, "%s/%s", folder, entry->d_name) < (int)sizeof name)
            unlink(name);
    if (all) closedir(all);
    if (*folder) rmdir(folder);
}

static FILE *terrain_open(const char *folder, const char *file)
{
    char name[4096];
    snprintf(name, sizeof name, "%s/%s", folder, file);
    FILE *out = fopen(name, "wb");
    if (!out) complain("%s: cannot be written", name);
    return out;
}

static int terrain_close(FILE *out, const char *file)
{
    bool failed = ferror(out) != 0;
    if (fclose(out) == 0 && !failed) return 0;
    complain("%s: cannot be written", file);
    return END_RESOURCE;
}

/* --- points and their triangulation ----------------------------------------------------------- */

static int terrain_write_points(const char *folder, const double *xyz, size_t count)
{
    FILE *binary = terrain_open(folder, "points.bin"), *table = terrain_open(folder, "points.csv"),
         *vrt = terrain_open(folder, "points.vrt");
    int end = binary && table && vrt ? 0 : END_RESOURCE;
    if (end == 0) {
        fwrite(xyz, 3 * sizeof *xyz, count, binary);
        fputs("x,y,z\n", table);
        for (size_t i = 0; i < count; i++)
            fprintf(table, "%.17g,%.17g,%.17g\n", xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
        fputs("<OGRVRTDataSource><OGRVRTLayer name=\"points\"><SrcDataSource relativeToVRT=\"1\">"
              "points.csv</SrcDataSource><GeometryType>wkbPoint25D</GeometryType><GeometryField "
              "encoding=\"PointFromColumns\" x=\"x\" y=\"y\" z=\"z\"/></OGRVRTLayer>"
              "</OGRVRTDataSource>\n",
              vrt);
    }
    FILE *const all[] = {binary, table, vrt};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        int closed = all[i] ? terrain_close(all[i], "points") : 0;
        if (end == 0) end = closed;
    }
    return end;
}

static int terrain_write_prepared(const char *folder, const mw_mesh *mesh, const mw_mesh_file *file)
{
    mw_error error;
    mw_locator *locator;
    char name[4096];
    const mw_prepare_options options = {.values = file};
    snprintf(name, sizeof name, "%s/tin.mwm", folder);
    if (mw_locator_create(mesh, NULL, &locator, &error) != MW_OK) return fail_query(&error);
    mw_status status = mw_write_prepared(locator, name, &options, &error);
    mw_locator_destroy(locator);
    return status == MW_OK ? 0 : fail_writing(&error);
}

static int terrain_write_mesh(const char *folder, const mw_mesh *mesh, double *xyz)
{
    mw_error error;
    char name[4096];
    mw_mesh_file file = {.points = xyz,
                         .point_count = mw_mesh_vertex_count(mesh),
                         .has_z = 1,
                         .triangle_count = mw_mesh_triangle_count(mesh)};
    file.triangles = malloc(3 * (size_t)file.triangle_count * sizeof *file.triangles);
    if (!file.triangles) return fail_memory();
    for (uint32_t t = 0; t < file.triangle_count; t++)
        mw_mesh_triangle(mesh, t, file.triangles + (size_t)3 * t);
    snprintf(name, sizeof name, "%s/tin.ply", folder);
    mw_status status = mw_write_mesh(name, &file, NULL, NULL, &error);
    int end = status == MW_OK ? 0 : fail_writing(&error);
    if (end == 0) end = terrain_write_prepared(folder, mesh, &file);
    free(file.triangles);
    return end;
}

int terrain_write_tin(const char *folder, size_t vertices, uint64_t seed, size_t *triangles)
{
    dataset set;
    mw_mesh *mesh = NULL;
    mw_error error;
    if (!dataset_make(&set, DATASET_UNIFORM, vertices, true, seed)) return fail_memory();
    double *xyz = malloc(3 * vertices * sizeof *xyz);
    int end = xyz ? 0 : fail_memory();
    for (size_t i = 0; end == 0 && i < vertices; i++) {
        double *p = xyz + 3 * i;
        for (int k = 0; k < 2; k++) p[k] = set.points[2 * i + (size_t)k] * TERRAIN_SIDE;
        p[2] = terrain_height(p[0], p[1]);
    }
    dataset_release(&set);
    if (end == 0 && mw_delaunay(xyz, vertices, 3, NULL, NULL, NULL, &mesh, &error) != MW_OK)
        end = fail_query(&error);
    if (end == 0) end = terrain_write_mesh(folder, mesh, xyz);
    if (end == 0) end = terrain_write_points(folder, xyz, vertices);
    if (end == 0) *triangles = mw_mesh_triangle_count(mesh);
    mw_mesh_destroy(mesh);
    free(xyz);
    return end;
}

/* --- a raster --------------------------------------------------------------------------------- */

int terrain_write_raster(const char *folder, size_t side)
{
    const double size = TERRAIN_SIDE / (double)side;
    FILE *pixels = terrain_open(folder, "dem.img"), *header = terrain_open(folder, "dem.hdr");
    int end = pixels && header ? 0 : END_RESOURCE;
    for (size_t row = 0; end == 0 && row < side; row++)
        for (size_t column = 0; column < side; column++) {
            float z = (float)terrain_height(((double)column + 0.5) * size,
                                            TERRAIN_SIDE - ((double)row + 0.5) * size);
            fwrite(&z, sizeof z, 1, pixels);
        }
    if (end == 0)
        fprintf(header,
                "ENVI\nsamples = %zu\nlines = %zu\nbands = 1\nheader offset = 0\ndata type = 4\n"
                "interleave = bsq\nbyte order = 0\nmap info = {Arbitrary, 1, 1, 0, %.17g, %.17g, "
                "%.17g}\n",
                side, side, TERRAIN_SIDE, size, size);
    int closed[2] = {pixels ? terrain_close(pixels, "dem.img") : 0,
                     header ? terrain_close(header, "dem.hdr") : 0};
    for (int i = 0; i < 2; i++)
        if (end == 0) end = closed[i];
    return end;
}
