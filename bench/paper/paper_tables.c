/* paper_tables.c - the tables of the thesis that can be measured again, and what their columns
 * mean. */
#include "bench/paper/paper_tables.h"
#include "cli/frame/message.h"
#include "cli/frame/spelling.h"

#include <string.h>
#include <strings.h>

static const algorithm remembering = {
    .name = "remembering", .abbreviation = "RW", .walk = "remembering"};
static const algorithm stochastic = {
    .name = "stochastic", .abbreviation = "RSW", .walk = "stochastic"};
static const algorithm barycentric = {
    .name = "barycentric", .abbreviation = "BW", .walk = "barycentric"};
static const algorithm straight = {.name = "straight", .abbreviation = "SW", .walk = "straight"};
static const algorithm normal_straight = {
    .name = "normal-straight", .abbreviation = "NSW", .walk = "normal-straight"};
static const algorithm orthogonal = {
    .name = "orthogonal", .abbreviation = "OW", .walk = "orthogonal"};
static const algorithm improved_orthogonal = {
    .name = "improved-orthogonal", .abbreviation = "IOW", .walk = "improved-orthogonal"};
static const algorithm improved_orthogonal_vertex = {.name = "improved-orthogonal-vertex",
                                                     .abbreviation = "IOW",
                                                     .walk = "improved-orthogonal-vertex"};
static const algorithm hybrid = {.name = "hybrid", .abbreviation = "HW", .walk = "hybrid"};
static const algorithm direct_computed = {
    .name = "direct-dw2", .abbreviation = "DW2", .walk = "direct"};
static const algorithm direct_stored = {.name = "direct-dw1",
                                        .abbreviation = "DW1",
                                        .walk = "direct",
                                        .preparation = FILLED_WITH_AREAS};

/* Appendix C, Table 2: the direct walk goes down through the layers at the vertex of the largest
 * coordinate; beside it, as the others do, at the nearest. */
static const algorithm layers_computed = {.name = "direct-dw2",
                                          .abbreviation = "DW2",
                                          .walk = "direct",
                                          .descent = MW_DESCENT_COORDINATE};
static const algorithm layers_stored = {.name = "direct-dw1",
                                        .abbreviation = "DW1",
                                        .walk = "direct",
                                        .preparation = FILLED_WITH_AREAS,
                                        .descent = MW_DESCENT_COORDINATE};
static const algorithm layers_nearest = {.name = "direct-nearest",
                                         .abbreviation = "",
                                         .walk = "direct",
                                         .preparation = FILLED_WITH_AREAS,
                                         .descent = MW_DESCENT_NEAREST};

/* Appendix D: the mesh as it is; and beside it, on the same mesh with its pockets and holes filled,
 * two that need that. */
static const algorithm border = {
    .name = "border", .abbreviation = "", .walk = "border", .preparation = UNFILLED};
static const algorithm filled_straight = {
    .name = "straight-filled", .abbreviation = "", .walk = "straight"};
static const algorithm filled_auto = {.name = "auto-filled", .abbreviation = "", .walk = "auto"};
static const algorithm mesh = {.name = "mesh", .abbreviation = ""};

/* Appendix E, Table 1: one walk in four triangulations. */
static const algorithm delaunay = {.name = "delaunay", .abbreviation = "DT", .walk = "stochastic"};
static const algorithm greedy = {
    .name = "greedy", .abbreviation = "GT", .walk = "stochastic", .kind = MW_KIND_GREEDY};
static const algorithm min_weight = {
    .name = "min-weight", .abbreviation = "MWT", .walk = "stochastic", .kind = MW_KIND_MIN_WEIGHT};
static const algorithm min_max_angle = {.name = "min-max-angle",
                                        .abbreviation = "MMA",
                                        .walk = "stochastic",
                                        .kind = MW_KIND_MIN_MAX_ANGLE};
static const algorithm kinds = {.name = "kinds", .abbreviation = ""};

/* Appendix F, Table 1; and Table 2, whose rows are ways to begin. */
static const algorithm wu = {.name = "barycentric", .abbreviation = "WBW", .walk = "barycentric"};
static const algorithm spatial_forgetful = {
    .name = "forgetful", .abbreviation = "RSW", .walk = "forgetful"};
