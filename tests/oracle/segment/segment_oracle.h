/* segment_oracle.h - the pieces of a segment by brute force over all triangles, in exact rationals
 * (GMP). */
#ifndef MW_TESTS_ORACLE_SEGMENT_ORACLE_H
#define MW_TESTS_ORACLE_SEGMENT_ORACLE_H

#include <meshwalk/segment.h>
#include <stdbool.h>

/* All pieces of the segment from a to b in `count` triangles (three vertices each, points packed).
 * Parameters are rounded from the exact ones. Returns how many there are; at most `room` are
 * written. */
size_t segment_oracle_pieces(const double *points, const uint32_t *triangles, uint32_t count,
                             const double a[2], const double b[2], mw_segment_piece *pieces,
                             size_t room);

/* Are these the pieces of the segment? Everything exactly, parameters within 2^-40 of themselves,
 * in order, and equal where pieces follow each other. If not, prints what differs to stderr and
 * returns false. */
bool segment_oracle_agrees(const double *points, const uint32_t *triangles, uint32_t count,
                           const double a[2], const double b[2], const mw_segment_piece *pieces,
                           size_t piece_count);

#endif
