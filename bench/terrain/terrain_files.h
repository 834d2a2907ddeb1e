/* terrain_files.h - a made terrain in the files that programs read. */
#ifndef MW_BENCH_TERRAIN_TERRAIN_FILES_H
#define MW_BENCH_TERRAIN_TERRAIN_FILES_H

#include <stddef.h>
#include <stdint.h>

/* The terrain is TERRAIN_SIDE wide and high, with hills of all sizes down to a few hundredths of
 * it. */
#define TERRAIN_SIDE 1000.0

double terrain_height(double x, double y);

/* Make a new folder below $TMPDIR or /tmp. terrain_folder_remove also removes the files in it. The
 * functions below return 0, or an exit code after a complaint. */
int terrain_folder_make(char *folder, size_t size);
void terrain_folder_remove(const char *folder);

/* Uniform points and their Delaunay triangulation: tin.ply; points.bin, three doubles each;
 * points.csv, and points.vrt, with which GDAL reads it. */
int terrain_write_tin(const char *folder, size_t vertices, uint64_t seed, size_t *triangles);

/* A raster of so many pixels each way: float32 as ENVI has it, dem.img. */
int terrain_write_raster(const char *folder, size_t side);

#endif
