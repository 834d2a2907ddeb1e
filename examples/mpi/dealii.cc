/* dealii.cc - an adapter for deal.II: a distributed triangulation as a mesh in pieces.
 *
 * dealii_piece() hands the cells that a rank owns of a parallel::distributed::Triangulation in the
 * plane to mwp_mesh_create(), each cut into two triangles: triangle t is a half of cell t / 2. The
 * program makes a square of such cells, locates random points, and interpolates values that lie
 * with the pieces, which it compares with the function that they are of.
 *
 *   mpiexec -n 3 dealii [-refine 5] [-points 1000] [-compare]
 *
 * -compare: the same points by deal.II's own RemotePointEvaluation, with times. */
#include <meshwalk-mpi/meshwalk-mpi.h>

#include <deal.II/base/mpi_remote_point_evaluation.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <stdexcept>
#include <vector>

using Grid = dealii::parallel::distributed::Triangulation<2>;

/* --- the adapter ------------------------------------------------------------------------------ */

/* The piece of a rank. */
struct Piece {
    std::vector<double> points;
    std::vector<std::uint32_t> triangles;
    std::vector<std::int64_t> vertices, numbers;

    mwp_piece arrays() const
    {
        mwp_piece piece = {};
        piece.arrays.points = points.data();
        piece.arrays.point_count = vertices.size();
        piece.arrays.triangles = triangles.data();
        piece.arrays.triangle_count = numbers.size();
        piece.vertex_numbers = vertices.data();
        piece.triangle_numbers = numbers.data();
        return piece;
    }
};

/* The piece of this rank of a grid without hanging nodes. Collective. */
static Piece dealii_piece(const Grid &grid)
{
    if (grid.has_hanging_nodes())
        throw std::invalid_argument("a vertex lies inside an edge: the grid has hanging nodes");
    Piece piece;
    const dealii::FE_Q<2> linear(1); /* one unknown at each vertex: its number is the vertex' */
    dealii::DoFHandler<2> unknowns(grid);
    unknowns.distribute_dofs(linear);
    std::vector<std::int64_t> place(grid.n_vertices(), -1);
    for (const auto &cell : unknowns.active_cell_iterators()) {
        if (!cell->is_locally_owned()) continue;
        std::uint32_t corner[4];
        for (const unsigned int v : cell->vertex_indices()) {
            const unsigned int vertex = cell->vertex_index(v);
            if (place[vertex] < 0) {
                place[vertex] = static_cast<std::int64_t>(piece.vertices.size());
                piece.vertices.push_back(static_cast<std::int64_t>(cell->vertex_dof_index(v, 0)));
                piece.points.push_back(cell->vertex(v)[0]);
                piece.points.push_back(cell->vertex(v)[1]);
            }
            corner[v] = static_cast<std::uint32_t>(place[vertex]);
        }
        /*  2--3   deal.II counts the corners of a cell so */
        /*  0--1                                           */
        for (const std::uint32_t v :
             {corner[0], corner[1], corner[3], corner[0], corner[3], corner[2]})
            piece.triangles.push_back(v);
        const auto number = static_cast<std::int64_t>(cell->global_active_cell_index());
        piece.numbers.push_back(2 * number);
        piece.numbers.push_back(2 * number + 1);
    }
    return piece;
}

/* --- the program ------------------------------------------------------------------------------ */

static double height(const double *p)
{
    return 3 * p[0] - 2 * p[1] + 1;
}

static void check(mw_status status, const mwp_error &error)
{
    if (status) throw std::runtime_error(error.message);
}

/* How far interpolated values are off at most. Not a number counts as infinite. */
static double values_off(mwp_mesh *mesh, const Piece &piece, const std::vector<double> &points,
                         const std::vector<mwp_location> &at)
{
    mwp_error error;
    std::vector<double> heights, value(at.size());
    for (std::size_t v = 0; v < piece.vertices.size(); v++)
        heights.push_back(height(&piece.points[2 * v]));
    mw_value_table table = {};
    table.values = heights.data();
    table.count = 1;
    check(mwp_interpolate(mesh, &table, at.data(), at.size(), value.data(), &error), error);
    double worst = 0;
    for (std::size_t i = 0; i < at.size(); i++) {
        const double off = std::fabs(value[i] - height(&points[2 * i]));
        if (!(off <= worst)) worst = std::isnan(off) ? INFINITY : off;
    }
    return worst;
}

