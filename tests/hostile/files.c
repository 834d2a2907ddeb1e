/* files.c - files of every format that the library reads, with bytes changed: each is read, or
 * refused with an error that names the file. What is read has to make sense. */
#include "hostile/hostile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_BYTES = 1 << 16 };

typedef struct content {
    unsigned char *byte;
    size_t size;
} content;

static void path_of(char path[128], const char *suffix)
{
    snprintf(path, 128, "hostile_%ld%s", (long)getpid(), suffix);
}

static content content_read(const char *path)
{
    content c = {malloc(MOST_BYTES), 0};
    FILE *file = fopen(path, "rb");
    if (!file) hostile_failed("%s cannot be read", path);
    c.size = fread(c.byte, 1, MOST_BYTES / 2, file);
    fclose(file);
    return c;
}

static void content_write(const content *c, const char *path)
{
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(c->byte, 1, c->size, file) != c->size || fclose(file))
        hostile_failed("%s cannot be written", path);
}

static void content_insert(content *c, size_t at, const void *bytes, size_t size)
{
    if (c->size + size > MOST_BYTES) return;
    memmove(c->byte + at + size, c->byte + at, c->size - at);
    memcpy(c->byte + at, bytes, size);
    c->size += size;
}

static void content_remove(content *c, size_t at, size_t size)
{
    if (size > c->size - at) size = c->size - at;
    memmove(c->byte + at, c->byte + at + size, c->size - at - size);
    c->size -= size;
}

static void content_change(content *c, uint64_t *random)
{
    static const char *const words[] = {"18446744073709551616",
                                        "4294967295",
                                        "-1",
                                        "nan",
                                        "inf",
                                        "1e999",
                                        "0x10",
                                        "\n",
                                        " ",
                                        ",",
                                        "\"",
                                        "{",
                                        "[",
                                        "]",
                                        "#",
                                        "\r\n",
                                        "\0",
                                        "\xff\xfe",
                                        "0",
                                        "1e-400"};
    static const unsigned char extremes[4] = {0, 0xff, 0x7f, 0x80};
    size_t at = mw__random_below(random, (uint32_t)c->size + 1);
    const char *word = words[mw__random_below(random, sizeof words / sizeof *words)];
    switch (mw__random_below(random, 6)) {
    case 0:
        if (at < c->size) c->byte[at] ^= (unsigned char)(1u << mw__random_below(random, 8));
        break;
    case 1:
        if (at < c->size) c->byte[at] = extremes[mw__random_below(random, 4)];
        break;
    case 2: content_remove(c, at, 1 + mw__random_below(random, 40)); break;
    case 3: content_insert(c, at, word, *word ? strlen(word) : 1); break;
    case 4: content_insert(c, at, c->byte, at < 200 ? at : 200); break;
    default:
        if (mw__random_below(random, 4) == 0) c->size = at;
        break;
    }
}

static void write_valid(const char *path, const char *format, uint64_t *random)
{
    arrays a = arrays_grid(1 + mw__random_below(random, 4), 0.3, random);
    double *xyz = malloc((size_t)a.point_count * 3 * sizeof *xyz);
    for (size_t i = 0; i < a.point_count; i++) {
        memcpy(xyz + 3 * i, a.points + 2 * i, 2 * sizeof *xyz);
        xyz[3 * i + 2] = random_unit(random);
    }
    mw_mesh_file file = {.points = xyz,
                         .point_count = a.point_count,
                         .triangles = a.triangles,
                         .triangle_count = a.triangle_count};
    mw_error error;
    expect_ok(mw_write_mesh(path, &file, format, NULL, &error), "writing a mesh", &error);
    free(xyz);
    arrays_free(&a);
}

static void expect_error_names(const mw_error *error, const char *path)
{
    if (error->status != MW_ERROR_INPUT && error->status != MW_ERROR_LIMIT &&
        error->status != MW_ERROR_SYSTEM)
        hostile_failed("%s: status %d: %s", path, error->status, error->message);
    /* without its ending: a .poly without points has them in a .node file of the same name */
    char stem[64];
    snprintf(stem, sizeof stem, "%.*s", (int)strcspn(path, "."), path);
    if (!strstr(error->message, stem))
        hostile_failed("the message does not name %s: %s", path, error->message);
}

/* Every index is one of a vertex, and what the arrays make is checked without an end. */
static void expect_sound(const mw_mesh_file *file, const char *path)
{
    for (size_t i = 0; i < 3 * file->triangle_count; i++)
        if (file->triangles[i] >= file->point_count)
            hostile_failed("%s: corner %zu is not a vertex", path, i);
    mw_arrays view = mw_mesh_file_arrays(file);
    mw_check check;
    mw_error error;
    if (mw_check_arrays(&view, NULL, &check, &error) == MW_OK) mw_check_release(&check);
}

