/* paper_domain.c - thesis, App. D, Table 1: walks in meshes with pockets and holes.
 *
 * A row of the table is a place that queries are uniform in, the mesh or its convex hull, and a size of the sample that the
 * first triangle is taken from, 1 or the cube root of the vertices. The authors' meshes are not to be had: for each of them
 * one is made that has as many vertices and border edges, and fills as much of its hull. */
#include "bench/data/domains.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "bench/paper/paper.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The holes follow from the numbers of vertices, border edges and triangles by Euler's formula. Of the second mesh border
 * edges and holes are guesses: that line of the table is lost; its share is that of the queries inside. */
static const struct {
    const char *name;
    domain_shape shape;
} published[] = {
    {"cadastre", {4897, 163, 3, 0.7553}},    {"cadastre", {13829, 650, 10, 0.3626}},
    {"cadastre", {15819, 391, 11, 0.6516}},  {"cadastre", {19993, 472, 21, 0.6519}},
    {"cadastre", {41851, 862, 56, 0.7491}},  {"cadastre", {60234, 702, 30, 0.6871}},
    {"cadastre", {70428, 1270, 61, 0.5053}}, {"cad", {39721, 11708, 17, 0.7582}},
    {"cad", {78090, 12903, 7, 0.8259}},
};
#define PUBLISHED_DOMAINS (sizeof published / sizeof *published)

/* Other sizes look like land registers: border edges and holes as these have in the mean. */
static domain_shape usual_shape(size_t vertices)
{
    domain_shape shape = {vertices, (size_t)(3.4 * sqrt((double)vertices)), vertices / 1200 + (vertices >= 100), 0.65};
    if (shape.border_edges > vertices) shape.border_edges = vertices;
    return shape;
}

/* A mesh and the convex hull of its vertices, triangulated. */
typedef struct ground {
    mw_mesh *mesh, *hull;
    mw_mesh_info info;
    dataset corners; /* its used vertices */
} ground;

static void release(ground *g)
{
    dataset_release(&g->corners);
    mw_mesh_destroy(g->hull);
    mw_mesh_destroy(g->mesh);
}

static bool take_corners(ground *g)
{
    uint32_t count = mw_mesh_vertex_count(g->mesh);
    bool *used = calloc((size_t)count + 1, sizeof *used);
    g->corners.points = malloc(((size_t)count + 1) * 2 * sizeof(double));
    for (uint32_t i = 0; used && g->corners.points && i < mw_mesh_triangle_count(g->mesh); i++) {
        uint32_t v[3];
        mw_mesh_triangle(g->mesh, i, v);
        for (size_t k = 0; k < 3; k++) {
            if (!used[v[k]]) mw_mesh_vertex(g->mesh, v[k], g->corners.points + 2 * g->corners.count++);
            used[v[k]] = true;
        }
    }
    free(used);
    return used && g->corners.points;
}

static int survey(ground *g, const char *name)
{
    mw_error error;
    if (!take_corners(g)) return fail_memory();
    if (!dataset_bound(&g->corners, g->corners.count)) {
        complain("%s: the extent of the points is too large for a double", name);
        return END_INPUT;
    }
    if (mw_mesh_describe(g->mesh, &g->info, &error) != MW_OK ||
        mw_delaunay(g->corners.points, g->corners.count, 2, NULL, NULL, NULL, &g->hull, &error) != MW_OK)
        return fail_mesh(name, &error);
    return 0;
}

/* What the head of each part of the table tells of the mesh. */
static int add_facts(paper *p, const ground *g, const char *name, bool own)
{
    mw_error error;
    mw_mesh_info hull;
    if (mw_mesh_describe(g->hull, &hull, &error) != MW_OK) return fail_mesh(name, &error);
    paper_result *r = paper_add(p, name, own);
    if (!r) return fail_memory();
    r->whole = true;
    r->outcome.vertices = g->corners.count;
    r->outcome.whole[MESH_TRIANGLES] = g->info.triangles - g->info.flat_triangles;
    r->outcome.whole[MESH_BORDER_EDGES] = g->info.border_edges;
    r->outcome.whole[MESH_HOLES] = g->info.holes;
    r->outcome.whole[HULL_PERCENT] = 100 * g->info.area / hull.area;
    return 0;
}

static int measure_row(paper *p, const ground *g, const char *domain, bool own, bool in_hull, bool sampled)
{
    char name[256];
    snprintf(name, sizeof name, "%.230s-%s-%s", domain, in_hull ? "hull" : "mesh", sampled ? "sample" : "random");
    trial t = paper_trial(p, name, &g->corners, own);
    t.mesh = g->mesh;
    t.place = in_hull ? g->hull : NULL;
    t.start = sampled ? "sample" : "random";
    t.sample = (uint32_t)lround(cbrt((double)g->corners.count));
    int end = paper_measure(p, &t, own);
    if (end == 0) p->results[p->count - 1].outcome.vertices = g->corners.count;
    return end;
}

static int measure_ground(paper *p, ground *g, const char *name, bool own)
{
    int end = survey(g, name);
    if (end == 0) end = add_facts(p, g, name, own);
    for (int row = 0; row < 4 && end == 0; row++) end = measure_row(p, g, name, own, row & 1, row & 2);
    release(g);
    return end;
}

static int measure_shape(paper *p, const char *name, const domain_shape *shape)
{
    ground g = {0};
    mw_error error;
    progress_phase("making the domain", name);
    if (domain_make(shape, p->settings->common.seed, &g.mesh, &error) != MW_OK) return fail_mesh(name, &error);
    return measure_ground(p, &g, name, false);
}

static int measure_size(paper *p, size_t vertices)
{
    for (size_t i = 0; i < PUBLISHED_DOMAINS; i++)
        if (published[i].shape.vertices == vertices) return measure_shape(p, published[i].name, &published[i].shape);
    domain_shape shape = usual_shape(vertices);
    return measure_shape(p, "cadastre", &shape);
}

int paper_domains(paper *p, const size_t *sizes)
{
    int end = 0;
    for (size_t i = 0; i < PUBLISHED_DOMAINS && !sizes[0] && end == 0; i++)
        end = measure_shape(p, published[i].name, &published[i].shape);
    for (size_t i = 0; i < MOST_SIZES && sizes[i] && end == 0; i++) end = measure_size(p, sizes[i]);
    return end;
}

int paper_domain_file(paper *p, const char *path, const char *name)
{
    ground g = {0};
    mw_error error;
    mw_mesh_file file;
    progress_phase("reading", path);
    int end = files_read_mesh(path, &file);
    if (end) return end;
    mw_arrays arrays = mw_mesh_file_arrays(&file);
    mw_status status = mw_mesh_create(&arrays, NULL, &g.mesh, &error);
    mw_mesh_file_release(&file);
    return status == MW_OK ? measure_ground(p, &g, name, true) : fail_mesh(path, &error);
}
