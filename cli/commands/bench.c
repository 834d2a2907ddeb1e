/* bench - measurements that anybody can repeat. They stand in bench/. */
#include "bench/bench.h"
#include "cli/commands/commands.h"

static int bench_command_run(const void *settings, const char *const *operands)
{
    return bench_run(settings, operands[0], operands[1]);
}

static const option *const bench_command_options[] = {bench_options, common_options, NULL};

const command bench_command = {
    .name = "bench",
    .operands = "WHAT [TABLE]",
    .operand_count = 2,
    .optional_operands = 1,
    .summary = "measure the walks, beside published figures and other libraries",
    .description = "'meshwalk bench paper TABLE' makes the sets of points of a published table, "
                   "triangulates them, counts and "
                   "times what the walks do, and prints each figure beside the published one and "
                   "their ratio. TABLE is one of "
                   "A1, A2, B1, B2, C1, C2, D1, E1, E2, F1, F2, G1, G2 and G3, after the appendix "
                   "of the thesis. D1, with Fig. 11 "
                   "and 12 of its appendix, is about meshes with pockets and holes, F1 and F2 are "
                   "about star-shaped polyhedra, "
                   "G1 to G3 about probes of a surface: their sets are meshes, and so are their "
                   "--data. E1 is about "
                   "kinds of triangulation. E2 is also Fig. 12 of its appendix. Counts are taken "
                   "over all queries, on all "
                   "threads; times are medians over 5 rounds of single queries on one thread, in "
                   "plain doubles (time_us) and "
                   "exact (time_exact_us).\n\n"
                   "'meshwalk bench near-vertices [SET]' locates points within 1e-15 of vertices, "
                   "or one of the next doubles, in "
                   "five meshes: uniform, grid, rings, slivers, offset, or in one of them. It "
                   "prints for every walk and "
                   "arithmetic how many of a million queries ran out of steps (cycles), and how "
                   "many the celestial walk had to "
                   "end (hand-overs).\n\n"
                   "'meshwalk bench peers [SET]' measures point location beside other libraries: "
                   "CGAL, Embree, GEOS, Boost, SciPy "
                   "and "
                   "matplotlib, where the program was built with them. In one run all engines take "
                   "turns, and all answers are "
                   "compared "
                   "with the exact one. 'meshwalk bench scale [SET]' measures from ten thousand "
                   "vertices to a hundred million. "
                   "SET is "
                   "one of uniform, grid, gaussian, clusters, arcs, rectangle, rings, slivers, "
                   "offset, cadastre and lidar, or "
                   "several of them with "
                   "commas between.\n\n"
                   "'meshwalk bench scale --ranks LIST [SET]' times nothing: it cuts a mesh of "
                   "--sizes vertices among many ranks of MPI, sends --queries points where "
                   "libmeshwalk-mpi sends them, and prints how uneven the work is and how many "
                   "bytes travel.\n\n"
                   "'meshwalk bench edit [SET]' measures what changes of a mesh take, and location "
                   "between them, beside CGAL, and "
                   "beside trees that are built anew. Its tasks are insert, insert-sorted, "
                   "insert-many, insert-many-sorted, "
                   "remove, move-near, "
                   "move-far, mixed, "
                   "rebuild and session, its engines meshwalk, meshwalk-layers, meshwalk-grid, "
                   "cgal, cgal-hierarchy, and in "
                   "rebuild "
                   "meshwalk-anew, embree, geos and boost; the default is all of both. --queries "
                   "is how many edits are timed "
                   "(default: "
                   "50000, at most half of the vertices). SET is of uniform, clusters, gaussian, "
                   "arcs and rectangle.\n\n"
                   "'meshwalk bench ocean' measures how long a mesh in UGRID takes to open, "
                   "weights to be applied to the steps of a model, and particles to be "
                   "followed.\n\n"
                   "'meshwalk bench segments' measures the triangles along random segments, in "
                   "batches and one by one.\n\n"
                   "'meshwalk bench space [MODEL]' casts rays at surfaces in space, beside Embree, "
                   "CGAL's AABB tree and trimesh with embreex, and judges every answer exactly; "
                   "vertices move and all follow. MODEL is of icosahedron, bumps, star and knot, "
                   "--sizes their numbers of triangles.\n\n"
                   "'meshwalk bench terrain' measures rasters and contours of a TIN as whole "
                   "commands, beside gmt, gdal_grid and gdal_contour where they are installed. "
                   "--queries is the number of pixels (default: 10^8).\n\n"
                   "'meshwalk bench worst [TRAP]' measures meshes on which location, or making a "
                   "mesh, may be slow: strips whose steps shrink, fans and hubs, extents near the "
                   "ends of the doubles, points on vertices and edges. It prints seconds to "
                   "build, microseconds a query in a batch and alone, on one thread, the "
                   "triangles that a query visits, and bytes beside the mesh; then what other "
                   "libraries take in the same mesh, where the program was built with them, and "
                   "the share of their answers that is wrong. TRAP is a name of "
                   "its first column, or several with commas between.",
    .options = bench_command_options,
    .essential = "sizes queries data rounds format",
    .settings_size = sizeof(bench_settings),
    .run = bench_command_run,
};
