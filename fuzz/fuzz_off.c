/* Any bytes as OFF. */
#include "reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_mesh_reader(mw__read_off, "input.off", data, size);
    return 0;
}
