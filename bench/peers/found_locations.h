/* found_locations.h - the locations that an engine of ours finds, and the answers in them. */
#ifndef MW_BENCH_PEERS_FOUND_LOCATIONS_H
#define MW_BENCH_PEERS_FOUND_LOCATIONS_H

#include <meshwalk/meshwalk.h>

#include <stdbool.h>
#include <stddef.h>

typedef struct found_locations {
    mw_location *at;
    size_t room;
} found_locations;

/* Make room for n locations. The memory is touched before timing starts. */
bool found_locations_reserve(found_locations *found, size_t n);
/* Write the triangles of the first n locations as answers of an engine. */
void found_locations_take(const found_locations *found, size_t n, uint64_t *answers);

#endif
