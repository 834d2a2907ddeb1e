#include "cli/vertices/traced_constraints.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/text.h"
#include "cli/constraints/constraint_file.h"
#include "cli/vertices/vertex_crs.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdlib.h>

/* The triangles round each vertex: those of vertex v are triangle[first[v]] to triangle[first[v +
 * 1] - 1]. */
typedef struct vertex_triangles {
    size_t *first;
    uint32_t *triangle;
} vertex_triangles;

static void vertex_triangles_release(vertex_triangles *s)
{
    free(s->first);
    free(s->triangle);
}

static bool vertex_triangles_make(vertex_triangles *s, const mw_mesh *mesh)
{
    uint32_t v[3], triangles = mw_mesh_triangle_count(mesh);
    size_t vertices = mw_mesh_vertex_count(mesh);
    *s = (vertex_triangles){.first = calloc(vertices + 2, sizeof *s->first),
                            .triangle = malloc(((size_t)triangles + 1) * 3 * sizeof *s->triangle)};
    if (!s->first || !s->triangle) return false;
    for (uint32_t t = 0; t < triangles; t++) {
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) s->first[v[k] + 2]++;
    }
    for (size_t i = 2; i < vertices + 2; i++) s->first[i] += s->first[i - 1];
    /* This moves first[v + 1] from the begin of v's triangles to their end. */
    for (uint32_t t = 0; t < triangles; t++) {
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) s->triangle[s->first[v[k] + 1]++] = t;
    }
    return true;
}

/* Of three points on one line: do b and c lie on the same side of a? */
static bool is_ahead(const double a[2], const double b[2], const double c[2])
{
    int k = c[0] == a[0];
    return b[k] > a[k] ? c[k] > a[k] : c[k] < a[k];
}

/* The other end of the edge that runs from a vertex towards q. MW_NONE if there is no such edge. */
static uint32_t tracer_edge_towards(const mw_mesh *mesh, const vertex_triangles *s, uint32_t vertex,
                                    const double q[2])
{
    double a[2], b[2];
    uint32_t v[3];
    mw_mesh_vertex(mesh, vertex, a);
    for (size_t i = s->first[vertex]; i < s->first[vertex + 1]; i++) {
        mw_mesh_triangle(mesh, s->triangle[i], v);
        for (int k = 0; k < 3; k++) {
            if (v[k] == vertex) continue;
            mw_mesh_vertex(mesh, v[k], b);
            if (mw_orient2d(a, b, q) == 0 && is_ahead(a, b, q)) return v[k];
        }
    }
    return MW_NONE;
}

static bool traced_constraints_add(traced_constraints *traced, uint32_t from, uint32_t to)
{
    if (traced->count == traced->room) {
        size_t room = traced->room ? 2 * traced->room : 64;
        uint32_t *vertex = realloc(traced->vertex, 2 * room * sizeof *vertex);
        if (!vertex) return false;
        traced->vertex = vertex;
        traced->room = room;
    }
    traced->vertex[2 * traced->count] = from;
    traced->vertex[2 * traced->count++ + 1] = to;
    return true;
}

/* Follows the constraints of a file through a mesh. */
typedef struct constraint_tracer {
    const char *path, *mesh_path;
    uint32_t threads;
    const mw_constraint_file *file;
    const mw_mesh *mesh;
    mw_locator *locator;
    mw_cursor cursor;
    vertex_triangles triangles;
} constraint_tracer;

static int tracer_fail_missing(const constraint_tracer *s, size_t segment, const char *what,
                               const double at[2])
{
    text position = {0};
    text_double(&position, at[0]);
    text_string(&position, " ");
    text_double(&position, at[1]);
    complain("%s: %s %" PRIu32 ": %s %.*s is not in %s", s->path, s->file->record_name,
             s->file->record[segment], what, (int)position.size,
             position.failed ? "" : position.bytes, s->mesh_path);
    text_release(&position);
    return END_INPUT;
}

/* The vertex at a point. MW_NONE if there is none. */
static uint32_t tracer_vertex_at(constraint_tracer *s, const double p[2])
{
    uint32_t v[3];
    mw_location at = mw_locate(s->locator, &s->cursor, p[0], p[1]);
    if (at.where != MW_ON_VERTEX) return MW_NONE;
    mw_mesh_triangle(s->mesh, at.triangle, v);
    return v[at.local];
}

static int tracer_follow_segment(constraint_tracer *s, size_t segment, traced_constraints *traced)
{
    const uint32_t *ends = s->file->segments + 2 * segment;
    const double *p = s->file->points + 3 * (size_t)ends[0],
                 *q = s->file->points + 3 * (size_t)ends[1];
    uint32_t at = tracer_vertex_at(s, p), last = tracer_vertex_at(s, q), next;
    if (at == MW_NONE) return tracer_fail_missing(s, segment, "the vertex at", p);
    if (last == MW_NONE) return tracer_fail_missing(s, segment, "the vertex at", q);
    for (; at != last; at = next) {
        double from[2];
        mw_mesh_vertex(s->mesh, at, from);
        next = tracer_edge_towards(s->mesh, &s->triangles, at, q);
        if (next == MW_NONE) return tracer_fail_missing(s, segment, "the edge from", from);
        if (!traced_constraints_add(traced, at, next)) return fail_memory();
    }
    return 0;
}

static int tracer_follow_all(constraint_tracer *s, traced_constraints *traced)
{
    mw_error error;
    if (!vertex_triangles_make(&s->triangles, s->mesh)) return fail_memory();
    mw_locator_options options = {.threads = s->threads, .progress = progress_of_call()};
    if (mw_locator_create(s->mesh, &options, &s->locator, &error) != MW_OK)
        return fail_mesh(s->mesh_path, &error);
    int end =
        mw_cursor_init(s->locator, NULL, &s->cursor, &error) == MW_OK ? 0 : fail_query(&error);
    for (size_t i = 0; end == 0 && i < s->file->segment_count; i++)
        end = tracer_follow_segment(s, i, traced);
    return end;
}

int traced_constraints_read(traced_constraints *traced, const char *path,
                            const common_settings *common, const mw_mesh *mesh,
                            const char *mesh_path, const char *mesh_crs)
{
    mw_constraint_file file;
    *traced = (traced_constraints){0};
    int end = constraint_file_read(path, (constraint_file_options){.quiet = common->quiet}, &file);
    if (end) return end;
    progress_phase("preparing", mesh_path);
    constraint_tracer s = {.path = path,
                           .mesh_path = mesh_path,
                           .file = &file,
                           .mesh = mesh,
                           .threads = common->threads};
    end = vertex_crs_move_constraints(common, path, &file, mesh_path, mesh_crs);
    if (end == 0) end = tracer_follow_all(&s, traced);
    mw_locator_destroy(s.locator);
    vertex_triangles_release(&s.triangles);
    mw_constraint_file_release(&file);
    return end;
}

void traced_constraints_release(traced_constraints *traced)
{
    free(traced->vertex);
    *traced = (traced_constraints){0};
}
