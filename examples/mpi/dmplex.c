/* dmplex.c - an adapter for PETSc: a mesh of DMPlex as a mesh in pieces.
 *
 * A DMPlex that is distributed without overlap has its cells in pieces, with numbers in the whole
 * mesh. dmplex_piece() hands them to mwp_mesh_create(). The program makes a square of triangles,
 * distributes it, locates random points, asks for values that lie with the pieces, and compares
 * them with the function that they are of.
 *
 *   mpiexec -n 3 dmplex [-faces 40] [-points 1000] [-compare]
 *
 * -compare: the same points by PETSc's own DMInterpolation, with times. */
#include <meshwalk-mpi/meshwalk-mpi.h>

#include <petscdmplex.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The piece of a rank; the arrays are to be freed. */
typedef struct dmplex_arrays {
    double *points;
    uint32_t *triangles;
    int64_t *vertices, *numbers;
    mwp_piece piece;
} dmplex_arrays;

/* Numbers of points that other ranks own are stored as -(number + 1). */
static int64_t global_number(PetscInt stored)
{
    return stored < 0 ? -(int64_t)stored - 1 : (int64_t)stored;
}

static PetscErrorCode dmplex_points(DM dm, PetscInt begin, PetscInt end, dmplex_arrays *a)
{
    IS numbering;
    Vec coordinates;
    PetscSection section;
    const PetscInt *number;
    const PetscScalar *at;
    PetscFunctionBeginUser;
    PetscCall(DMPlexGetVertexNumbering(dm, &numbering));
    PetscCall(ISGetIndices(numbering, &number));
    PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
    PetscCall(DMGetCoordinateSection(dm, &section));
    PetscCall(VecGetArrayRead(coordinates, &at));
    for (PetscInt v = begin; v < end; v++) {
        PetscInt offset;
        PetscCall(PetscSectionGetOffset(section, v, &offset));
        a->vertices[v - begin] = global_number(number[v - begin]);
        a->points[2 * (v - begin)] = PetscRealPart(at[offset]);
        a->points[2 * (v - begin) + 1] = PetscRealPart(at[offset + 1]);
    }
    PetscCall(VecRestoreArrayRead(coordinates, &at));
    PetscCall(ISRestoreIndices(numbering, &number));
    PetscFunctionReturn(0);
}

/* The three vertices among the points of a cell's closure. */
static PetscErrorCode dmplex_corners(DM dm, PetscInt cell, PetscInt begin, PetscInt end,
                                     uint32_t *corner)
{
    PetscInt *closure = NULL, count, found = 0;
    PetscFunctionBeginUser;
    PetscCall(DMPlexGetTransitiveClosure(dm, cell, PETSC_TRUE, &count, &closure));
    for (PetscInt i = 0; i < count; i++)
        if (closure[2 * i] >= begin && closure[2 * i] < end && found < 3)
            corner[found++] = (uint32_t)(closure[2 * i] - begin);
    PetscCall(DMPlexRestoreTransitiveClosure(dm, cell, PETSC_TRUE, &count, &closure));
    PetscCheck(found == 3, PETSC_COMM_SELF, PETSC_ERR_ARG_WRONG,
               "cell %" PetscInt_FMT " is no triangle", cell);
    PetscFunctionReturn(0);
}

