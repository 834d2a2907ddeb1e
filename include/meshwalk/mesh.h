/* mesh.h - a planar triangle mesh, from the caller's arrays.
 *
 * A mesh keeps the caller's numbering: vertex i is the i-th point given, triangle t the t-th triangle. Within triangle
 * t, local vertices are 0, 1, 2 as given, and local edge k joins local vertex k to local vertex (k + 1) mod 3.
 * A mesh is const while it is queried: any number of threads may read one mesh. */
#ifndef MESHWALK_MESH_H
#define MESHWALK_MESH_H

#include <meshwalk/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mw_mesh mw_mesh;

typedef enum mw_integer_type { MW_UINT32 = 0, MW_INT32, MW_INT64 } mw_integer_type;

/* The caller's arrays. They are read during the call only; the mesh keeps copies. */
typedef struct mw_arrays {
    const double *points;         /* x, y of vertex i at points[i * point_stride], points[i * point_stride + 1]       */
    size_t point_count;           /*                                                                                  */
    size_t point_stride;          /* in doubles; 0 means 2 (packed x y); 3 skips the z of x y z                       */
    const void *triangles;        /* 3 * triangle_count vertex numbers of type integer_type, 0-based, packed          */
    size_t triangle_count;        /*                                                                                  */
    mw_integer_type integer_type; /* 0 = MW_UINT32                                                             */
} mw_arrays;

/* Defects of a mesh. The first group makes the arrays unusable: mw_mesh_create refuses them. The second group leaves a
 * mesh that is no embedding: every point location promise holds for embeddings only. MW_DEFECT_FLAT is a remark: flat
 * triangles are accepted, and never own a point. */
typedef enum mw_defect_kind {
    MW_DEFECT_MISSING_VERTEX = 0, /* `triangle` names a vertex that does not exist                                   */
    MW_DEFECT_NOT_FINITE,      /* `vertex` of `triangle` has a coordinate that is NaN or infinite                    */
    MW_DEFECT_REPEATED_VERTEX, /* `triangle` has `vertex` twice                                                      */
    MW_DEFECT_NON_MANIFOLD_EDGE, /* `edge` of `triangle` belongs to three or more triangles; `other` is one of them  */
    MW_DEFECT_FOLDED,         /* `triangle` and `other` lie on the same side of the `edge` they share               */
    MW_DEFECT_WINDING,        /* the triangles round inner `vertex` turn by more than 2 pi; `triangle` is one       */
    MW_DEFECT_CROSSING,       /* border `edge` of `triangle` crosses border `other_edge` of `other`                 */
    MW_DEFECT_VERTEX_IN_EDGE, /* `vertex` lies inside border `edge` of `triangle`, without a flat triangle there    */
    MW_DEFECT_OVERLAP,        /* the mesh covers the inside of `triangle`, beside its border `edge`, more than once;
                                  `other`, if any, is a triangle on the same side of border `other_edge` along it    */
    MW_DEFECT_FLAT,           /* `triangle` has no area                                                             */
    /* Of surfaces (surface.h) and star-shaped polyhedra (star.h) only: */
    MW_DEFECT_CLASHING,       /* `triangle` and `other` are oriented differently along `edge`                       */
    MW_DEFECT_OPEN_EDGE,      /* `edge` of `triangle` has no triangle on its other side: the polyhedron is not closed */
    MW_DEFECT_THROUGH_CENTRE, /* the plane of `triangle` passes through the centre                                  */
    MW_DEFECT_BACK_FACING,    /* `triangle` turns its back to the centre, seen from its neighbour `other` at `edge`,
                                 if any                                                                            */
    MW_DEFECT_COVERED,        /* a ray from the centre meets both `triangle` and `other`                            */
    MW_DEFECT_COUNT
} mw_defect_kind;

/* One defect and its place. Fields that do not apply are MW_NONE (255 for edges). */
typedef struct mw_defect {
    mw_defect_kind kind;
    uint32_t triangle, other;
    uint32_t vertex;
    uint8_t edge, other_edge;
} mw_defect;

/* Every defect found, in order of kind, then triangle. Owned by the caller: release with mw_check_release. */
typedef struct mw_check {
    mw_defect *defects;
    size_t defect_count;
    int valid; /* 1: no defect but flat triangles: the mesh is an embedding, and location in it is exact and complete */
} mw_check;

/* A short English text for a kind of defect, never NULL. */
MW_API const char *mw_defect_text(mw_defect_kind kind);

/* Write "triangle 17: ..." for one defect into text[size], always terminated. */
MW_API void mw_defect_describe(const mw_defect *defect, char *text, size_t size);

/* How a mesh is checked. */
typedef struct mw_check_options {
    uint32_t threads; /* 0: as many as processors; the result is the same for any number */
    uint32_t reserved[3];
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
} mw_check_options;

/* Find every defect of the mesh in `arrays`, and decide whether it is an embedding. Of two border edges that cross, or
 * run along each other on the same side, at least one is listed, with one of those in its way, so the list stays linear
 * in the mesh; where thousands of long edges cross, some are not listed. And where borders cross, what else is wrong in
 * the parts of the mesh that they bound may show only when that is mended. The same arrays give the same list. Time:
 * O(n) for the local defects; for b border edges O(b log^2 b) is to be expected, whether they cross or not (see
 * docs/guarantees.md). MW_OK also when defects were found. MW_ERROR_ARGUMENT, MW_ERROR_LIMIT, MW_ERROR_MEMORY,
 * MW_CANCELLED. Thread-safe.
 *   options  NULL = all zero */
