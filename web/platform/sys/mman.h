/* mman.h - files as memory. WASI's own header is an error: there are no maps, so all bytes of a
 * file are read at once. */
#ifndef MW_WEB_SYS_MMAN_H
#define MW_WEB_SYS_MMAN_H

#include <stdlib.h>
#include <unistd.h>

#define PROT_READ 1
#define MAP_SHARED 1
#define MAP_FAILED ((void *)-1)

static inline void *mmap(void *at, size_t size, int protection, int flags, int fd, off_t offset)
{
    char *bytes = aligned_alloc(64, (size + 63) / 64 * 64);
    size_t done = 0;
    (void)at, (void)protection, (void)flags, (void)offset;
    while (bytes && done < size) {
        ssize_t count = read(fd, bytes + done, size - done);
        if (count <= 0) break;
        done += (size_t)count;
    }
    if (done == size) return bytes;
    free(bytes);
    return MAP_FAILED;
}

static inline int munmap(void *bytes, size_t size)
{
    (void)size;
    free(bytes);
    return 0;
}

#endif
