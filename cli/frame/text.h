/* text.h - a text that grows: reports, help and rows are made here before they are written. */
#ifndef CLI_TEXT_H
#define CLI_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* All zero is an empty text. When memory runs out, `failed` is set and everything added later is dropped: whoever
 * writes the text asks once, at the end. */
typedef struct text {
    char *bytes; /* not terminated */
    size_t size, capacity;
    bool failed;
} text;

void text_bytes(text *t, const char *bytes, size_t size);
void text_string(text *t, const char *string);
void text_printf(text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The shortest decimal text that reads back as the same double. */
void text_double(text *t, double value);
void text_clear(text *t); /* keeps the memory */
void text_release(text *t);

#endif