/* The piece of this rank of a DMPlex of triangles in the plane, without overlap. */
static PetscErrorCode dmplex_piece(DM dm, dmplex_arrays *a)
{
    PetscInt cell_begin, cell_end, begin, end;
    IS numbering;
    const PetscInt *number;
    PetscFunctionBeginUser;
    PetscCall(DMPlexGetHeightStratum(dm, 0, &cell_begin, &cell_end));
    PetscCall(DMPlexGetDepthStratum(dm, 0, &begin, &end));
    const size_t cells = (size_t)(cell_end - cell_begin), points = (size_t)(end - begin);
    *a = (dmplex_arrays){.points = calloc(2 * points + 1, sizeof *a->points),
                         .triangles = calloc(3 * cells + 1, sizeof *a->triangles),
                         .vertices = calloc(points + 1, sizeof *a->vertices),
                         .numbers = calloc(cells + 1, sizeof *a->numbers)};
    PetscCheck(a->points && a->triangles && a->vertices && a->numbers, PETSC_COMM_SELF,
               PETSC_ERR_MEM, "out of memory");
    PetscCall(dmplex_points(dm, begin, end, a));
    PetscCall(DMPlexGetCellNumbering(dm, &numbering));
    PetscCall(ISGetIndices(numbering, &number));
    for (PetscInt c = cell_begin; c < cell_end; c++) {
        a->numbers[c - cell_begin] = global_number(number[c - cell_begin]);
        PetscCall(dmplex_corners(dm, c, begin, end, a->triangles + 3 * (c - cell_begin)));
    }
    PetscCall(ISRestoreIndices(numbering, &number));
    a->piece = (mwp_piece){.arrays = {.points = a->points,
                                      .point_count = points,
                                      .triangles = a->triangles,
                                      .triangle_count = cells},
                           .vertex_numbers = a->vertices,
                           .triangle_numbers = a->numbers};
    PetscFunctionReturn(0);
}

static void dmplex_release(dmplex_arrays *a)
{
    free(a->points);
    free(a->triangles);
    free(a->vertices);
    free(a->numbers);
}

/* --- the program ------------------------------------------------------------------------------ */

static double height(const double *p)
{
    return 3 * p[0] - 2 * p[1] + 1;
}

/* The unit square in n x n cells, each of two triangles: made by rank 0, then distributed. */
static PetscErrorCode square(PetscInt n, int rank, DM *dm)
{
    DM parallel;
    PetscPartitioner partitioner;
    const PetscInt side = rank == 0 ? n : 0, row = side + 1;
    PetscInt *cells = calloc(6 * (size_t)(side * side) + 1, sizeof *cells), count = 0;
    PetscReal *points = calloc(2 * (size_t)(row * row), sizeof *points);
    PetscFunctionBeginUser;
    PetscCheck(cells && points, PETSC_COMM_SELF, PETSC_ERR_MEM, "out of memory");
    for (PetscInt i = 0; rank == 0 && i < row * row; i++) {
        points[2 * i] = (PetscReal)(i % row) / (PetscReal)n;
        points[2 * i + 1] = (PetscReal)(i / row) / (PetscReal)n;
    }
    for (PetscInt i = 0; i < side * side; i++) {
        const PetscInt v = i / side * row + i % side;
        const PetscInt corner[6] = {v, v + 1, v + row + 1, v, v + row + 1, v + row};
        for (int k = 0; k < 6; k++) cells[count++] = corner[k];
    }
    PetscCall(DMPlexCreateFromCellListPetsc(PETSC_COMM_WORLD, 2, count / 3,
                                            rank == 0 ? row * row : 0, 3, PETSC_TRUE, cells, 2,
                                            points, dm));
    PetscCall(DMPlexGetPartitioner(*dm, &partitioner));
    PetscCall(PetscPartitionerSetFromOptions(partitioner));
    PetscCall(DMPlexDistribute(*dm, 0, NULL, &parallel));
    if (parallel) {
        PetscCall(DMDestroy(dm));
        *dm = parallel;
    }
    PetscCall(DMSetFromOptions(*dm)); /* -dm_plex_hash_location */
    free(cells);
    free(points);
    PetscFunctionReturn(0);
}

/* Points of this rank: different ones on each. */
static void points_make(double *points, PetscInt n, int rank)
{
    uint64_t state = (uint64_t)rank + 1;
    for (PetscInt i = 0; i < 2 * n; i++) {
        state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
        points[i] = (double)(state >> 11) * 0x1p-53;
    }
}

