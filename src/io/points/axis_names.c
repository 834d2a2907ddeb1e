/* The names by which tables call coordinates. The order is that of mw_axis_names_at; where a table
 * has several, mw_point_reader_open takes the first. */
#include "io/points/axis_names.h"

#include <string.h>

static const mw_axis_names sets[] = {
    {.axis = {"x", "y", "z"}},
    {.axis = {"lon", "lat", "z"}, .lonlat = 1},
    {.axis = {"longitude", "latitude", "z"}, .lonlat = 1},
    {.axis = {"easting", "northing", "z"}},
    {.axis = {"long", "lat", "z"}, .lonlat = 1},
    {.axis = {"lng", "lat", "z"}, .lonlat = 1},
    {.axis = {"decimalLongitude", "decimalLatitude", "z"}, .lonlat = 1},
    {.axis = {"eastings", "northings", "z"}},
    {.axis = {"east", "north", "z"}},
    {.axis = {"E", "N", "z"}},
    {.axis = {"point_x", "point_y", "point_z"}},
    {.axis = {"x_coord", "y_coord", "z_coord"}},
    {.axis = {"coord_x", "coord_y", "coord_z"}},
    {.axis = {"x_coordinate", "y_coordinate", "z_coordinate"}},
    {.axis = {"utm_x", "utm_y", "z"}},
    {.axis = {"x_utm", "y_utm", "z"}},
    {.axis = {"utm_easting", "utm_northing", "z"}},
    {.axis = {"rechtswert", "hochwert", "z"}},
    {.axis = {"laenge", "breite", "z"}, .lonlat = 1},
};

const mw_axis_names *mw_axis_names_at(size_t i)
{
    return i < sizeof sets / sizeof *sets ? &sets[i] : NULL;
}

static bool char_is_ignored(char c)
{
    return c == ' ' || c == '_' || c == '-' || c == '.';
}

static char char_lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c | 0x20) : c;
}

/* A unit in brackets may follow the name. */
int mw_axis_name_matches(const char *column, const char *name)
{
    for (;; column++, name++) {
        while (char_is_ignored(*column)) column++;
        while (char_is_ignored(*name)) name++;
        if (!*name) return !*column || *column == '(' || *column == '[';
        if (char_lower(*column) != char_lower(*name)) return 0;
    }
}

bool mw__axis_name_known(const char *column)
{
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++)
        for (int k = 0; k < 3; k++)
            if (mw_axis_name_matches(column, sets[i].axis[k])) return true;
    return false;
}