static const algorithm octahedron = {
    .name = "octahedron", .abbreviation = "WBW", .walk = "barycentric"};
static const algorithm grid = {.name = "grid", .abbreviation = "OW", .walk = "orthogonal"};
static const algorithm nonuniform_grid = {
    .name = "nonuniform-grid", .abbreviation = "OW", .walk = "orthogonal"};

/* Appendix G has one walk. */
static const algorithm plane = {.name = "plane", .abbreviation = "", .walk = "plane"};

#define SET(kind) (1u << DATASET_##kind)

#define ONE(quantity) (UINT64_C(1) << (quantity))
#define STAGES                                                                                     \
    (ONE(TRIANGLES_INIT) | ONE(TRIANGLES) | ONE(TRIANGLES_FINAL) | ONE(TRIANGLES_FINAL_MAX) |      \
     ONE(ORIENT_INIT) | ONE(ORIENT) | ONE(ORIENT_FINAL) | ONE(IMPLICIT) | ONE(COMPARISONS) |       \
     ONE(LAYERS))
#define STAR_STAGES                                                                                \
    (ONE(TRIANGLES_INIT) | ONE(TRIANGLES) | ONE(TRIANGLES_FINAL) | ONE(ORIENT_INIT) |              \
     ONE(ORIENT) | ONE(ORIENT_FINAL) | ONE(COMPARISONS) | ONE(TIME_EXACT_US))
#define PROBE_STAGES                                                                               \
    (ONE(SAMPLE) | ONE(FOUND_PER_MILLION) | ONE(TRIANGLES) | ONE(TRIANGLES_WALK_MAX) |             \
     ONE(ORIENT) | ONE(ORIENT_MAX) | ONE(INTERSECTIONS) | ONE(ITERATIONS) | ONE(ITERATIONS_MAX) |  \
     ONE(TIME_EXACT_US))
#define PROBE_SIZES                                                                                \
    {                                                                                              \
        154, 2904, 35946                                                                           \
    } /* those of the thesis' pawn, cow and bunny */
#define TIMES (ONE(TIME_US) | ONE(TIME_EXACT_US))

