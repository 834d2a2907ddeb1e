/**
 * @file meshwalk-mpi.h
 * Point location in a mesh that lies in pieces on the ranks of an MPI communicator.
 *
 * Each rank brings a piece: triangles and their vertices, with their numbers in the whole mesh.
 * Queries may be asked on any rank, and each is answered by the piece that contains it. The answers
 * are those that mw_locator_create() and mw_locate_batch() give for the whole mesh on one machine,
 * bit for bit, for any number of ranks and any way to cut: a point on a cut belongs to the triangle
 * with the lowest number of all ranks; cuts are no border and make no holes; holes have the same
 * numbers.
 *
 * Collective: all functions are, unless they say otherwise. All ranks of the communicator call them
 * in the same order. A failure on one rank fails the call on all of them, with the same error, and
 * none waits for ever.
 *
 * Threads: one thread of a rank at a time uses a mesh. MPI_THREAD_FUNNELED is enough.
 *
 * MPI: version 3.1 or later. While a rank waits for others, it gives its processor to them.
 */
#ifndef MESHWALK_MPI_H
#define MESHWALK_MPI_H

#include <meshwalk/locate.h>
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What went wrong, and where: the same on all ranks. Numbers are -1 where they do not apply. */
typedef struct mwp_error {
    mw_status status;
    int rank;         /**< the rank that found it */
    int64_t triangle; /**< the number of a triangle in the whole mesh */
    int64_t vertex;   /**< the number of a vertex in the whole mesh */
    char message[512];
} mwp_error;

/** A piece of a mesh: triangles, and the vertices that they have, as the caller's arrays. */
typedef struct mwp_piece {
    /** Vertices and triangles of the piece. Triangles name vertices by their place in the piece,
     * from 0. Both may be empty. */
    mw_arrays arrays;
    /** The number in the whole mesh of each vertex: at least 0. A vertex that several pieces have
     * has the same number and the same coordinates in all of them. */
    const int64_t *vertex_numbers;
    /** The number in the whole mesh of each triangle: at least 0, in any order. No two pieces have
     * one triangle. */
    const int64_t *triangle_numbers;
} mwp_piece;

/** A mesh in pieces, ready for queries. Opaque. */
typedef struct mwp_mesh mwp_mesh;

/** Options of a mesh in pieces. Zero-initialised options select the defaults. */
typedef struct mwp_mesh_options {
    uint32_t threads;     /**< threads of each rank while it prepares; 0: one. */
    uint32_t reserved[7]; /**< must be zero */
} mwp_mesh_options;

/**
 * Prepare a mesh in pieces for queries.
 *
 * The pieces together must be an embedding, as mw_check_arrays() decides for a mesh on one machine;
 * this is decided exactly, across ranks too.
 *
 * @param comm     the communicator; it is duplicated, so messages never mix with the caller's
 * @param piece    the piece of this rank; copied
 * @param options  NULL selects the defaults
 * @param out      receives the mesh, owned by the caller (mwp_mesh_destroy()); NULL on failure
 * @param error    NULL, or receives the message of a failure, which names rank, triangle or vertex
 * @return MW_OK; MW_ERROR_INPUT for pieces that have one triangle twice or overlap, for a vertex
 *         with different coordinates on two ranks, for a triangle that names a vertex that its
 *         piece lacks, and for every defect that mw_locator_create() refuses; MW_ERROR_ARGUMENT for
 *         NULL and negative numbers; MW_ERROR_LIMIT, MW_ERROR_MEMORY; MW_ERROR_SYSTEM if MPI fails.
 *
 * For n triangles and v vertices of a piece: O(n log n); messages of 24 bytes a vertex and 8 bytes
 * a triangle; about 100 bytes for each triangle at a vertex that several ranks share. Each rank
 * keeps the rim of the whole mesh: the triangles at its border and its holes, and triangles without
 * area, in about 250 bytes each.
 */
MW_API mw_status mwp_mesh_create(MPI_Comm comm, const mwp_piece *piece,
                                 const mwp_mesh_options *options, mwp_mesh **out, mwp_error *error);

/** Destroy a mesh in pieces. NULL is allowed, on all ranks. */
MW_API void mwp_mesh_destroy(mwp_mesh *mesh);

/** The sizes of a mesh in pieces. */
typedef struct mwp_mesh_info {
    int64_t vertices, triangles; /**< of the whole mesh; vertices of several pieces count once */
    uint32_t piece_vertices, piece_triangles; /**< of this rank's piece */
    uint32_t holes;                           /**< of the whole mesh */
    uint32_t rim_triangles;                   /**< of the whole mesh, kept on each rank */
    uint32_t boxes;                           /**< of all ranks, by which queries are routed */
    size_t bytes;                             /**< memory of this rank */
} mwp_mesh_info;

