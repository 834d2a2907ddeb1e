/* Any bytes as ADCIRC's fort.14. */
#include "reader.h"

#include "io/grid/grid_readers.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_mesh_reader(mw__read_fort14, "input.14", data, size);
    return 0;
}
