/* output.h - what writers of several files need beyond the public mw_output. Private. */
#ifndef MW_SRC_IO_OUTPUT_H
#define MW_SRC_IO_OUTPUT_H

#include "base/base.h"

#include <meshwalk/io.h>

/* Write out what is buffered, so that mw_output_failed tells whether all of it arrived. */
void mw__output_flush(mw_output *output);

/* A text without format. */
void mw__output_text(mw_output *output, const char *text);
void mw__output_char(mw_output *output, char c);
void mw__output_integer(mw_output *output, uint64_t value);

/* The name of a field as one word that no other field of the file has, nor x, y, z: what is no letter, digit or byte of
 * UTF-8 becomes '_', and the number of the field follows where that gives a word already taken. */
void mw__output_word(mw_output *output, const mw_mesh_file *file, size_t field);

#endif
