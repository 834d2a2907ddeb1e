/* Any bytes as NPZ. */
#include "reader.h"

#include "io/grid/grid_readers.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    /* deflate packs up to 1032 bytes into one */
    fuzz_mesh_reader_to(mw__read_npz, "input.npz", data, size, 1032 * size);
    return 0;
}