/** Fill `info` with the sizes of a mesh. Not collective. O(1). */
MW_API void mwp_mesh_describe(const mwp_mesh *mesh, mwp_mesh_info *info);

/** Where a point lies in a mesh in pieces. */
typedef struct mwp_location {
    double weight[3]; /**< as mw_location.weight */
    int64_t triangle; /**< its number in the whole mesh, or -1 */
    uint32_t hole;    /**< as mw_location.hole */
    int32_t rank;     /**< the rank that has the triangle, or -1 */
    uint32_t index;   /**< the triangle's place in the piece of that rank, or MW_NONE */
    uint8_t where;    /**< mw_where */
    uint8_t local;    /**< as mw_location.local */
    uint16_t reserved;
} mwp_location;

/** How to locate. Zero-initialised options select the defaults. */
typedef struct mwp_locate_options {
    /** Points outside the mesh, at most this far from it in mesh units, become MW_NEAR. At least
     * 0; the same on all ranks. */
    double tolerance;
    /** The most queries of other ranks that a rank takes at a time; 0: 2^18. It bounds memory to 80
     * bytes for each of them, whatever the other ranks ask. At least one query of each rank is
     * taken. */
    uint32_t budget;
    uint32_t threads; /**< threads of each rank; 0: one */
    uint32_t reserved[4];
} mwp_locate_options;

/**
 * Locate points: on each rank any number of them, anywhere, also none.
 *
 * A point strictly inside the piece of its own rank costs no message. Any other is sent to the
 * ranks in whose boxes it lies: 16 bytes there, and 48 back from those that contain it.
 *
 * @param mesh       the mesh
 * @param points     x, y of point i at points[i * stride] and the double after it
 * @param n          number of points of this rank
 * @param stride     doubles from one point to the next; 0 means 2
 * @param options    NULL selects the defaults
 * @param locations  receives n results in the order of the points; unspecified on failure
 * @param error      NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT for NULL, a stride of 1, or options out of range;
 *         MW_ERROR_MEMORY; MW_ERROR_SYSTEM if MPI fails.
 */
MW_API mw_status mwp_locate_batch(mwp_mesh *mesh, const double *points, size_t n, size_t stride,
                                  const mwp_locate_options *options, mwp_location *locations,
                                  mwp_error *error);

/** Points that are being located. Opaque. */
typedef struct mwp_locating mwp_locating;

/**
 * Begin to locate points, and return without waiting for other ranks. mwp_locate_test() goes on,
 * mwp_locate_end() ends. Arguments as for mwp_locate_batch(); `points` and `locations` must stay
 * until the end. At most one batch of a mesh is under way, and no other collective call on the mesh
 * is made before its end.
 *
 * @param mesh       the mesh
 * @param points     x, y of point i at points[i * stride] and the double after it
 * @param n          number of points of this rank
 * @param stride     doubles from one point to the next; 0 means 2
 * @param options    NULL selects the defaults
 * @param locations  receives n results at the end
 * @return what is under way; never NULL: failures are told by mwp_locate_end().
 */
MW_API mwp_locating *mwp_locate_begin(mwp_mesh *mesh, const double *points, size_t n, size_t stride,
                                      const mwp_locate_options *options, mwp_location *locations);

/** Go on as far as possible without waiting. Returns 1 when mwp_locate_end() will not wait, else 0.
 * Not collective: each rank calls it as often as it likes. */
MW_API int mwp_locate_test(mwp_locating *locating);

/** Wait for the end. Releases `locating`; returns and fills `error` as mwp_locate_batch(). */
MW_API mw_status mwp_locate_end(mwp_locating *locating, mwp_error *error);

/** The border edge nearest to a point outside. */
typedef struct mwp_nearest_border_point {
    int64_t triangle; /**< its number in the whole mesh */
    int32_t rank;     /**< the rank that has it */
    uint32_t index;   /**< its place in the piece of that rank */
    uint32_t edge;    /**< local edge */
    uint32_t reserved;
    double distance; /**< as mw_nearest_border_point.distance */
    double point[2]; /**< the nearest point of the edge, rounded */
    double weight[3];
} mwp_nearest_border_point;

/**
 * Find the border edge of the whole mesh nearest to a point in no triangle: the answer of
 * mw_nearest_border() for the whole mesh, bit for bit.
 *
 * @param mesh     the mesh
 * @param x, y     a point outside, or in a hole
 * @param nearest  receives the answer
 * @param error    NULL, or receives the message of a failure
 * @return MW_OK; MW_ERROR_ARGUMENT if the point is not finite or lies in the mesh.
 *
 * Not collective: each rank has what it needs.
 */
MW_API mw_status mwp_nearest_border(const mwp_mesh *mesh, double x, double y,
                                    mwp_nearest_border_point *nearest, mwp_error *error);

#ifdef __cplusplus
}
#endif
#endif
