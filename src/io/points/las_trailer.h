/* las_trailer.h - the records behind the points of LAS 1.4. Private. */
#ifndef MW_SRC_IO_POINTS_LAS_TRAILER_H
#define MW_SRC_IO_POINTS_LAS_TRAILER_H

#include "base/base.h"

/* Where the records stand, by the header. */
typedef struct mw_las_trailer {
    uint64_t begin;
    uint32_t count; /* of the records; not trusted */
} mw_las_trailer;

/* Find the coordinate system among the extended variable length records of a file. The file is
 * opened a second time, so it may be compressed, but it cannot be a pipe. The caller releases *wkt
 * with free(); it is NULL if there is none, or if the file ends before. */
mw_status mw__las_trailer_wkt(const char *path, mw_las_trailer trailer, char **wkt,
                              mw_error *error);

#endif
