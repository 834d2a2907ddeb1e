/* Any bytes as legacy VTK. */
#include "reader.h"

#include "io/grid/grid_readers.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_mesh_reader(mw__read_vtk, "input.vtk", data, size);
    return 0;
}