static void read_as_mesh(const char *path)
{
    mw_mesh_file file;
    mw_error error;
    if (mw_read_mesh(path, NULL, &file, &error)) {
        expect_error_names(&error, path);
        return;
    }
    expect_sound(&file, path);
    mw_mesh_file_release(&file);
}

static void read_as_points(const char *path)
{
    mw_point_reader *reader;
    mw_error error;
    double values[64 * 64];
    size_t count = 1;
    if (mw_point_reader_open(path, NULL, &reader, &error)) {
        expect_error_names(&error, path);
        return;
    }
    size_t rows = mw_point_reader_width(reader) < 64 ? 64 : 1;
    while (count > 0) {
        if (mw_point_reader_width(reader) > 64 * 64) break;
        if (mw_point_reader_read(reader, values, rows, &count, &error)) {
            expect_error_names(&error, path);
            break;
        }
    }
    mw_point_reader_close(reader);
}

static void read_as_constraints(const char *path)
{
    mw_constraint_file file;
    mw_error error;
    if (mw_read_constraints(path, NULL, &file, &error)) {
        expect_error_names(&error, path);
        return;
    }
    for (size_t i = 0; i < 2 * file.segment_count; i++)
        if (file.segments[i] >= file.point_count)
            hostile_failed("%s: end %zu is no point", path, i);
    mw_constraint_file_release(&file);
}

static void read_as_edits(const char *path)
{
    mw_edit_reader *reader;
    mw_edit_line line;
    mw_error error;
    if (mw_edit_reader_open(path, NULL, &reader, &error)) {
        expect_error_names(&error, path);
        return;
    }
    do {
        mw_status status = mw_edit_reader_read(reader, &line, &error);
        if (status) {
            expect_error_names(&error, path);
            break;
        }
    } while (line.kind != MW_EDIT_LINE_NONE);
    mw_edit_reader_close(reader);
}

typedef struct sample {
    const char *suffix, *format; /* of a mesh; NULL: `text` is the file */
    const char *text;
    void (*read)(const char *path);
} sample;

static const sample samples[] = {
    {".off", "off", NULL, read_as_mesh},
    {".obj", "obj", NULL, read_as_mesh},
    {".ply", "ply", NULL, read_as_mesh},
    {".stl", "stl", NULL, read_as_mesh},
    {".csv", NULL, "x,y,z\n1,2,3\n4,5,6\n\"7\",8,9\n1e3;-0.5;nan\n", read_as_points},
    {".xyz", NULL, "# points\n1 2 3\n4.5 5e1 -6\n\t7\t8\t9\n", read_as_points},
    {".geojson", NULL,
     "{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{\"name\":"
     "\"a\"},\"geometry\":"
     "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[9,0],[9,9],[0,9],[0,0]],[[2,2],[3,2],[3,3],[2,"
     "2]]]}},{\"type\":"
     "\"Feature\",\"properties\":null,\"geometry\":{\"type\":\"LineString\",\"coordinates\":[[1,1],"
     "[8,8.5]]}}]}",
     read_as_constraints},
    {".poly", NULL,
     "4 2 0 0\n1 0 0\n2 9 0\n3 9 9\n4 0 9\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n1\n1 5 5\n",
     read_as_constraints},
    {".edits", NULL,
     "insert 0.5 0.25\nremove 3 # gone\nmove 2 1 1\nflip 0 4\nundo\nlocate 1 2\nvalue 1 "
     "7\ncompact\n",
     read_as_edits},
};

void hostile_files(uint64_t *random)
{
    const sample *s = &samples[mw__random_below(random, sizeof samples / sizeof *samples)];
    char path[128];
    path_of(path, s->suffix);
    if (s->format) {
        write_valid(path, s->format, random);
    } else {
        content text = {(unsigned char *)(uintptr_t)s->text, strlen(s->text)};
        content_write(&text, path);
    }
    content original = content_read(path);
    content changed = {malloc(MOST_BYTES), 0};
    for (int i = 0; i < 20; i++) {
        memcpy(changed.byte, original.byte, original.size);
        changed.size = original.size;
        for (uint32_t n = 1 + mw__random_below(random, 4); n > 0; n--)
            content_change(&changed, random);
        content_write(&changed, path);
        s->read(path);
    }
    unlink(path);
    free(changed.byte);
    free(original.byte);
}
