/* text.h - a text that grows. Reports, help and rows of tables are made in one before they are
 * written. */
#ifndef MW_CLI_FRAME_TEXT_H
#define MW_CLI_FRAME_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A text that is all zero is empty. If memory runs out, `failed` is set and later additions do
 * nothing, so the code that writes the text checks once, at the end. */
typedef struct text {
    char *bytes; /* not terminated */
    size_t size, capacity;
    bool failed;
} text;

void text_bytes(text *t, const char *bytes, size_t size);
void text_string(text *t, const char *string);
void text_printf(text *t, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Add the shortest decimal number that reads back as the same double. */
void text_double(text *t, double value);
void text_clear(text *t); /* keeps the memory */
void text_release(text *t);

/* The length of the UTF-8 sequence at s; 0 if there is none. Overlong forms, surrogates and codes
 * above U+10FFFF are none. */
size_t text_utf8_length(const unsigned char *s);
bool text_is_utf8(const char *string);

#endif
