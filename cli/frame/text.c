#include "cli/frame/text.h"

#include <meshwalk/meshwalk.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Make room for `size` more bytes. Returns NULL if memory runs out. */
static char *text_room(text *t, size_t size)
{
    if (t->failed) return NULL;
    if (t->bytes && t->capacity - t->size >= size) return t->bytes + t->size;
    size_t capacity = t->capacity < 256 ? 256 : t->capacity;
    while (capacity - t->size < size && capacity <= SIZE_MAX / 2) capacity *= 2;
    char *bytes = capacity - t->size >= size ? realloc(t->bytes, capacity) : NULL;
    if (!bytes) {
        t->failed = true;
        return NULL;
    }
    t->bytes = bytes;
    t->capacity = capacity;
    return bytes + t->size;
}

void text_bytes(text *t, const char *bytes, size_t size)
{
    char *room = text_room(t, size);
    if (!room) return;
    memcpy(room, bytes, size);
    t->size += size;
}

void text_string(text *t, const char *string)
{
    text_bytes(t, string, strlen(string));
}

void text_printf(text *t, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    char *room = length < 0 ? NULL : text_room(t, (size_t)length + 1);
    if (room) {
        vsnprintf(room, (size_t)length + 1, format, again);
        t->size += (size_t)length;
    } else {
        t->failed = true;
    }
    va_end(again);
    va_end(arguments);
}

void text_double(text *t, double value)
{
    char *room = text_room(t, 32);
    if (room) t->size += mw_format_double(value, room);
}

void text_clear(text *t)
{
    t->size = 0;
}

void text_release(text *t)
{
    free(t->bytes);
    *t = (text){0};
}

size_t text_utf8_length(const unsigned char *s)
{
    if (s[0] < 0x80) return 1;
    size_t length = s[0] >= 0xf0 ? 4 : s[0] >= 0xe0 ? 3 : 2;
    if (s[0] < 0xc2 || s[0] > 0xf4) return 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xc0) != 0x80) return 0;
    if (s[0] == 0xe0 && s[1] < 0xa0) return 0;
    if (s[0] == 0xed && s[1] >= 0xa0) return 0;
    if (s[0] == 0xf0 && s[1] < 0x90) return 0;
    if (s[0] == 0xf4 && s[1] >= 0x90) return 0;
    return length;
}

bool text_is_utf8(const char *string)
{
    const unsigned char *s = (const unsigned char *)string;
    for (size_t length; *s; s += length)
        if ((length = text_utf8_length(s)) == 0) return false;
    return true;
}
