/* Any bytes as PLY. */
#include "reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_mesh_reader(mw__read_ply, "input.ply", data, size);
    return 0;
}
