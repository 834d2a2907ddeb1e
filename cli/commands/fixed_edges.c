#include "cli/commands/fixed_edges.h"
#include "cli/input/constraints.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"
#include "cli/frame/text.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdlib.h>

/* The triangles of each vertex: those of vertex v are triangle[first[v]] to triangle[first[v + 1] - 1]. */
typedef struct stars {
    size_t *first;
    uint32_t *triangle;
} stars;

static void stars_release(stars *s)
{
    free(s->first);
    free(s->triangle);
}

static bool stars_make(stars *s, const mw_mesh *mesh)
{
    uint32_t v[3], triangles = mw_mesh_triangle_count(mesh);
    size_t vertices = mw_mesh_vertex_count(mesh);
    *s = (stars){.first = calloc(vertices + 2, sizeof *s->first),
                 .triangle = malloc(((size_t)triangles + 1) * 3 * sizeof *s->triangle)};
    if (!s->first || !s->triangle) return false;
    for (uint32_t t = 0; t < triangles; t++) {
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) s->first[v[k] + 2]++;
    }
    for (size_t i = 2; i < vertices + 2; i++) s->first[i] += s->first[i - 1];
    for (uint32_t t = 0; t < triangles; t++) { /* which moves the begin of each on to its end, that of the next one */
        mw_mesh_triangle(mesh, t, v);
        for (int k = 0; k < 3; k++) s->triangle[s->first[v[k] + 1]++] = t;
    }
    return true;
}

/* Does b lie on the same side of a as c, of three points in line? */
static bool is_ahead(const double a[2], const double b[2], const double c[2])
{
    int k = c[0] == a[0];
    return b[k] > a[k] ? c[k] > a[k] : c[k] < a[k];
}

/* Where the edge ends that begins at a vertex and runs towards q; MW_NONE: there is none. */
static uint32_t edge_towards(const mw_mesh *mesh, const stars *s, uint32_t vertex, const double q[2])
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

static bool add_edge(fixed_edges *e, uint32_t from, uint32_t to)
{
    if (e->count == e->room) {
        size_t room = e->room ? 2 * e->room : 64;
        uint32_t *vertex = realloc(e->vertex, 2 * room * sizeof *vertex);
        if (!vertex) return false;
        e->vertex = vertex;
        e->room = room;
    }
    e->vertex[2 * e->count] = from;
    e->vertex[2 * e->count++ + 1] = to;
    return true;
}

/* A file of constraints that is being followed through a mesh. */
typedef struct search {
    const char *path, *mesh_path;
    const mw_constraint_file *file;
    const mw_mesh *mesh;
    mw_locator *locator;
    mw_cursor cursor;
    stars stars;
} search;

static int not_there(const search *s, size_t segment, const char *what, const double at[2])
{
    text place = {0};
    text_double(&place, at[0]);
    text_string(&place, " ");
    text_double(&place, at[1]);
    complain("%s: %s %" PRIu32 ": %s %.*s is not in %s", s->path, s->file->record_name, s->file->record[segment], what,
             (int)place.size, place.failed ? "" : place.bytes, s->mesh_path);
    text_release(&place);
    return END_INPUT;
}

/* The vertex at a place, MW_NONE if there is none. */
static uint32_t vertex_at(search *s, const double p[2])
{
    uint32_t v[3];
    mw_location at = mw_locate(s->locator, &s->cursor, p[0], p[1]);
    if (at.where != MW_ON_VERTEX) return MW_NONE;
    mw_mesh_triangle(s->mesh, at.triangle, v);
    return v[at.local];
}

static int follow(search *s, size_t segment, fixed_edges *e)
{
    const uint32_t *ends = s->file->segments + 2 * segment;
    const double *p = s->file->points + 3 * (size_t)ends[0], *q = s->file->points + 3 * (size_t)ends[1];
    uint32_t at = vertex_at(s, p), last = vertex_at(s, q), next;
    if (at == MW_NONE) return not_there(s, segment, "the vertex at", p);
    if (last == MW_NONE) return not_there(s, segment, "the vertex at", q);
    for (; at != last; at = next) {
        double from[2];
        mw_mesh_vertex(s->mesh, at, from);
        next = edge_towards(s->mesh, &s->stars, at, q);
        if (next == MW_NONE) return not_there(s, segment, "the edge from", from);
        if (!add_edge(e, at, next)) return fail_memory();
    }
    return 0;
}

static int follow_all(search *s, fixed_edges *e)
{
    mw_error error;
    if (!stars_make(&s->stars, s->mesh)) return fail_memory();
    if (mw_locator_create(s->mesh, NULL, &s->locator, &error) != MW_OK) return fail_mesh(s->mesh_path, &error);
    int end = mw_cursor_init(s->locator, NULL, &s->cursor, &error) == MW_OK ? 0 : fail_query(&error);
    for (size_t i = 0; end == 0 && i < s->file->segment_count; i++) end = follow(s, i, e);
    return end;
}

int fixed_edges_read(fixed_edges *e, const char *path, const mw_mesh *mesh, const char *mesh_path)
{
    mw_constraint_file file;
    *e = (fixed_edges){0};
    int end = constraints_read(path, &file);
    if (end) return end;
    progress_phase("preparing", mesh_path);
    search s = {.path = path, .mesh_path = mesh_path, .file = &file, .mesh = mesh};
    end = follow_all(&s, e);
    mw_locator_destroy(s.locator);
    stars_release(&s.stars);
    mw_constraint_file_release(&file);
    return end;
}

void fixed_edges_release(fixed_edges *e)
{
    free(e->vertex);
    *e = (fixed_edges){0};
}
