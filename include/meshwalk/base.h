/**
 * @file base.h
 * What every part of the interface uses: linkage, statuses, errors, progress.
 *
 * Errors: a function that can fail returns a mw_status; 0 is success. A parameter `mw_error *error`
 * may be NULL; otherwise it receives what was wrong and where. The library keeps no global state,
 * never prints, and never ends the program.
 *
 * Threads: a call creates the threads that it uses and ends them before it returns. An option
 * `threads` gives the number: 1 creates none, 0 means one per processor available to the process.
 * If the system refuses a thread, fewer threads do the work. Results never depend on the number.
 * Between calls the library has no threads, so a child created by fork() can use it like its
 * parent. Functions that return a constant text, such as a name, are thread-safe and take O(1).
 * While an object is destroyed or released, no other thread may use it.
 *
 * Options: initialise structures of options with = {0}, which selects the defaults, then set the
 * members that differ. Members named `reserved` must stay zero; otherwise the call returns
 * MW_ERROR_ARGUMENT. Later versions can then use these members without changing present programs.
 */
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

/** The value of a 32-bit number that names nothing: no triangle, no vertex, no hole. */
#define MW_NONE UINT32_MAX

/** The largest number of triangles in a mesh: a link packs 4 * triangle + edge into 32 bits. */
#define MW_MAX_TRIANGLES ((uint32_t)1 << 30)
/** The largest number of vertices in a mesh. */
#define MW_MAX_VERTICES (UINT32_MAX - 1)

/** The outcome of a call. */
typedef enum mw_status {
    MW_OK = 0,         /**< success */
    MW_ERROR_ARGUMENT, /**< the call is wrong: NULL, an unknown name, a stride too small */
    MW_ERROR_INPUT,    /**< the data is wrong: unreadable, malformed, a mesh with a defect */
    MW_ERROR_MEMORY,   /**< an allocation failed */
    MW_ERROR_LIMIT,    /**< the data is too large: more than MW_MAX_TRIANGLES, for instance */
    MW_ERROR_SYSTEM,   /**< the operating system refused: a file cannot be opened or written */
    MW_CANCELLED,      /**< the caller's mw_progress cancelled the call */
    MW_STATUS_COUNT
} mw_status;

/** What went wrong and where. Numbers are the caller's; -1 where they do not apply. */
typedef struct mw_error {
    mw_status status;
    int64_t triangle;
    int64_t vertex;
    int64_t line;      /**< line of a text file, from 1 */
    char message[512]; /**< English text, without a line end */
} mw_error;

/**
 * A function that a long call calls from time to time, on the thread that made the call.
 *
 * It must not use the objects that the call works on.
 *
 * @param context   mw_progress.context
 * @param stage     what is being done, for people to read, such as "sorting points"; valid until
 *                  the function returns
 * @param fraction  estimated part of the whole call that is done, from 0 to 1; it never decreases
 * @return 0 to continue. Any other value cancels the call, which then soon returns MW_CANCELLED.
 *         The last report of a successful call has the fraction 1 and cannot cancel it.
 */
typedef int mw_progress_report(void *context, const char *stage, double fraction);

/**
 * Reports the progress of a call that can take longer than a second, and can cancel it.
 *
 * A cancelled call leaves nothing behind: objects that it would have created do not exist, and
 * objects that it would have changed are unchanged. Batches are the exception: some results are
 * written. A call makes at most 300 reports, so a report may take its time. The caller owns the
 * structure and keeps it during the call; for an editor as long as the editor exists.
 */
typedef struct mw_progress {
    mw_progress_report *report; /**< NULL: no reports */
    void *context;              /**< for `report` */
} mw_progress;

/**
 * Tell what a status means.
 *
 * @param status  any number
 * @return a short English text, such as "out of memory"; never NULL, owned by the library.
 *
 * Thread-safe. O(1).
 */
MW_API const char *mw_status_text(mw_status status);

/**
 * Tell the version of the linked library.
 *
 * @return "MAJOR.MINOR.PATCH", owned by the library.
 *
 * Thread-safe. O(1).
 */
MW_API const char *mw_version(void);

#ifdef __cplusplus
}
#endif
#endif
