/* edit_engine.h - what an engine of 'bench edit' does: it keeps a Delaunay triangulation while its
 * points change. Ours are in edit_engine_meshwalk.c, CGAL's, linked only where MW_BUILD_BENCH is
 * set, in edit_engine_cgal.cpp. */
#ifndef MW_BENCH_EDITS_EDIT_ENGINE_H
#define MW_BENCH_EDITS_EDIT_ENGINE_H

#include "bench/edits/edit_script.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum edit_engine_id {
#define EDIT_ENGINE(id, name, engine, follows, help) EDIT_ENGINE_##id,
#include "bench/edits/edit_engine.def"
    EDIT_ENGINES
} edit_engine_id;

#define EDIT_ENGINE_FAILED (-1.0) /* in the place of seconds */

typedef struct edit_engine_code {
    /* A triangulation of the points of a script; NULL where it fails. */
    void *(*build)(const edit_script *s);
    /* Carry out the script; returns seconds. `corners`: six numbers for each point located, those
     * of its triangle; or 0. */
    double (*run)(void *self, const edit_script *s, double *corners);
    /* The sum of triangle_hash over all triangles. */
    uint64_t (*hash)(const void *self);
    void (*destroy)(void *self);
} edit_engine_code;

/* The code of one of ours, or of CGAL's. NULL: it is not one of them. */
const edit_engine_code *edit_engine_meshwalk_code(edit_engine_id id);
const edit_engine_code *edit_engine_cgal_code(edit_engine_id id);

#ifdef __cplusplus
}
#endif

#endif
