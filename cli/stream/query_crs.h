/* query_crs.h - coordinate systems of queries and meshes: chosen, compared, transformed. */
#ifndef MW_CLI_STREAM_QUERY_CRS_H
#define MW_CLI_STREAM_QUERY_CRS_H

#include "cli/gdal/gdal_transform.h"
#include "cli/input/query_source.h"

/* What a command asks about, as far as coordinate systems go. */
typedef enum query_domain {
    QUERIES_IN_SPACE,  /* a surface in space: coordinates are taken as they are */
    QUERIES_BY_LONLAT, /* directions by longitude and latitude, of whatever datum */
    QUERIES_IN_PLANE,  /* a mesh, which may have a coordinate system */
} query_domain;

typedef struct query_crs_settings {
    query_domain domain;
    const char *mesh, *mesh_crs; /* the path of the mesh, and its system; NULL: not known */
    const char *option;          /* --points-crs; NULL: not given */
    bool heights;                /* are values of the mesh answered, which may be heights? */
    bool quiet;
} query_crs_settings;

typedef struct query_crs {
    gdal_transform *transform; /* NULL: the queries are taken as they stand */
    const char *of_rows;       /* the system of the queries as they stand; NULL: not known */
    /* that system comes from a file or an option; it is not an assumption */
    bool told;
    uint64_t lost; /* queries without a position in the system of the mesh */
} query_crs;

/* Refuse options before anything is read. Returns 0, or an exit code after a complaint. */
int query_crs_check(const char *mesh_option, const char *points_option);

/* Which columns the options and the mesh's system mean, if several fit. */
query_preference query_crs_prefers(const query_crs_settings *settings);

/* Decide how the queries of `source` are transformed to the system of the mesh. Assumptions and
 * unknown systems are reported on standard error. Returns 0, or an exit code after a complaint;
 * close it in both cases. The texts of `settings` and of the source last until then. */
int query_crs_open(query_crs *c, const query_crs_settings *settings, const char *points,
                   const query_source *source);
void query_crs_close(query_crs *c);

#endif
