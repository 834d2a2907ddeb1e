/* Any bytes as GeoJSON. */
#include "reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_constraints(mw__read_geojson, "input.geojson", "input.geojson:", data, size);
    return 0;
}
