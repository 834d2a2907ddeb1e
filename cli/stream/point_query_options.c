#include "cli/stream/point_query_options.h"

static const char *walk_name(int i)
{
    return mw_walk_name((mw_walk_kind)i);
}
static const char *walk_help(int i)
{
    return mw_walk_help((mw_walk_kind)i);
}
static const char *start_name(int i)
{
    return mw_start_name((mw_start_kind)i);
}
static const char *start_help(int i)
{
    return mw_start_help((mw_start_kind)i);
}
static const char *arithmetic_name(int i)
{
    return i == MW_EXACT ? "exact" : i == MW_DOUBLE ? "double" : NULL;
}

const char *point_query_arithmetic(const point_query_settings *settings)
{
    return arithmetic_name(settings->arithmetic);
}

/* The walks that may finish those whose own tests only guide them. */
static const mw_walk_kind finishes[] = {MW_WALK_AUTO, MW_WALK_REMEMBERING, MW_WALK_STOCHASTIC};
static const char *finish_name(int i)
{
    return i < (int)(sizeof finishes / sizeof *finishes) ? mw_walk_name(finishes[i]) : NULL;
}

mw_walk_kind point_query_finish(const point_query_settings *settings)
{
    return finishes[settings->finish];
}

/* Whether pockets and holes are filled: by mw_fill_mode. */
static const char *fill_name(int i)
{
    static const char *const names[] = {
        [MW_FILL_AUTO] = "auto", [MW_FILL_YES] = "yes", [MW_FILL_NO] = "no", NULL};
    return names[i];
}

/* Where layers go down: by mw_descent. */
static const char *descent_name(int i)
{
    static const char *const names[] = {"auto", "nearest", "coordinate", NULL};
    return names[i];
}
static const char *descent_help(int i)
{
    static const char *const helps[] = {
        "the nearest", "the nearest, which makes the shorter walks",
        ("the one with the largest coordinate of the point, which --walk direct and "
         "barycentric know")};
    return helps[i];
}

const choices point_query_walks = {"walk", walk_name, walk_help};
const choices point_query_starts = {"start", start_name, start_help};
const choices point_query_descents = {"descent", descent_name, descent_help};
static const choices arithmetics = {"arithmetic", arithmetic_name, NULL};
static const choices fill_choices = {"way to fill", fill_name, NULL};
static const choices finish_choices = {"way to finish", finish_name, NULL};

const option point_query_options[] = {
    {"walk", 0, OPTION_CHOICE, offsetof(point_query_settings, walk), "NAME",
     "how to walk to the triangle (default: auto):", &point_query_walks},
    {"start", 0, OPTION_CHOICE, offsetof(point_query_settings, start), "NAME",
     "how to choose the first triangle (default: auto):", &point_query_starts},
    {"arithmetic", 0, OPTION_CHOICE, offsetof(point_query_settings, arithmetic), "NAME",
     "how walks decide their turns (default: exact); the triangle found is exact in either case:",
     &arithmetics},
    {"finish", 0, OPTION_CHOICE, offsetof(point_query_settings, finish), "NAME",
     "the walk that ends those whose own tests are only a guide (default: auto, by the mesh):",
     &finish_choices},
    {"fill", 0, OPTION_CHOICE, offsetof(point_query_settings, fill), "NAME",
     "fill pockets and holes of the mesh with triangles that count as outside, so that every walk "
     "can cross them; "
     "without "
     "them only --walk border finds its way (default: auto: no with --walk border, else yes):",
     &fill_choices},
    {"steps", 0, OPTION_COUNT, offsetof(point_query_settings, steps), "K",
     "--walk fast-stochastic: steps with one test (default: 0, estimated)", NULL},
    {"areas", 0, OPTION_FLAG, offsetof(point_query_settings, areas), NULL,
     "store the areas of the triangles, which saves tests with --walk direct", NULL},
    {"sample", 0, OPTION_SAMPLE, offsetof(point_query_settings, sample), "K",
     "--start sample: look at K random triangles; also cube-root (the default) or fourth-root, of "
     "the number of "
     "vertices",
     NULL},
    {"cells", 0, OPTION_COUNT, offsetof(point_query_settings, cells), "N",
     "--start grid, buckets, triangle-buckets, two-level-grid: about N cells, of the first level; "
     "curve: N samples "
     "(default: 0, by the size of "
     "the "
     "mesh)",
     NULL},
    {"layers", 0, OPTION_COUNT, offsetof(point_query_settings, layers), "N",
     "--start layers: N layers, the mesh itself counted (default: 0, by its size)", NULL},
    {"descent", 0, OPTION_CHOICE, offsetof(point_query_settings, descent), "NAME",
     "--start layers: the vertex at which to go down from one to the next (default: auto):",
     &point_query_descents},
    {"tolerance", 0, OPTION_LENGTH, offsetof(point_query_settings, tolerance), "D",
     "a point outside, at most D away from the mesh, is 'near' (default: 0)", NULL},
    {"columns", 0, OPTION_TEXT, offsetof(point_query_settings, stream.source.columns), "LIST",
     "columns of POINTS that hold x and y, as names or numbers from 1: lon,lat or 3,4 (default: "
     "those that the header names so, in one of the ways that the manual page lists, or the only "
     "two)",
     NULL},
    {"crs", 0, OPTION_TEXT, offsetof(point_query_settings, crs), "CRS",
     "the coordinate system of MESH, or of polygons, as EPSG:2056 (default: what their file tells)",
     NULL},
    {"points-crs", 0, OPTION_TEXT, offsetof(point_query_settings, stream.source.crs), "CRS",
     "that of POINTS, or 'same' as MESH (default: what POINTS tell; columns called lon and lat are "
     "WGS 84). "
     "Points in another system than MESH are transformed",
     NULL},
    {"trust", 0, OPTION_FLAG, offsetof(point_query_settings, trust), NULL,
     "do not check a prepared MESH (.mwm): only what is needed is read. For files of your own: "
     "with a damaged one the program may crash",
     NULL},
    {"any", 0, OPTION_FLAG, offsetof(point_query_settings, any), NULL,
     "accept a mesh that is not an embedding; a warning says which promise is void, and 'meshwalk "
     "view' shows the defects",
     NULL},
    {0},
};

const char *point_query_option_of_plane(const point_query_settings *q)
{
    return q->crs              ? "crs"
           : q->tolerance != 0 ? "tolerance"
           : q->sample         ? "sample"
           : q->steps          ? "steps"
           : q->cells          ? "cells"
           : q->layers         ? "layers"
           : q->walk           ? "walk"
           : q->start          ? "start"
           : q->arithmetic     ? "arithmetic"
           : q->finish         ? "finish"
           : q->fill           ? "fill"
           : q->descent        ? "descent"
           : q->areas          ? "areas"
           : q->any            ? "any"
           : q->trust          ? "trust"
                               : NULL;
}

int point_query_check_index(uint32_t cells, uint32_t layers)
{
    int end = options_limit("cells", cells, UINT32_C(1) << 30, "2^30");
    return end ? end : options_limit("layers", layers, MW_MAX_LAYERS, NULL);
}