/* Locate the points by deal.II, each rank its own. Returns at how many of them none of the cells
 * that deal.II finds has the triangle. */
static std::uint64_t dealii_try(const Grid &grid, const std::vector<double> &points,
                                const std::vector<mwp_location> &at, double *seconds)
{
    using Remote = dealii::Utilities::MPI::RemotePointEvaluation<2>;
    std::vector<dealii::Point<2>> places;
    for (std::size_t i = 0; i < at.size(); i++)
        places.emplace_back(points[2 * i], points[2 * i + 1]);
    const dealii::MappingQ1<2> mapping;
    Remote remote(1e-10);
    *seconds = -MPI_Wtime();
    remote.reinit(places, grid, mapping);
    *seconds += MPI_Wtime();
    std::vector<double> number, buffer;
    const auto cell_numbers = [&](const dealii::ArrayView<double> &values,
                                  const Remote::CellData &data) {
        for (std::size_t i = 0; i < data.cells.size(); i++) {
            const Grid::active_cell_iterator cell(&grid, data.cells[i].first,
                                                  data.cells[i].second);
            for (unsigned int q = data.reference_point_ptrs[i];
                 q < data.reference_point_ptrs[i + 1]; q++)
                values[q] = static_cast<double>(cell->global_active_cell_index());
        }
    };
    remote.evaluate_and_process<double>(number, buffer, cell_numbers);
    std::uint64_t others = 0;
    const std::vector<unsigned int> &first = remote.get_point_ptrs();
    for (std::size_t i = 0; i < at.size(); i++) {
        bool found = false;
        for (unsigned int k = first[i]; k < first[i + 1]; k++)
            found = found || number[k] == static_cast<double>(at[i].triangle / 2);
        others += !found;
    }
    return others;
}

/* The number that follows a word of the arguments. */
static long argument(int count, char **arguments, const char *word, long otherwise)
{
    for (int i = 1; i + 1 < count; i++)
        if (std::strcmp(arguments[i], word) == 0) return std::atol(arguments[i + 1]);
    return otherwise;
}

static int run(int count, char **arguments)
{
    const MPI_Comm comm = MPI_COMM_WORLD;
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
    bool compare = false;
    for (int i = 1; i < count; i++) compare = compare || !std::strcmp(arguments[i], "-compare");
    Grid grid(comm);
    dealii::GridGenerator::hyper_cube(grid);
    grid.refine_global(static_cast<unsigned int>(argument(count, arguments, "-refine", 5)));
    const Piece piece = dealii_piece(grid);

    mwp_error error;
    mwp_mesh *mesh;
    const mwp_piece arrays = piece.arrays();
    check(mwp_mesh_create(comm, &arrays, nullptr, &mesh, &error), error);
    const auto n = static_cast<std::size_t>(argument(count, arguments, "-points", 1000));
    std::vector<double> points(2 * n);
    std::mt19937_64 random(rank + 1);
    for (double &x : points) x = static_cast<double>(random() >> 11) * 0x1p-53;
    std::vector<mwp_location> at(n);
    double seconds = -MPI_Wtime();
    check(mwp_locate_batch(mesh, points.data(), n, 2, nullptr, at.data(), &error), error);
    seconds += MPI_Wtime();

    const double worst =
        dealii::Utilities::MPI::max(values_off(mesh, piece, points, at), comm);
    std::uint64_t others = 0;
    if (rank == 0)
        std::printf("values are off by at most %s\n", worst < 1e-13 ? "1e-13" : "more than 1e-13");
    if (compare) {
        double dealii_seconds;
        others = dealii::Utilities::MPI::sum(dealii_try(grid, points, at, &dealii_seconds), comm);
        if (rank == 0)
            std::printf("meshwalk %g s, deal.II %g s; other cells at %llu points\n", seconds,
                        dealii_seconds, static_cast<unsigned long long>(others));
    }
    mwp_mesh_destroy(mesh);
    return worst < 1e-13 && others == 0 ? 0 : 1;
}

int main(int count, char **arguments)
{
    const dealii::Utilities::MPI::MPI_InitFinalize mpi(count, arguments, 1);
    try {
        return run(count, arguments);
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "dealii: %s\n", failure.what());
        MPI_Abort(MPI_COMM_WORLD, 1);
        return 1;
    }
}
