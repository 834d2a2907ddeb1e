/* Any bytes as Selafin. */
#include "reader.h"

#include "io/grid/grid_readers.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_mesh_reader(mw__read_selafin, "input.slf", data, size);
    return 0;
}
