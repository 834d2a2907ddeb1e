/* cache.c - how large the caches of the processor are.
 *
 * Each call asks the C library anew, because this library keeps no state. */
#include "base/cache.h"
#include "base/posix.h"

enum {
    SECOND = 1 << 19, /* assumed where the system does not say */
    SHARE = 8         /* a core's part of the last cache, in second-level caches */
};

/* 0: not known. */
static size_t second_level_bytes(void)
{
#ifdef _SC_LEVEL2_CACHE_SIZE
    long bytes = sysconf(_SC_LEVEL2_CACHE_SIZE);
    if (bytes > 0) return (size_t)bytes;
#endif
    return 0;
}

static size_t third_level_bytes(void)
{
#ifdef _SC_LEVEL3_CACHE_SIZE
    long bytes = sysconf(_SC_LEVEL3_CACHE_SIZE);
    if (bytes > 0) return (size_t)bytes;
#endif
    return 0;
}

/* The system reports the size of the whole third-level cache, some systems that of all processors
 * together. This is the share of one core: about eight second-level caches (256 KiB and 2 MiB, 512
 * KiB and 4 MiB, 2 MiB and 16 MiB). */
mw_caches mw__caches(void)
{
    size_t second = second_level_bytes(), third = third_level_bytes();
    if (second == 0) second = SECOND;
    size_t share = SHARE * second;
    return (mw_caches){.second = second, .reach = third >= second && third < share ? third : share};
}