/* Appendix C calls its improved orthogonal walk OW. */
static const paper_table tables[] = {
    {.name = "A1",
     .title = "straight walk and normal-straight walk (App. A, Table 1)",
     .algorithms = {&remembering, &stochastic, &straight, &normal_straight},
     .reference = &straight,
     .finish = "stochastic",
     .start = "random",
     .from = "random triangles",
     .quantities = STAGES | TIMES,
     .sets = SET(UNIFORM) | SET(GRID) | SET(GAUSSIAN) | SET(CLUSTERS) | SET(ARCS),
     .sizes = {100000, 1000000},
     .drawn = TRIANGLES},
    {.name = "A2",
     .title = "final location of the normal-straight walk (App. A, Table 2)",
     .algorithms = {&normal_straight},
     .reference = &normal_straight,
     .finish = "stochastic",
     .start = "random",
     .from = "random triangles",
     .quantities = STAGES | TIMES,
     .sets = SET(UNIFORM) | SET(GRID) | SET(GAUSSIAN) | SET(CLUSTERS) | SET(ARCS),
     .sizes = {100000, 1000000},
     .drawn = TRIANGLES_FINAL},
    {.name = "B1",
     .title = "hybrid walk (App. B, Table I)",
     .algorithms = {&stochastic, &normal_straight, &improved_orthogonal, &hybrid, &straight},
     .reference = &normal_straight,
     .finish = "stochastic",
     .start = "random",
     .from = "random triangles",
     .quantities = STAGES | TIMES,
     .sets = SET(UNIFORM),
     .sizes = {10000, 100000, 1000000},
     .enclosed = true,
     .drawn = TRIANGLES},
    {.name = "B2",
     .title = "hybrid walk in a turned rectangle (App. B, Table II)",
     .algorithms = {&improved_orthogonal_vertex, &improved_orthogonal, &hybrid},
     .reference = &hybrid,
     .finish = "stochastic",
     .start = "random",
     .from = "random triangles",
     .quantities = STAGES | TIMES,
     .sets = SET(RECTANGLE),
     .sizes = {10000, 100000, 1000000},
     .drawn = TRIANGLES},
    {.name = "C1",
     .title = "direct walk (App. C, Table 1)",
     .algorithms = {&remembering, &stochastic, &barycentric, &straight, &improved_orthogonal,
                    &direct_computed, &direct_stored},
     .reference = &straight,
     .finish = "remembering",
     .start = "random",
     .from = "random triangles",
     .quantities = STAGES | TIMES,
     .sets = SET(UNIFORM),
     .sizes = {10000, 100000, 1000000},
     .enclosed = true,
     .drawn = TRIANGLES},
    {.name = "C2",
     .title = "direct walk in layers (App. C, Table 2)",
     .algorithms = {&remembering, &stochastic, &improved_orthogonal, &layers_computed,
                    &layers_stored, &layers_nearest},
     .reference = &remembering,
     .finish = "remembering",
     .start = "layers",
     .from = "layers",
     .quantities = STAGES | TIMES,
     .sets = SET(UNIFORM),
     .sizes = {100, 1000, 10000, 100000, 1000000, 10000000},
     .enclosed = true,
     .drawn = TRIANGLES},
    {.name = "D1",
     .title = "border walk in domains with holes (App. D, Table 1, Fig. 11 and 12)",
     .algorithms = {&border, &filled_straight, &filled_auto},
     .reference = &filled_straight,
     .start = "random",
     .from = "random triangles, or the nearest of a sample",
     .quantities = ONE(SAMPLE) | ONE(INSIDE_PERCENT) | ONE(WALK_RUNS) | ONE(TRIANGLES_INIT) |
                   ONE(TRIANGLES) | ONE(TRIANGLES_FINAL) | ONE(ORIENT_INIT) | ONE(ORIENT) |
                   ONE(ORIENT_FINAL) | ONE(TRIANGLES_WALK_MAX) | ONE(BORDER_RUNS) |
                   ONE(TRIANGLES_BORDER) | ONE(ORIENT_BORDER) | ONE(TRIANGLES_BORDER_MAX) |
                   ONE(BORDER_EDGES) | ONE(BORDER_EDGES_MAX) | ONE(TRIANGLES_TOTAL) |
                   ONE(LOCATOR_BYTES) | ONE(LOCATOR_SECONDS) | TIMES,
     .whole = &mesh,
     .whole_quantities =
         ONE(MESH_TRIANGLES) | ONE(MESH_BORDER_EDGES) | ONE(MESH_HOLES) | ONE(HULL_PERCENT),
     .subject = PAPER_DOMAINS,
     .drawn = TRIANGLES},
    {.name = "E1",
     .title = "kinds of triangulation (App. E, Table 1)",
     .algorithms = {&delaunay, &greedy, &min_weight, &min_max_angle},
     .reference = &delaunay,
     .start = "random",
     .from = "random triangles",
     .quantities = ONE(TRIANGLES) | ONE(ORIENT) | ONE(EDGE_LENGTH) | ONE(SIDE_LENGTH) |
                   ONE(LARGEST_ANGLE) | ONE(OPTIMAL) | ONE(TRIANGULATION_SECONDS),
     .whole = &kinds,
     .whole_quantities = ONE(CORRELATION),
     .sets = SET(UNIFORM),
     .sizes = {10000, 100000},
     .enclosed = true,
     .drawn = TRIANGLES},
    {.name = "E2",
     .title = "survey of the walks (App. E, Table 2 and Fig. 12)",
     .algorithms = {&remembering, &stochastic, &barycentric, &straight, &normal_straight,
                    &orthogonal, &improved_orthogonal},
     .reference = &straight,
     .finish = "stochastic",
     .start = "random",
     .from = "random triangles",
     .quantities = STAGES | TIMES,
     .sets = SET(UNIFORM),
     .sizes = {10000, 100000, 1000000},
     .enclosed = true,
     .drawn = TIME_EXACT_US},
    {.name = "F1",
     .title = "walks on star-shaped polyhedra (App. F, Table 1)",
     .algorithms = {&wu, &spatial_forgetful, &stochastic, &orthogonal, &straight},
     .reference = &spatial_forgetful,
     .start = "front",
     .from = "the facet at longitude 0, latitude 0",
     .finish = "forgetful",
     .quantities = STAR_STAGES,
     .whole = &mesh,
     .whole_quantities = ONE(MESH_TRIANGLES),
     .subject = PAPER_STARS,
     .sizes = {163842, 65538, 131074, 100000, 10000},
     .drawn = TRIANGLES},
    {.name = "F2",
     .title = "walks on star-shaped polyhedra from an index (App. F, Table 2)",
     .algorithms = {&octahedron, &grid, &nonuniform_grid},
     .reference = &octahedron,
     .start = "index",
     .from = "a subdivided octahedron or a grid",
     .finish = "forgetful",
     .quantities = STAR_STAGES | ONE(LOCATOR_BYTES) | ONE(LOCATOR_SECONDS),
     .whole = &mesh,
     .whole_quantities = ONE(MESH_TRIANGLES),
     .subject = PAPER_STARS,
     .sizes = {163842, 65538, 131074, 100000},
     .drawn = TRIANGLES},
    {.name = "G1",
     .title = "probes on the surface, along its inverted normals (App. G, Table 1)",
     .algorithms = {&plane},
     .reference = &plane,
     .start = "sample",
     .from = "the nearest of a sample",
     .quantities = PROBE_STAGES,
     .whole = &mesh,
     .whole_quantities = ONE(MESH_TRIANGLES),
     .subject = PAPER_SURFACES,
     .sizes = PROBE_SIZES,
     .variant = 1,
     .drawn = TRIANGLES},
    {.name = "G2",
     .title = "probes near the surface (App. G, Table 2)",
     .algorithms = {&plane},
     .reference = &plane,
     .start = "sample",
     .from = "the nearest of a sample",
     .quantities = PROBE_STAGES,
     .whole = &mesh,
     .whole_quantities = ONE(MESH_TRIANGLES),
     .subject = PAPER_SURFACES,
     .sizes = PROBE_SIZES,
     .variant = 2,
     .drawn = TRIANGLES},
    {.name = "G3",
     .title = "probes too far from the surface (App. G, Table 3)",
     .algorithms = {&plane},
     .reference = &plane,
     .start = "sample",
     .from = "the nearest of a sample",
     .quantities = PROBE_STAGES,
     .whole = &mesh,
     .whole_quantities = ONE(MESH_TRIANGLES),
     .subject = PAPER_SURFACES,
     .sizes = PROBE_SIZES,
     .variant = 3,
     .drawn = TRIANGLES},
};
#define TABLES (sizeof tables / sizeof *tables)

