/* space_engine.h - who answers rays: ours, and those of other libraries. */
#ifndef MW_BENCH_SPACE_SPACE_ENGINE_H
#define MW_BENCH_SPACE_SPACE_ENGINE_H

#include "bench/space/space_model.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The most ways to cast rays, and to follow a move. */
#define SPACE_WAYS 3

/* What a ray met nothing is told by. */
#define SPACE_NOTHING UINT32_MAX

/* One engine. Functions that take time return its seconds, or a negative number after a
 * complaint. */
typedef struct space_engine {
    const char *name;
    const char *casts[SPACE_WAYS + 1];   /* names of the ways to cast, up to NULL */
    const char *follows[SPACE_WAYS + 1]; /* and of those to follow moved vertices */
    bool needs_star;                     /* casts from the centre only */
    bool is_first;                       /* answers with any triangle, not only the nearest */
    size_t most_rays, most_triangles;    /* 0: any number; a slow one takes no more */
    /* The version of the library; NULL if it is not there. */
    const char *(*version)(void);
    /* Make what answers. Returns NULL after a complaint, else sets *seconds and *bytes. */
    void *(*build)(const space_model *m, uint32_t threads, double *seconds, size_t *bytes);
    /* The nearest triangle ahead of each ray, by its front or its back, or SPACE_NOTHING. */
    double (*cast)(void *scene, unsigned way, const space_rays *rays, space_rays_kind kind,
                   uint32_t threads, uint32_t *found);
    /* The model moved: its first `moved` vertices, none farther than `farthest`. After that the
     * way `way` to follow is the one that answers. */
    double (*follow)(void *scene, unsigned way, const space_model *m, size_t moved, double farthest,
                     uint32_t threads);
    void (*destroy)(void *scene);
} space_engine;

/* All that the program was built with, up to NULL. */
extern const space_engine *const space_engines[];

extern const space_engine space_engine_certain, space_engine_walk, space_engine_guided,
    space_engine_star, space_engine_embree, space_engine_cgal, space_engine_trimesh;

#ifdef __cplusplus
}
#endif

#endif
