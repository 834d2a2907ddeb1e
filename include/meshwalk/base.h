/* base.h - what every part of the interface uses: linkage, statuses, errors.
 *
 * Functions that can fail return a mw_status; 0 is success. Where a function takes a `mw_error *`, the caller owns it,
 * may pass NULL, and finds in it after a failure what was wrong and where. The library keeps no global state, never
 * prints, and never ends the program.
 *
 * Threads are made by the call that uses them, as many as its options say, and end with it: `threads` is the number, 1
 * makes none, 0 takes as many as there are processors for the process. Where the system refuses a thread, fewer do the
 * work. Results never depend on the number. Between calls the library has no threads, so a child made by fork() can use
 * it like its parent.
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
    MW_CANCELLED,      /* the caller's own mw_progress asked the call to stop                          */
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

/**
 * Called from time to time by a call that can take long, on the thread that made the call.
 *
 * @param context   mw_progress.context
 * @param stage     what is being done, such as "sorting points"; for people to read; valid during the call
 * @param fraction  how much of the whole call is done, from 0 to 1; never less than the time before. It is an estimate:
 *                  the rest may take more or less time than it suggests
 * @return 0 to go on; anything else cancels the call, which then soon returns MW_CANCELLED. The last report of a
 *         successful call has the fraction 1: the work is done, and the answer to it does not matter.
 *
 * It may not call back into the objects that the call works on.
 */
typedef int mw_progress_report(void *context, const char *stage, double fraction);

/**
 * Watches a call that can take longer than a second, and may cancel it: `progress` of the options.
 *
 * A cancelled call leaves nothing behind: objects that it was to make do not exist, objects that it was to change are as
 * before. Batches are the exception: some results are written, and which ones is not told. There are at most 300 reports
 * a call, so a report may take its time. The structure belongs to the caller and must live as long as the call; that of an
 * editor, which watches its later calls too, as long as the editor.
 */
typedef struct mw_progress {
    mw_progress_report *report; /**< NULL: no reports */
    void *context;              /**< for `report` */
} mw_progress;

/* A short English text for a status, never NULL. Thread-safe. */
MW_API const char *mw_status_text(mw_status status);

/* The version of the linked library, "MAJOR.MINOR.PATCH". Thread-safe. */
MW_API const char *mw_version(void);

#ifdef __cplusplus
}
#endif
#endif
