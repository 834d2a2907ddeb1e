/* replay.c - the main of a fuzz target without libFuzzer: the files it is given, then a fixed
 * sequence of random inputs. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { INPUTS = 5000, LONGEST = 512 };

static uint64_t next(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/* false if the file cannot be read. */
static int replay_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) return 0;
    uint8_t *data = NULL;
    size_t size = 0, got = 1;
    while (got > 0) {
        uint8_t *more = realloc(data, size + 65536);
        if (!more) break;
        data = more;
        got = fread(data + size, 1, 65536, file);
        size += got;
    }
    int read = data && !ferror(file) && feof(file);
    fclose(file);
    if (read) LLVMFuzzerTestOneInput(data, size);
    free(data);
    return read;
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        if (replay_file(argv[i])) continue;
        fprintf(stderr, "%s: cannot be read\n", argv[i]);
        return 1;
    }
    uint64_t state = 88172645463325252;
    for (int i = 0; i < INPUTS; i++) {
        uint8_t data[LONGEST];
        size_t size = next(&state) % (LONGEST + 1);
        for (size_t k = 0; k < size; k++) data[k] = (uint8_t)(next(&state) >> 32);
        LLVMFuzzerTestOneInput(data, size);
    }
    return 0;
}
