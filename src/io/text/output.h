/* output.h - what writers of several files need beyond the public mw_output. Private. */
#ifndef MW_SRC_IO_TEXT_OUTPUT_H
#define MW_SRC_IO_TEXT_OUTPUT_H

#include "base/job.h"

#include <meshwalk/io.h>

/* Write out what is buffered, so that mw_output_failed tells whether all of it arrived. */
void mw__output_flush(mw_output *output);

/* Writing is a part of the present stage of a job, of about `expected` bytes. If the job is to
 * stop, the output has failed. */
void mw__output_watch(mw_output *output, mw_job *job, uint64_t expected);

/* As mw_output_open, but the data go to a temporary name at once, by which another library can
 * write them: mw_output_temporary. That is NULL where what is written is no regular file. */
mw_status mw__output_open_named(const char *path, mw_output **out, mw_error *error);

/* A text without format. */
void mw__output_text(mw_output *output, const char *text);
void mw__output_char(mw_output *output, char c);
void mw__output_integer(mw_output *output, uint64_t value);

#endif
