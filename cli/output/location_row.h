/* location_row.h - the cells of a row that tells where a point lies: of `locate`, on one machine or
 * many. */
#ifndef MW_CLI_OUTPUT_LOCATION_ROW_H
#define MW_CLI_OUTPUT_LOCATION_ROW_H

#include "cli/frame/options.h"
#include "cli/frame/text.h"

#include <meshwalk/meshwalk.h>

/* --base: what triangles and faces are counted from. */
enum { LOCATION_BASE_0 = 0, LOCATION_BASE_1, LOCATION_BASE_FILE };
extern const choices location_bases;
uint32_t location_row_base(int base, int first_number);

/* Names of the answers, and what they hold, as in query_stream.h. */
typedef struct location_answers {
    const char *names[12];
    const char *kinds;
} location_answers;

/* [details][the mesh's file has other faces than triangles] */
extern const location_answers location_row_answers[2][2];

/* Status, triangle, face and weights; faces may be NULL. */
void location_row_write(text *out, const mw_location *where, uint32_t base, const uint32_t *faces);
/* The cells of --details; `hit` is the nearest border edge, or NULL. */
void location_row_details(text *out, const mw_location *where, const mw_nearest_border_point *hit,
                          uint32_t base);

/* Does a point with this status lie in no triangle, so that it has a nearest border edge? */
bool location_row_is_away(const mw_location *where);

#endif
