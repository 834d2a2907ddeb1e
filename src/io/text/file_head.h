/* file_head.h - the beginning of a file, looked at to tell its format. Private. */
#ifndef MW_SRC_IO_TEXT_FILE_HEAD_H
#define MW_SRC_IO_TEXT_FILE_HEAD_H

#include "base/base.h"

#include <string.h>

/* So many bytes tell the format. */
#define MW_HEAD_SIZE 4096

static MW_INLINE bool mw__is_space(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* Behind the byte order mark of UTF-8, if there is one. */
static MW_INLINE const char *mw__head_skip_mark(const char *p, const char *end)
{
    return end - p >= 3 && memcmp(p, "\xef\xbb\xbf", 3) == 0 ? p + 3 : p;
}

/* Behind white space and comments ("#" to the end of the line). */
static MW_INLINE const char *mw__head_skip_comments(const char *p, const char *end)
{
    while (p < end && (mw__is_space(*p) || *p == '#')) {
        bool comment = *p == '#';
        do p++;
        while (comment && p < end && *p != '\n' && *p != '\r');
    }
    return p;
}

#endif
