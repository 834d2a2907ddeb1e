/* locate - which triangle contains each point. */
#include "commands.h"
#include "message.h"
#include "query.h"

#include <math.h>
#include <string.h>

typedef struct locate_settings {
    query_settings query;
    bool details;
} locate_settings;

static const option locate_options[] = {
    {"details", 0, OPTION_FLAG, offsetof(locate_settings, details), NULL,
     "add the columns local (edge or vertex of the triangle), border_triangle, border_edge, distance (of points "
     "outside) and hole",
     NULL},
    {0},
};

/* A number or an empty cell, after a comma. */
static void cell(text *out, bool filled, uint32_t value)
{
    char digits[12];
    size_t at = sizeof digits;
    if (filled) {
        do {
            digits[--at] = (char)('0' + value % 10);
            value /= 10;
        } while (value);
    }
    digits[--at] = ',';
    text_bytes(out, digits + at, sizeof digits - at);
}

static void double_cell(text *out, bool filled, double value)
{
    text_bytes(out, ",", 1);
    if (filled) text_double(out, value);
}

/* The nearest border edge is told of points that are not in a triangle. */
static void details(const query *q, const double point[2], const mw_location *where, text *out)
{
    mw_border_hit hit = {0};
    bool away = where->where == MW_OUTSIDE || where->where == MW_IN_HOLE || where->where == MW_NEAR;
    if (away) away = mw_nearest_border(q->locator, point[0], point[1], &hit, NULL) == MW_OK;
    cell(out, where->local != 255, where->local);
    cell(out, away, hit.triangle);
    cell(out, away, hit.edge);
    double_cell(out, away, hit.distance);
    cell(out, where->hole != MW_NONE, where->hole);
}

static bool locate_row(const query *q, const void *self, const double point[2], const mw_location *where, text *out)
{
    const locate_settings *s = self;
    bool found = where->triangle != MW_NONE;
    text_double(out, point[0]);
    double_cell(out, true, point[1]);
    text_bytes(out, ",", 1);
    text_string(out, mw_where_name((mw_where)where->where));
    if (found)
        cell(out, true, where->triangle);
    else
        text_bytes(out, ",-1", 3);
    for (int k = 0; k < 3; k++) double_cell(out, found && !isnan(where->weight[k]), where->weight[k]);
    if (s->details) details(q, point, where, out);
    text_bytes(out, "\n", 1);
    return found;
}

static int run(const void *settings, const char *const *operands)
{
    const locate_settings *s = settings;
    query q;
    int end = query_open(&q, &s->query, operands, s->details, NULL, NULL);
    if (end == 0)
        end = query_run(&q, operands[1],
                        s->details ? "x,y,status,triangle,w0,w1,w2,local,border_triangle,border_edge,distance,hole\n"
                                   : "x,y,status,triangle,w0,w1,w2\n",
                        locate_row, s);
    query_release(&q);
    return end;
}

static const option *const tables[] = {locate_options, query_options, common_options, NULL};

const command locate_command = {
    .name = "locate",
    .operands = "MESH POINTS",
    .operand_count = 2,
    .summary = "find the triangle that contains each point",
    .description = "Writes one line for each point, in the order of POINTS: x,y,status,triangle,w0,w1,w2. The status "
                   "is inside, edge, vertex, outside, hole, near or bad; the triangle is its number in MESH, from 0, "
                   "or -1; w0, w1, w2 are the weights of its corners, empty where there is no triangle. A point on "
                   "an edge or a corner belongs to the lowest-numbered triangle that contains it. '-' is standard "
                   "input.",
    .options = tables,
    .settings_size = sizeof(locate_settings),
    .run = run,
};
