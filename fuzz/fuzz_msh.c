/* Any bytes as MSH of Gmsh. */
#include "reader.h"

#include "io/grid/grid_readers.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_mesh_reader(mw__read_msh, "input.msh", data, size);
    return 0;
}
