/* scan_batch_data.h - some small triangles, and what is computed of them. */
#ifndef MW_CLI_RASTER_SCAN_BATCH_DATA_H
#define MW_CLI_RASTER_SCAN_BATCH_DATA_H

#include "cli/raster/scan_triangle.h"

/* Triangles of a batch; the pixels of a small triangle, 0 .. 31 as shifts need them; and rows of a
 * strip that has batches. */
enum { SCAN_BATCH = 16, SCAN_BATCH_COLUMNS = 31, SCAN_BATCH_ROWS = 64 };

typedef struct scan_batch scan_batch;
typedef void scan_batch_work(scan_batch *batch, const scan_strip *strip);

/* Member [k][i] is that of corner k, or of side k, of triangle i. */
struct scan_batch {
    scan_batch_work *work; /* fills all its triangles */
    uint32_t count;
    uint32_t number[SCAN_BATCH];
    const scan_vertex *corner[SCAN_BATCH][3];
    double x[3][SCAN_BATCH], y[3][SCAN_BATCH], value[3][SCAN_BATCH];
    double row[3][SCAN_BATCH]; /* scan_vertex.row */
    double first[SCAN_BATCH];  /* row of the strip that the triangle reaches into */
    double rows[SCAN_BATCH];   /* how many */
    double at[SCAN_BATCH];     /* northing of the first */
    /* What is computed of these. */
    int64_t small[SCAN_BATCH];     /* 0: the triangle is left to scan_triangle.h */
    double column[SCAN_BATCH];     /* the first that it may reach into */
    double columns[SCAN_BATCH];    /* how many, 0 .. SCAN_BATCH_COLUMNS */
    double middle[SCAN_BATCH];     /* so many rows are above the middle corner */
    float start[2][2][SCAN_BATCH]; /* [east][lower]: where the western and the eastern side, */
    float step[2][2][SCAN_BATCH];  /* above and below the middle corner, cross row k: at column
                                        * start + k * step - 1 from `column` */
    float clear[SCAN_BATCH];       /* a crossing is sure that lies nearer to the middle between
                                        * two centres */
    double low[SCAN_BATCH];        /* the plane at the northern corner, less and plus the bound */
    double high[SCAN_BATCH];       /* for its error */
    double north[SCAN_BATCH];      /* how it rises for each unit */
    double east[SCAN_BATCH];       /* of length */
    double from[2][SCAN_BATCH];    /* the northern corner */
};

#endif
