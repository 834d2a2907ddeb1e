#include "bench/core/answers.h"
#include "cli/frame/message.h"

int locations_compare(const char *data, const double *queries, size_t n, const locations_pair *pair)
{
    for (size_t i = 0; i < n; i++) {
        const mw_location *a = &pair->found[i], *b = &pair->expected[i];
        if (a->triangle == b->triangle && a->where == b->where && a->hole == b->hole) continue;
        complain("%s: the walks %s and %s found different triangles at %.17g %.17g", data,
                 pair->way, pair->other, queries[2 * i], queries[2 * i + 1]);
        return END_RESOURCE;
    }
    return 0;
}
