#include "cli/output/location_row.h"
#include "cli/output/csv_row.h"

static const char *location_base_name(int i)
{
    return (const char *[]){"0", "1", "file", NULL}[i];
}
const choices location_bases = {"base", location_base_name, NULL};

uint32_t location_row_base(int base, int first_number)
{
    return (uint32_t)(base == LOCATION_BASE_FILE ? first_number : base);
}

#define WEIGHTS "w0", "w1", "w2"
#define DETAILS "local", "border_triangle", "border_edge", "distance", "hole"
const location_answers location_row_answers[2][2] = {
    {{{"status", "triangle", WEIGHTS}, "tirrr"},
     {{"status", "triangle", "face", WEIGHTS}, "tiirrr"}},
    {{{"status", "triangle", WEIGHTS, DETAILS}, "tirrriiiri"},
     {{"status", "triangle", "face", WEIGHTS, DETAILS}, "tiirrriiiri"}}};

void location_row_write(text *out, const mw_location *where, uint32_t base, const uint32_t *faces)
{
    const bool found = where->triangle != MW_NONE;
    csv_row_status(out, mw_where_name((mw_where)where->where),
                   found ? where->triangle + base : MW_NONE);
    if (faces) csv_row_count(out, found, found ? faces[where->triangle] + base : 0);
    csv_row_weights(out, where->triangle, where->weight);
}

bool location_row_is_away(const mw_location *where)
{
    return where->where == MW_OUTSIDE || where->where == MW_IN_HOLE || where->where == MW_NEAR;
}

void location_row_details(text *out, const mw_location *where, const mw_nearest_border_point *hit,
                          uint32_t base)
{
    csv_row_count(out, where->local != 255, where->local);
    csv_row_count(out, hit, hit ? hit->triangle + base : 0);
    csv_row_count(out, hit, hit ? hit->edge : 0);
    csv_row_double(out, hit, hit ? hit->distance : 0);
    csv_row_count(out, where->hole != MW_NONE, where->hole);
}
