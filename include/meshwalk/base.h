/* base.h - what every part of the interface uses: linkage, statuses, errors.
 *
 * Functions that can fail return a mw_status; 0 is success. Where a function takes a `mw_error *`, the caller owns it,
 * may pass NULL, and finds in it after a failure what was wrong and where. The library keeps no global state, never
 * prints, and never ends the program.
 *
 * Initialise structures of options with = {0}, which selects the defaults, then set what differs. Their `reserved`
 * members must stay zero: a structure where one is not is refused (MW_ERROR_ARGUMENT), so that later versions can use
 * these members without changing what today's programs mean. */
#ifndef MESHWALK_BASE_H
#define MESHWALK_BASE_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) || !defined(__GNUC__)
#define MW_API
#else
#define MW_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* "No triangle", "no vertex", "no hole": the value of every 32-bit index that names nothing. */
#define MW_NONE UINT32_MAX

/* Most triangles and most vertices of one mesh: a link packs 4 * triangle + edge into 32 bits. */
#define MW_MAX_TRIANGLES ((uint32_t)1 << 30)
#define MW_MAX_VERTICES (UINT32_MAX - 1)

typedef enum mw_status {
    MW_OK = 0,
    MW_ERROR_ARGUMENT, /* the call itself is wrong: NULL, an unknown name, a stride too small          */
    MW_ERROR_INPUT,    /* the data is wrong: unreadable, malformed, a mesh with a defect                */
    MW_ERROR_MEMORY,   /* an allocation failed                                                          */
    MW_ERROR_LIMIT,    /* the data is larger than the library can hold: more than MW_MAX_TRIANGLES, ... */
    MW_ERROR_SYSTEM,   /* the operating system refused: a file that cannot be opened or written         */
    MW_STATUS_COUNT
} mw_status;

/* What went wrong and where. Indices are in the user's numbering, -1 where they do not apply. */
typedef struct mw_error {
    mw_status status;
    int64_t triangle;
    int64_t vertex;
    int64_t line; /* line of a text file, 1-based */
    char message[512];
} mw_error;

/* A short English text for a status, never NULL. Thread-safe. */
MW_API const char *mw_status_text(mw_status status);

/* The version of the linked library, "MAJOR.MINOR.PATCH". Thread-safe. */
MW_API const char *mw_version(void);

#ifdef __cplusplus
}
#endif
#endif
