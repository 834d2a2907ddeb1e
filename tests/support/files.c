/* files.c - a directory for a group of tests, and the files in it. */
#include "support/files.h"

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

static char files_directory[512];

int files_enter(void **state)
{
    (void)state;
    const char *place = getenv("TMPDIR");
    snprintf(files_directory, sizeof files_directory, "%s/meshwalk-test-XXXXXX",
             place ? place : P_tmpdir);
    return mkdtemp(files_directory) && chdir(files_directory) == 0 ? 0 : -1;
}

int files_count(void)
{
    int count = 0;
    DIR *directory = opendir(files_directory);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(directory);
    return count;
}

void files_clear(void)
{
    DIR *directory = opendir(files_directory);
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            assert_int_equal(unlink(entry->d_name), 0);
    closedir(directory);
}

int files_leave(void **state)
{
    (void)state;
    files_clear();
    return chdir("/") == 0 && rmdir(files_directory) == 0 ? 0 : -1;
}

void files_write(const char *name, bytes contents)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(contents.data, 1, contents.size, file), contents.size);
    assert_int_equal(fclose(file), 0);
}

void files_write_text(const char *name, const char *text)
{
    files_write(name, (bytes){text, strlen(text)});
}

void files_write_gzip(const char *name, bytes contents)
{
    gzFile file = gzopen(name, "wb");
    assert_non_null(file);
    if (contents.size > 0)
        assert_int_equal(gzwrite(file, contents.data, (unsigned)contents.size), contents.size);
    assert_int_equal(gzclose(file), Z_OK);
}

char *files_read(const char *name, size_t *size)
{
    FILE *file = fopen(name, "rb");
    if (size) *size = 0;
    if (!file) return NULL;
    size_t room = 1 << 16, used = 0, got;
    char *all = malloc(room + 1);
    while (all && (got = fread(all + used, 1, room - used, file)) > 0) {
        used += got;
        if (used == room) all = realloc(all, (room *= 2) + 1);
    }
    assert_non_null(all);
    fclose(file);
    all[used] = 0;
    if (size) *size = used;
    return all;
}

bool files_exists(const char *name)
{
    struct stat status;
    return lstat(name, &status) == 0;
}

const char *files_shared(const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/%s", MW_TEST_SHARED, name);
    if (access(path, R_OK) == 0) return path;
    print_message("left out: there is no ../shared/data/%s\n", name);
    return NULL;
}

void files_expect_error(const mw_error *error, mw_status status, int64_t line, const char *says)
{
    if (error->status != status || error->line != line || !strstr(error->message, says))
        fail_msg("status %d (wanted %d), line %lld (wanted %lld), message '%s' (wanted '%s')",
                 error->status, status, (long long)error->line, (long long)line, error->message,
                 says);
}
