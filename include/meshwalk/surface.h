/* surface.h - a triangle mesh in space, from the caller's arrays; it may move and change between queries.
 *
 * A surface keeps the caller's numbering, as a planar mesh does (mesh.h): vertices, triangles, local vertices 0, 1,
 * 2 as given, local edge k from local vertex k to local vertex (k + 1) mod 3. The front of a triangle is the side
 * from which its vertices are seen counter-clockwise, in a right-handed frame.
 *
 * What is asked of a surface: which facet a ray from a centre meets (star.h), which triangle a probe touches
 * (probe.h). Both keep what they need beside the surface, which must outlive them. A surface is const while it is
 * queried: any number of threads may query one surface. To change it, see mw_surface_begin_update. */
#ifndef MESHWALK_SURFACE_H
#define MESHWALK_SURFACE_H

#include <meshwalk/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mw_surface mw_surface;

/* All zero = the arrays are sound, are copied, and do not change while they are queried. */
typedef struct mw_surface_options {
    int tolerant; /* 1: take also arrays with repeated vertices, non-finite vertices and edges of three triangles; the
                     triangles concerned are kept but never own a point, the third triangle is not linked           */
    int weld;     /* 1: vertices with equal coordinates are one where neighbours are looked for (-0.0 is 0.0). Decided
                     when the surface is made: moving vertices neither joins nor parts                              */
    int shared;   /* 1: queries of other threads may run while a thread asks for an update: mw_surface_begin_update
                     waits for them to end, and those that come wait for mw_surface_end_update. Costs each query a
                     reader's lock. 0: the caller sees to it that no query runs during an update                   */
    int borrow;   /* 1: the points are not copied: arrays->points, with a stride of 3, must outlive the surface      */
    const mw_progress *progress; /* who watches, and may cancel: base.h; NULL: nobody */
    uint32_t reserved[6];
} mw_surface_options;

/* Build a surface: copies the arrays, finds the neighbours in O(n). Open borders, several pieces, flat triangles,
 * vertices that no triangle uses and neighbours of different orientation are accepted. arrays   x, y, z of vertex i
 * at points[i * point_stride] and the two doubles after it; a stride of 0 means 3 here options  NULL = all zero out
 * set to the new surface, owned by the caller (mw_surface_destroy), or to NULL on failure MW_ERROR_INPUT names the
 * first defect that makes the arrays unusable (see mw_mesh_create); MW_ERROR_ARGUMENT: NULL, a stride of 1 or 2, or
 * another than 3 with `borrow`; MW_ERROR_LIMIT; MW_ERROR_MEMORY. Thread-safe. */
MW_API mw_status mw_surface_create(const mw_arrays *arrays, const mw_surface_options *options, mw_surface **out,
                                   mw_error *error);
MW_API void mw_surface_destroy(mw_surface *surface); /* NULL is allowed */

/* Numbers of vertices, triangles and local edges are not checked: they must be those of the surface. */
MW_API uint32_t mw_surface_vertex_count(const mw_surface *surface);
MW_API uint32_t mw_surface_triangle_count(const mw_surface *surface);
MW_API void mw_surface_vertex(const mw_surface *surface, uint32_t vertex, double point[3]);
MW_API void mw_surface_triangle(const mw_surface *surface, uint32_t triangle, uint32_t vertices[3]);
/* The triangle on the other side of a local edge, or MW_NONE; *edge (may be NULL) is the local edge there. */
MW_API uint32_t mw_surface_neighbour(const mw_surface *surface, uint32_t triangle, unsigned local_edge, unsigned *edge);
MW_API size_t mw_surface_bytes(const mw_surface *surface);

/* --- change ------------------------------------------------------------------------------------------------------- */