const paper_table *paper_table_named(const char *name)
{
    if (!name) {
        complain(
            "bench paper: which table? A1, A2, B1, B2, C1, C2, D1, E1, E2, F1, F2, G1, G2 or G3");
        return NULL;
    }
    spelling s = spelling_of(name);
    for (size_t i = 0; i < TABLES; i++) {
        if (strcasecmp(tables[i].name, name) == 0) return &tables[i];
        spelling_try(&s, tables[i].name);
    }
    spelling_complain(&s, "table", "");
    return NULL;
}

/* Columns that are sums of our quantities: the first then means what the column does
 * (docs/measurements/published-tables.md). */
static const struct {
    const char *table;
    const algorithm *algorithm;
    quantity sum, more;
    double shared; /* triangles counted in both */
} columns[] = {
    {"A1", &straight, TRIANGLES, TRIANGLES_INIT, 1},
    {"A1", &straight, ORIENT, ORIENT_INIT, 0},
    {"A1", &normal_straight, TRIANGLES, TRIANGLES_FINAL, 0},
    {"B1", &hybrid, TRIANGLES, TRIANGLES_INIT, 1},
    {"B2", &hybrid, TRIANGLES, TRIANGLES_INIT, 1},
    {"D1", &border, TRIANGLES_TOTAL, WALK_RUNS, 1},
    {"E2", &orthogonal, TRIANGLES, TRIANGLES_INIT, 1},
};

void paper_table_sum_columns(const paper_table *table, walk_outcome *o)
{
    for (size_t c = 0; c < sizeof columns / sizeof *columns; c++)
        for (size_t i = 0; table->algorithms[i] && strcmp(columns[c].table, table->name) == 0; i++)
            if (table->algorithms[i] == columns[c].algorithm)
                o->value[i][columns[c].sum] += o->value[i][columns[c].more] - columns[c].shared;
}
