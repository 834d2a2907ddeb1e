/* byte_source.h - the bytes and lines of an input: a file, standard input or memory; gzip is
 * unpacked on the way. Private.
 *
 * A source holds one block of the input at a time. Pointers it hands out are good until the next
 * call. Errors it reports, and those that readers report with mw__source_fail, begin with the
 * position: "FILE:LINE: " for text, "FILE: at byte N: " for binary files (bytes of the unpacked
 * contents). */
#ifndef MW_SRC_IO_TEXT_BYTE_SOURCE_H
#define MW_SRC_IO_TEXT_BYTE_SOURCE_H

#include "base/job.h"

/* The longest line accepted. Without a limit a small gzip file could make a reader allocate very
 * much memory. */
#define MW_LINE_LIMIT ((size_t)1 << 24)
/* Most bytes that mw__source_bytes and mw__source_peek can be asked for. */
#define MW_BYTES_LIMIT ((size_t)1 << 16)
/* Most columns of a table, and most values per vertex beside the coordinates. */
#define MW_COLUMN_LIMIT 4096

typedef struct mw_source {
    char *path;          /* as opened; "-" is standard input */
    struct gzFile_s *gz; /* NULL for memory and after the end */
    const char *memory;  /* what is left of a source in memory */
    size_t memory_left;
    char *buffer; /* capacity + 1 bytes, so that the last line can be ended too */
    size_t capacity, begin, end;
    uint64_t offset;    /* of buffer[begin] in the contents */
    int64_t line;       /* number of the line handed out last; 0 before the first */
    int64_t line_count; /* lines that this one was joined from */
    /* Where that line stood in the buffer, its length with its end and without it, and the
     * character replaced by NUL. */
    size_t line_begin;
    size_t line_bytes, line_length;
    char line_stop;
    size_t no_newline_below; /* buffer[begin..this) is known to hold no '\n' */
    bool ended;              /* the buffer holds all that is left */
    const char *damage;      /* what is wrong behind that, or NULL */
    bool binary;             /* errors name bytes instead of lines */
    bool placeless;          /* errors name neither */
    mw_job *job;             /* NULL, or has a step for each block that is read */
    uint64_t size;           /* of the file, packed or not; 0: unknown */
} mw_source;

/* Open a file, or standard input for "-". MW_ERROR_SYSTEM if that fails. Release with
 * mw__source_close. */
mw_status mw__source_open(mw_source *source, const char *path, mw_error *error);
/* Read from memory, which must outlive the source; `name` is for messages and to tell the
 * format. The block is small, so that tests with little data reach its borders. */
mw_status mw__source_memory(mw_source *source, const char *name, const void *bytes, size_t size,
                            mw_error *error);
/* Report reading as progress of the present stage of a job: the whole stage, or the rest after
 * another source. If the job is to stop, reading fails with MW_ERROR_MEMORY. */
void mw__source_watch(mw_source *source, mw_job *job);
/* How much of the file has been read, from 0 to 1; -1: unknown. */
double mw__source_fraction(const mw_source *source);
void mw__source_close(mw_source *source);

/* Is this a regular file, not packed, that another library can open by its path? To be asked after
 * the first mw__source_peek. */
bool mw__source_is_plain_file(mw_source *source);

/* How many bytes are left to read; 0 if that is not known, or more than the memory can address. */
size_t mw__source_left(mw_source *source);

/* The path for messages. */
const char *mw__source_name(const mw_source *source);

/* Whether a path ends so, in letters of any case, ".gz" disregarded. */
bool mw__path_ends(const char *path, const char *ending);

/* Up to `wanted` of the next bytes, which stay unread; fewer only at the end of the input. */
mw_status mw__source_peek(mw_source *source, size_t wanted, const char **bytes, size_t *count,
                          mw_error *error);

/* Read exactly `count` bytes (at most MW_BYTES_LIMIT); an input that ends before is an error. */
mw_status mw__source_bytes(mw_source *source, size_t count, const unsigned char **bytes,
                           mw_error *error);
mw_status mw__source_skip(mw_source *source, uint64_t count, mw_error *error);

/* After the last of `count` things: an error if more than white space and NUL bytes follows. */
mw_status mw__source_check_end(mw_source *source, uint64_t count, const char *what,
                               mw_error *error);

/* Read a line: *line is ended by NUL where its LF, CR LF or CR was; *line = NULL at the
 * end of the input. A UTF-8 byte order mark before the first line is skipped. Lines with NUL
 * bytes, lines longer than MW_LINE_LIMIT and UTF-16 are errors. The line may be written to. */
mw_status mw__source_line(mw_source *source, char **line, mw_error *error);
/* Join the next line to the one read last, which must not have been altered: *line is both, with
 * the line end between them, and may have moved; NULL at the end of the input, where the line read
 * last is lost. */
mw_status mw__source_join_line(mw_source *source, char **line, mw_error *error);
/* Give the line read last back, unchanged; nothing else may have been read since, and it must
 * not have been altered. */
void mw__source_unread_line(mw_source *source);

/* The next line that holds more than blanks and a comment ("#" to the end of the line, cut off),
 * without leading blanks. */
mw_status mw__source_content_line(mw_source *source, char **line, mw_error *error);

/* Fill in an error with MW_ERROR_INPUT at the present position. Control characters in the
 * message become '?'. */
mw_status mw__source_fail(const mw_source *source, mw_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* The same with a position noted before: a line number, or an offset in a binary source. */
mw_status mw__source_fail_at(const mw_source *source, uint64_t position, mw_error *error,
                             const char *format, ...) __attribute__((format(printf, 4, 5)));
/* The present position, for mw__source_fail_at. */
uint64_t mw__source_position(const mw_source *source);

/* A piece of the input for a message, shortened; the first up to the next blank. */
typedef struct mw_excerpt {
    char text[48];
} mw_excerpt;
mw_excerpt mw__excerpt(const char *text);
mw_excerpt mw__excerpt_of(const char *text, size_t length);

/* Fill in an error with MW_ERROR_INPUT: the integer from `number` to `end` does not fit into 64
 * bits (mw__integer_fits). The message names it as it stands there. */
mw_status mw__source_fail_large(const mw_source *source, const char *number, const char *end,
                                mw_error *error);

/* Control characters in a message, which pieces of the input may have brought there, become '?'. */
void mw__message_clean(char *message);

static MW_INLINE bool mw__is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static MW_INLINE char *mw__skip_blanks(const char *p)
{
    while (mw__is_blank(*p)) p++;
    return (char *)(uintptr_t)p;
}

/* Whether a number that ends at p is followed by a blank or the end of the line. */
static MW_INLINE bool mw__at_gap(const char *p)
{
    return *p == 0 || mw__is_blank(*p);
}

#endif