/* An update: begin, overwrite vertices in mw_surface_points and flip edges as wanted, bring up to date what is kept
 * beside the surface (mw_star_update, mw_prober_update), end. Neither call costs anything per vertex. Between the
 * two no query may run; with options.shared these calls see to that themselves, whatever other threads do, and an
 * update waits for the queries that have begun, not for those that come: mw_star_locate, _batch and _path, mw_probe,
 * _batch and _path, mw_nearest_on_surface, mw_surface_describe. Of a batch each query is answered as a whole: an
 * update may come between two of them. All else about the surface and what is kept beside it (making stars, probers
 * and indices, describing them, reading vertices) is the updating thread's. Without it they only mark the surface as
 * changed. One thread updates at a time. A star or a prober that needed to be brought up to date and was not does
 * not answer (see there). */
MW_API void mw_surface_begin_update(mw_surface *surface);
MW_API void mw_surface_end_update(mw_surface *surface);

/* x, y, z of all vertices, packed, to be overwritten during an update; the surface's own, or borrowed. A vertex that
 * becomes NaN or infinite makes its triangles own no point, as in a tolerant surface. */
MW_API double *mw_surface_points(mw_surface *surface);

/* Flip the edge between two triangles, during an update: of triangle a b c with local edge ab, and its neighbour b a
 * d they become, under the same numbers, c d b and d c a (`triangle` keeps the corner c as it was, and the neighbour
 * d). With options.weld one place may have different numbers in the two triangles: b is then the number that it has
 * in `triangle`, a that in its neighbour. MW_ERROR_INPUT, and nothing is changed: the edge has one triangle only,
 * its triangles are oriented differently, or c and d are the same, or joined by an edge already; that is looked for
 * in the fan of `triangle` round c (another fan of a pinched vertex is not looked at). Time: the number of triangles
 * in that fan. */
MW_API mw_status mw_surface_flip(mw_surface *surface, uint32_t triangle, unsigned local_edge, mw_error *error);

/* --- what kind of surface it is ----------------------------------------------------------------------------------- */

typedef struct mw_surface_info {
    uint32_t vertices, triangles;
    uint32_t unused_vertices;  /* vertices of no triangle                                                   */
    uint32_t flat_triangles;   /* triangles without area                                                    */
    uint32_t clashing_edges;   /* inner edges whose two triangles are oriented differently                  */
    uint32_t pinched_vertices; /* used vertices where the triangles do not form one fan                    */
    uint32_t border_edges;     /* edges of one triangle                                                     */
    uint32_t border_loops;     /* closed chains of border edges                                             */
    uint32_t components;       /* pieces that share no vertex                                               */
    int closed;                /* there are triangles, and no border edges                                  */
    int oriented;              /* no clashing edges                                                         */
    int64_t euler;             /* used vertices - edges + triangles                                         */
    double low[3], high[3];    /* extent of the used vertices; NaN without triangles                        */
    double area;               /* sum of the triangles' areas, rounded                                      */
    double volume; /* of a closed oriented surface: enclosed, positive if fronts face out; else NaN; rounded */
} mw_surface_info;

/* In O(n). With options.weld vertices with equal coordinates count once. A triangle that has a vertex twice (with
 * weld: two vertices with equal coordinates) is flat, and counts neither for edges and fans nor in `euler`; the
 * third triangle at an edge of a tolerant surface has a border edge of its own there. With options.shared this is a
 * query: not to be called between begin and end of an update. MW_ERROR_MEMORY, MW_ERROR_ARGUMENT: NULL. Thread-safe. */
MW_API mw_status mw_surface_describe(const mw_surface *surface, mw_surface_info *info, mw_error *error);

/* Find every defect of the arrays as a surface: the unusable group of mw_defect_kind, then MW_DEFECT_CLASHING, and
 * MW_DEFECT_FLAT as a remark; `weld` as in the options. check->valid: 1 if there is none but flat triangles. O(n);
 * of unusable arrays O(n log b) for b edges of one triangle. MW_OK also when defects were found. Release with
 * mw_check_release. options: NULL = all zero. MW_CANCELLED. Thread-safe. */
MW_API mw_status mw_surface_check_arrays(const mw_arrays *arrays, int weld, const mw_check_options *options,
                                         mw_check *check, mw_error *error);

#ifdef __cplusplus
}
#endif
#endif
