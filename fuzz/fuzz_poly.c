/* Any bytes as Triangle's .poly. On "standard input", which names no .node file beside it. */
#include "reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_constraints(mw__read_poly, "-", "standard input:", data, size);
    return 0;
}
