/* Any bytes as STL. */
#include "reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_mesh_reader(mw__read_stl, "input.stl", data, size);
    return 0;
}
