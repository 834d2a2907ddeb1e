/* Any bytes as OBJ. */
#include "reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_mesh_reader(mw__read_obj, "input.obj", data, size);
    return 0;
}