MW_API mw_status mw_check_arrays(const mw_arrays *arrays, const mw_check_options *options, mw_check *check,
                                 mw_error *error);
MW_API void mw_check_release(mw_check *check);

/* How a mesh lies in memory. No number shows it; but of a mesh that is no embedding other defects may be named, and the
 * sum of areas may differ in its last bits. Tolerant meshes are as the arrays are. */
typedef enum mw_mesh_layout {
    MW_LAYOUT_AUTO = 0, /* decide by the order of the arrays                       */
    MW_LAYOUT_HILBERT,  /* along a Hilbert curve, whatever the order of the arrays */
    MW_LAYOUT_AS_GIVEN  /* as the arrays are                                       */
} mw_mesh_layout;

typedef struct mw_mesh_options {
    int tolerant; /* 1: take also arrays with repeated vertices, non-finite vertices and edges of three triangles; the
                     triangles concerned are kept but never own a point, the third triangle is not linked           */
    mw_mesh_layout layout;
    uint32_t threads;            /* 0: as many as processors; the mesh is the same for any number */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[3];
} mw_mesh_options;

/* Build a mesh: copies the coordinates, finds the neighbours in O(n). Mixed orientation is accepted and remembered. Arrays
 * whose neighbours lie far apart are laid out along a Hilbert curve in memory, which takes 4
 * bytes a triangle and 8 a vertex more; numbers stay the caller's.
 *   options  NULL = all zero
 *   out      set to the new mesh, owned by the caller (mw_mesh_destroy), or to NULL on failure
 * MW_ERROR_INPUT names the first defect of the unusable group; MW_ERROR_LIMIT, MW_ERROR_MEMORY. */
MW_API mw_status mw_mesh_create(const mw_arrays *arrays, const mw_mesh_options *options, mw_mesh **out,
                                mw_error *error);
MW_API void mw_mesh_destroy(mw_mesh *mesh); /* NULL is allowed */

/* Numbers of vertices, triangles and local edges are not checked: they must be those of the mesh. */
MW_API uint32_t mw_mesh_vertex_count(const mw_mesh *mesh);
MW_API uint32_t mw_mesh_triangle_count(const mw_mesh *mesh);
MW_API void mw_mesh_vertex(const mw_mesh *mesh, uint32_t vertex, double point[2]);
MW_API void mw_mesh_triangle(const mw_mesh *mesh, uint32_t triangle, uint32_t vertices[3]);
/* The triangle on the other side of a local edge, or MW_NONE; *edge (may be NULL) is the local edge there. */
MW_API uint32_t mw_mesh_neighbour(const mw_mesh *mesh, uint32_t triangle, unsigned local_edge, unsigned *edge);
MW_API size_t mw_mesh_bytes(const mw_mesh *mesh);

/* Values per vertex: heights, fields. `values` has one double per vertex, `stride` doubles apart (0 = 1); copied.
 * Names are unique; setting one again replaces its values. Not to be called while other threads use the mesh. */
MW_API mw_status mw_mesh_set_field(mw_mesh *mesh, const char *name, const double *values, size_t stride,
                                   mw_error *error);
/* The values of a field, one per vertex, owned by the mesh; NULL if there is none of that name. */
MW_API const double *mw_mesh_field(const mw_mesh *mesh, const char *name);
MW_API size_t mw_mesh_field_count(const mw_mesh *mesh);
MW_API const char *mw_mesh_field_name(const mw_mesh *mesh, size_t index);

/* What kind of mesh it is. Holes, convexity and the embedding are decided exactly, in near-linear time. */
typedef struct mw_mesh_info {
    uint32_t vertices, triangles;
    uint32_t unused_vertices;     /* vertices of no triangle                                            */
    uint32_t flat_triangles;      /* triangles without area                                             */
    uint32_t clockwise_triangles; /* the others are counter-clockwise or flat                           */
    uint32_t clashing_edges;      /* inner edges whose two triangles are oriented differently           */
    uint32_t border_edges;        /* edges of one triangle                                              */
    uint32_t border_loops;        /* closed chains of border edges                                      */
    uint32_t components;          /* pieces that share no vertex                                        */
    uint32_t holes;               /* bounded pieces of the plane without the mesh; 0 if no embedding    */
    int oriented;                 /* no clashing edges                                                  */
    int embedding;                /* as mw_check_arrays                                                 */
    int convex;                   /* an embedding that fills its convex hull                            */
    int delaunay;                 /* an embedding, and no inner edge has a vertex across it in a circle */
    double low[2], high[2];       /* extent of the used vertices; NaN without triangles                 */
    double area;                  /* sum of the triangles' areas                                        */
} mw_mesh_info;

/**
 * Describe a mesh.
 *
 * @param options  threads and progress of the check; NULL = all zero
 * @param info     filled in; unspecified after a failure
 * @return MW_OK, also for a mesh that is no embedding; MW_ERROR_ARGUMENT, MW_ERROR_LIMIT, MW_ERROR_MEMORY, MW_CANCELLED
 *
 * Thread-safe. Cost as mw_check_arrays.
 */
MW_API mw_status mw_mesh_describe(const mw_mesh *mesh, const mw_check_options *options, mw_mesh_info *info,
                                  mw_error *error);

/* Orders along a Hilbert curve, for laying out arrays so that neighbours lie near each other in memory.
 *   triangles, vertices  arrays of triangle_count and vertex_count; either may be NULL. order[i] is the number of the
 *                        triangle (vertex) that comes i-th; unused vertices come last.  */
MW_API mw_status mw_mesh_hilbert_order(const mw_mesh *mesh, uint32_t *triangles, uint32_t *vertices, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
