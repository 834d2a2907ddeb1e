/* files.h - files for tests of reading and writing: a directory that goes away, files with given
 * contents, the data beside the project. Failures are cmocka's: call these from tests only. */
#ifndef MW_TESTS_SUPPORT_FILES_H
#define MW_TESTS_SUPPORT_FILES_H

#include <meshwalk/io.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Bytes that may hold NUL; they belong to somebody else. */
typedef struct bytes {
    const char *data;
    size_t size;
} bytes;
#define BYTES(literal) ((bytes){literal, sizeof(literal) - 1})

/* Set-up and tear-down of a group of tests: they run in an empty directory of their own, which
 * is removed afterwards with all that is in it. */
int files_enter(void **state);
int files_leave(void **state);

/* How many files that directory holds. */
int files_count(void);

/* Removes them all. */
void files_clear(void);

/* Write a file with these contents, or replace it; files_write_gzip compresses them. */
void files_write(const char *name, bytes contents);
void files_write_text(const char *name, const char *text);
void files_write_gzip(const char *name, bytes contents);

/* The contents of a file, ended by a NUL that *size (which may be NULL) does not count. NULL:
 * there is no such file. The caller frees them. */
char *files_read(const char *name, size_t *size);

/* Is there anything with that name, a dangling link included? */
bool files_exists(const char *name);

/* The path of a file of the data beside the project; NULL where it is not present, which is told.
 * Valid until the next call. */
const char *files_shared(const char *name);

/* Fails unless the error has this status and line (-1: none), and its message contains `says`. */
void files_expect_error(const mw_error *error, mw_status status, int64_t line, const char *says);

#endif