/* Locate, interpolate; returns the largest difference, or INFINITY after a failure. */
static double pieces_try(const dmplex_arrays *a, const double *points, PetscInt n, double *seconds)
{
    mwp_error error;
    mwp_mesh *mesh;
    double worst = 0;
    const size_t count = (size_t)n, vertices = a->piece.arrays.point_count;
    mwp_location *at = calloc(count + 1, sizeof *at);
    double *value = calloc(count + 1, sizeof *value),
           *heights = calloc(vertices + 1, sizeof *value);
    for (size_t v = 0; heights && v < vertices; v++) heights[v] = height(a->points + 2 * v);
    const mw_value_table table = {.values = heights, .count = 1};
    if (!at || !value || !heights ||
        mwp_mesh_create(PETSC_COMM_WORLD, &a->piece, NULL, &mesh, &error)) {
        fprintf(stderr, "no mesh: %s\n", error.message);
        return INFINITY;
    }
    *seconds = -MPI_Wtime();
    mw_status status = mwp_locate_batch(mesh, points, count, 2, NULL, at, &error);
    *seconds += MPI_Wtime();
    if (!status) status = mwp_interpolate(mesh, &table, at, count, value, &error);
    if (status) fprintf(stderr, "%s\n", error.message);
    for (size_t i = 0; i < count && !status; i++) {
        const double off = fabs(value[i] - height(points + 2 * i));
        if (!(off <= worst)) worst = off; /* also if it is NaN */
    }
    mwp_mesh_destroy(mesh);
    free(at);
    free(value);
    free(heights);
    return status ? INFINITY : worst;
}

/* How long PETSc takes to find the cells of the same points, each rank its own. */
static PetscErrorCode petsc_try(DM dm, double *points, PetscInt n, double *seconds)
{
    DMInterpolationInfo info;
    PetscFunctionBeginUser;
    PetscCall(DMInterpolationCreate(PETSC_COMM_WORLD, &info));
    PetscCall(DMInterpolationSetDim(info, 2));
    PetscCall(DMInterpolationSetDof(info, 1));
    PetscCall(DMInterpolationAddPoints(info, n, points));
    *seconds = -MPI_Wtime();
    PetscCall(DMInterpolationSetUp(info, dm, PETSC_FALSE, PETSC_TRUE));
    *seconds += MPI_Wtime();
    PetscCall(DMInterpolationDestroy(&info));
    PetscFunctionReturn(0);
}

int main(int count, char **arguments)
{
    DM dm;
    dmplex_arrays arrays;
    PetscInt faces = 40, n = 1000;
    PetscBool compare = PETSC_FALSE;
    int rank;
    double seconds = 0, petsc = 0, worst;
    PetscCall(PetscInitialize(&count, &arguments, NULL, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-faces", &faces, NULL));
    PetscCall(PetscOptionsGetInt(NULL, NULL, "-points", &n, NULL));
    PetscCall(PetscOptionsGetBool(NULL, NULL, "-compare", &compare, NULL));
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    PetscCall(square(faces, rank, &dm));
    PetscCall(dmplex_piece(dm, &arrays));
    double *points = calloc(2 * (size_t)n + 1, sizeof *points);
    points_make(points, n, rank);
    double off = pieces_try(&arrays, points, n, &seconds);
    MPI_Allreduce(&off, &worst, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "values are off by at most %s\n",
                          worst < 1e-13 ? "1e-13" : "more than 1e-13"));
    if (compare) {
        PetscCall(petsc_try(dm, points, n, &petsc));
        PetscCall(PetscPrintf(PETSC_COMM_WORLD, "meshwalk %g s, PETSc %g s\n", seconds, petsc));
    }
    free(points);
    dmplex_release(&arrays);
    PetscCall(DMDestroy(&dm));
    PetscCall(PetscFinalize());
    return worst < 1e-13 ? 0 : 1;
}
