#include "cli/lines/line_query.h"
#include "cli/frame/message.h"
#include "cli/gdal/gdal_crs.h"
#include "cli/input/mesh_field.h"

#include <string.h>

const option line_query_options[] = {
    {"field", 0, OPTION_TEXT, offsetof(line_query_settings, field), "NAME",
     "the height: z or a field of MESH (default: z)", NULL},
    {"nodata", 0, OPTION_TEXT, offsetof(line_query_settings, nodata), "V",
     "vertices with the value V have none, as those with NaN; none: all others have one (default: "
     "-99999)",
     NULL},
    {"attribute", 0, OPTION_TEXT, offsetof(line_query_settings, lines.attribute), "LIST",
     "which attributes of the lines are kept, by GDAL (default: all)", NULL},
    {"layer", 0, OPTION_TEXT, offsetof(line_query_settings, lines.layer), "NAME",
     "of a vector file: the layer (default: the only one that may have lines or polygons)", NULL},
    {"columns", 0, OPTION_TEXT, offsetof(line_query_settings, lines.columns), "LIST",
     "of a table of points: the columns that hold x and y, as names or numbers from 1", NULL},
    {"crs", 0, OPTION_TEXT, offsetof(line_query_settings, crs), "CRS",
     "the coordinate system of MESH, as EPSG:2056 (default: what its file tells)", NULL},
    {"lines-crs", 0, OPTION_TEXT, offsetof(line_query_settings, lines.crs), "CRS",
     "that of LINES, or 'same' as MESH (default: what LINES tell). Lines in another system than "
     "MESH are transformed",
     NULL},
    {0},
};

int line_query_open(line_query *q, const line_query_settings *s, const char *const *operands,
                    const char *degrees)
{
    const char *name = s->field ? s->field : "z";
    point_query_settings query = {.stream = {.common = s->common}, .crs = s->crs, .lines = true};
    mesh_field_choice field = {.field = name, .quiet = s->common.quiet};
    *q = (line_query){.field = name};
    int end = nodata_parse("nodata", s->nodata, &field.nodata);
    if (end == 0 && s->lines.crs && strcmp(s->lines.crs, "same") != 0)
        end = crs_check_option("lines-crs", s->lines.crs);
    if (end) return end;
    end = point_query_open(&q->mesh, &query, operands, false, mesh_field_load, &field);
    if (end == 0)
        end =
            line_file_read(&q->lines, operands[1], &s->lines, &s->common, operands[0], q->mesh.crs);
    if (end) return end;
    q->mesh.settings = NULL; /* they do not outlive this call */
    q->values = mw_mesh_field(q->mesh.mesh, name);
    if (!s->common.quiet && q->mesh.crs && crs_is_lonlat(q->mesh.crs))
        complain("%s: warning: it is in longitudes and latitudes, so %s", q->mesh.path, degrees);
    return 0;
}

void line_query_release(line_query *q)
{
    line_file_release(&q->lines);
    point_query_release(&q->mesh);
}
