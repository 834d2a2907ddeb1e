/* paper_domains.c - thesis, App. D, Table 1: walks in meshes with pockets and holes.
 *
 * A row of the table is a region that queries are uniform in, the mesh or its convex hull, and a
 * size of the sample that the first triangle is taken from, 1 or the cube root of the vertices. The
 * authors' meshes are not to be had: for each of them one is made that has as many vertices and
 * border edges, and fills as much of its hull. */
#include "bench/paper/paper_domains.h"
#include "bench/data/domains.h"
#include "cli/frame/files.h"
#include "cli/frame/message.h"
#include "cli/frame/progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The holes follow from the numbers of vertices, border edges and triangles by Euler's formula. Of
 * the second mesh border edges and holes are guesses: that line of the table is lost; its share is
 * that of the queries inside. */
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
    domain_shape shape = {vertices, (size_t)(3.4 * sqrt((double)vertices)),
                          vertices / 1200 + (vertices >= 100), 0.65};
    if (shape.border_edges > vertices) shape.border_edges = vertices;
    return shape;
}

/* A mesh and the convex hull of its vertices, triangulated. */
typedef struct measured_domain {
    mw_mesh *mesh, *hull;
    mw_mesh_info info;
    dataset corners; /* its used vertices */
} measured_domain;

static void measured_domain_release(measured_domain *d)
{
    dataset_release(&d->corners);
    mw_mesh_destroy(d->hull);
    mw_mesh_destroy(d->mesh);
}

static bool measured_domain_take_corners(measured_domain *d)
{
    uint32_t count = mw_mesh_vertex_count(d->mesh);
    bool *used = calloc((size_t)count + 1, sizeof *used);
    d->corners.points = malloc(((size_t)count + 1) * 2 * sizeof(double));
    for (uint32_t i = 0; used && d->corners.points && i < mw_mesh_triangle_count(d->mesh); i++) {
        uint32_t v[3];
        mw_mesh_triangle(d->mesh, i, v);
        for (size_t k = 0; k < 3; k++) {
            if (!used[v[k]])
                mw_mesh_vertex(d->mesh, v[k], d->corners.points + 2 * d->corners.count++);
            used[v[k]] = true;
        }
    }
    free(used);
    return used && d->corners.points;
}

static int measured_domain_describe(measured_domain *d, const char *name)
{
    mw_error error;
    if (!measured_domain_take_corners(d)) return fail_memory();
    if (!dataset_bound(&d->corners, d->corners.count)) {
        complain("%s: the extent of the points is too large for a double", name);
        return END_INPUT;
    }
    if (mw_mesh_describe(d->mesh, NULL, &d->info, &error) != MW_OK ||
        mw_delaunay(d->corners.points, d->corners.count, 2, NULL, NULL, NULL, &d->hull, &error) !=
            MW_OK)
        return fail_mesh(name, &error);
    return 0;
}

/* What the head of each part of the table tells of the mesh. */
static int paper_add_domain(paper *p, const measured_domain *d, const char *name, bool users_file)
{
    mw_error error;
    mw_mesh_info hull;
    if (mw_mesh_describe(d->hull, NULL, &hull, &error) != MW_OK) return fail_mesh(name, &error);
    paper_result *r = paper_add(p, name, users_file);
    if (!r) return fail_memory();
    r->whole = true;
    r->outcome.vertices = d->corners.count;
    r->outcome.whole[MESH_TRIANGLES] = d->info.triangles - d->info.flat_triangles;
    r->outcome.whole[MESH_BORDER_EDGES] = d->info.border_edges;
    r->outcome.whole[MESH_HOLES] = d->info.holes;
    r->outcome.whole[HULL_PERCENT] = 100 * d->info.area / hull.area;
    return 0;
}

static int paper_measure_domain_row(paper *p, const measured_domain *d, const char *domain,
                                    bool users_file, bool in_hull, bool sampled)
{
    char name[256];
    snprintf(name, sizeof name, "%.230s-%s-%s", domain, in_hull ? "hull" : "mesh",
             sampled ? "sample" : "random");
    walk_trial t = paper_trial(p, name, &d->corners, users_file);
    t.mesh = d->mesh;
    t.region = in_hull ? d->hull : NULL;
    t.start = sampled ? "sample" : "random";
    t.sample = (uint32_t)lround(cbrt((double)d->corners.count));
    int end = paper_measure(p, &t, users_file);
    if (end == 0) p->results[p->count - 1].outcome.vertices = d->corners.count;
    return end;
}

static int paper_measure_domain(paper *p, measured_domain *d, const char *name, bool users_file)
{
    int end = measured_domain_describe(d, name);
    if (end == 0) end = paper_add_domain(p, d, name, users_file);
    for (int row = 0; row < 4 && end == 0; row++)
        end = paper_measure_domain_row(p, d, name, users_file, row & 1, row & 2);
    measured_domain_release(d);
    return end;
}

static int paper_measure_domain_shape(paper *p, const char *name, const domain_shape *shape)
{
    measured_domain d = {0};
    mw_error error;
    progress_phase("making the domain", name);
    if (domain_make(shape, p->settings->common.seed, &d.mesh, &error) != MW_OK)
        return fail_mesh(name, &error);
    return paper_measure_domain(p, &d, name, false);
}

static int paper_measure_domain_size(paper *p, size_t vertices)
{
    for (size_t i = 0; i < PUBLISHED_DOMAINS; i++)
        if (published[i].shape.vertices == vertices)
            return paper_measure_domain_shape(p, published[i].name, &published[i].shape);
    domain_shape shape = usual_shape(vertices);
    return paper_measure_domain_shape(p, "cadastre", &shape);
}

int paper_domains_made(paper *p, const size_t *sizes)
{
    int end = 0;
    for (size_t i = 0; i < PUBLISHED_DOMAINS && !sizes[0] && end == 0; i++)
        end = paper_measure_domain_shape(p, published[i].name, &published[i].shape);
    for (size_t i = 0; i < MOST_SIZES && sizes[i] && end == 0; i++)
        end = paper_measure_domain_size(p, sizes[i]);
    return end;
}

int paper_domains_file(paper *p, const char *path, const char *name)
{
    measured_domain d = {0};
    mw_error error;
    mw_mesh_file file;
    progress_phase("reading", path);
    int end = files_read_mesh(path, &file);
    if (end) return end;
    mw_arrays arrays = mw_mesh_file_arrays(&file);
    mw_status status = mw_mesh_create(&arrays, NULL, &d.mesh, &error);
    mw_mesh_file_release(&file);
    return status == MW_OK ? paper_measure_domain(p, &d, name, true) : fail_mesh(path, &error);
}
