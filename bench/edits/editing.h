/* editing.h - what 'bench edit' asks of a library that keeps a Delaunay
 * triangulation while its points change. Between the program and the peers of
 * bench/, as engine.h. */
#ifndef CLI_EDITING_H
#define CLI_EDITING_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum editor_id {
#define EDITOR(id, name, engine, edits, help) EDITOR_##id,
#include "bench/edits/editing.def"
    EDITORS
} editor_id;

typedef enum script_kind { SCRIPT_INSERT, SCRIPT_REMOVE, SCRIPT_MOVE, SCRIPT_LOCATE } script_kind;

/* One thing to do. Vertices are the points in order, then those inserted, in
 * order. */
typedef struct script_step {
    script_kind kind;
    uint32_t vertex;
    double point[2];
} script_step;

typedef struct script {
    double *points; /* that are there at first: x0 y0 x1 y1 ... */
    size_t point_count;
    script_step *steps;
    size_t count, inserted, located; /* of all steps; of those of these kinds */
    int hinted;                      /* each step is near the one before: to be located from there */
    int at_once;                     /* all are insertions, known before the first                 */
} script;

#define EDITING_FAILED (-1.0) /* in the place of seconds */

typedef struct editing_code {
    const char *(*version)(void);
    /* A triangulation of the points of a script; NULL where it fails. */
    void *(*build)(const script *s);
    /* Carry out the script; returns seconds. `corners`: six numbers for each
   * place located, those of its triangle; or 0. */
    double (*run)(void *self, const script *s, double *corners);
    /* A sum over all triangles, see editing_sum. */
    uint64_t (*sum)(const void *self);
    void (*destroy)(void *self);
} editing_code;

/* The code of a peer's editor; NULL: it was not built. */
const editing_code *peers_editor(editor_id id);

/* A number of a triangle that does not depend on which corner comes first, nor
 * on its orientation: FNV-1a of whole words [Fowler, Noll, Vo] over the corners
 * in order of coordinates, and mixed. The sum over the triangles tells whether
 * two triangulations are the same. */
static inline uint64_t editing_sum(const double corners[6])
{
    double c[6];
    memcpy(c, corners, sizeof c);
    for (int pass = 0; pass < 3; pass++) { /* bubbles: 0 with 1, 1 with 2, 0 with 1 */
        double *a = c + 2 * (pass % 2), *b = a + 2, x = a[0], y = a[1];
        if (x < b[0] || (x == b[0] && y <= b[1])) continue;
        a[0] = b[0];
        a[1] = b[1];
        b[0] = x;
        b[1] = y;
    }
    uint64_t sum = UINT64_C(14695981039346656037), words[6];
    memcpy(words, c, sizeof words);
    for (int k = 0; k < 6; k++) sum = (sum ^ words[k]) * UINT64_C(1099511628211);
    return (sum ^ (sum >> 31)) * UINT64_C(0x9e3779b97f4a7c15);
}

#ifdef __cplusplus
}
#endif

#endif
