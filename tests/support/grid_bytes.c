#include "support/grid_bytes.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

static const double grid_x[] = {0, 2, 2, 0, 4}, grid_y[] = {0, 0, 2, 2, 0};
enum { GRID_VERTICES = 5 };

static void grid_add(grid_bytes *g, const void *data, size_t size)
{
    char *larger = realloc(g->bytes, g->size + size + 1);
    if (!larger) abort();
    g->bytes = larger;
    if (size) memcpy(g->bytes + g->size, data, size);
    g->size += size;
    g->bytes[g->size] = 0;
}

static void grid_text(grid_bytes *g, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    grid_add(g, text, (size_t)length);
}

static void grid_bits(grid_bytes *g, uint64_t bits, size_t size, bool big)
{
    for (size_t i = 0; i < size; i++) {
        char byte = (char)(bits >> (8 * (big ? size - 1 - i : i)));
        grid_add(g, &byte, 1);
    }
}

static void grid_real(grid_bytes *g, double value, bool wide, bool big)
{
    float single = (float)value;
    uint64_t bits;
    uint32_t single_bits;
    memcpy(&bits, &value, sizeof bits);
    memcpy(&single_bits, &single, sizeof single_bits);
    grid_bits(g, wide ? bits : single_bits, wide ? 8 : 4, big);
}

void grid_release(grid_bytes *g)
{
    free(g->bytes);
    *g = (grid_bytes){0};
}

/* A record of Fortran. */
static void grid_record(grid_bytes *g, const grid_bytes *content, bool big)
{
    grid_bits(g, content->size, 4, big);
    grid_add(g, content->bytes, content->size);
    grid_bits(g, content->size, 4, big);
}

static void grid_integers(grid_bytes *g, const int *values, size_t count, bool big)
{
    grid_bytes content = {0};
    for (size_t i = 0; i < count; i++) grid_bits(&content, (uint64_t)values[i], 4, big);
    grid_record(g, &content, big);
    grid_release(&content);
}

static void grid_reals(grid_bytes *g, const double *values, size_t count, grid_form form)
{
    grid_bytes content = {0};
    for (size_t i = 0; i < count; i++) grid_real(&content, values[i], form.wide, form.big);
    grid_record(g, &content, form.big);
    grid_release(&content);
}

static void grid_words(grid_bytes *g, const char *text, bool big)
{
    grid_bytes content = {0};
    grid_add(&content, text, strlen(text));
    grid_record(g, &content, big);
    grid_release(&content);
}

grid_bytes grid_selafin(grid_form form)
{
    static const int parameters[10] = {1, 0, 100, 200, 0, 0, 0, 0, 0, 1};
    static const int date[6] = {2020, 1, 2, 3, 4, 5}, counts[] = {1, 0}, sizes[] = {3, 5, 3, 1};
    static const int corners[] = {1, 2, 3, 1, 3, 4, 2, 5, 3}, border[] = {1, 2, 4, 5, 3};
    grid_bytes g = {0};
    char title[81];
    snprintf(title, sizeof title, "%-72s%s", "a test", form.wide ? "SERAFIND" : "SERAFIN ");
    grid_words(&g, title, form.big);
    grid_integers(&g, counts, 2, form.big);
    grid_words(&g, "q               m               ", form.big);
    grid_integers(&g, parameters, 10, form.big);
    grid_integers(&g, date, 6, form.big);
    grid_integers(&g, sizes, 4, form.big);
    grid_integers(&g, corners, 9, form.big);
    grid_integers(&g, border, 5, form.big);
    grid_reals(&g, grid_x, GRID_VERTICES, form);
    grid_reals(&g, grid_y, GRID_VERTICES, form);
    for (int step = 0; step < 2; step++) {
        double time = 60.0 * step, values[GRID_VERTICES];
        for (int v = 0; v < GRID_VERTICES; v++) values[v] = 10 * v + step;
        grid_reals(&g, &time, 1, form);
        grid_reals(&g, values, GRID_VERTICES, form);
    }
    return g;
}

static void grid_numbers(grid_bytes *g, const int *values, size_t count, size_t size, bool big)
{
    for (size_t i = 0; i < count; i++) grid_bits(g, (uint64_t)values[i], size, big);
}

static void grid_msh_point(grid_bytes *g, int v, bool big)
{
    grid_real(g, grid_x[v], true, big);
    grid_real(g, grid_y[v], true, big);
    grid_real(g, 0, true, big);
}

#define NUMBERS(g, size, big, ...)                                                                 \
    grid_numbers(g, (const int[]){__VA_ARGS__}, sizeof((const int[]){__VA_ARGS__}) / sizeof(int),  \
                 size, big)

static void grid_msh_22(grid_bytes *g, bool big)
{
    grid_text(g, "$Nodes\n5\n");
    for (int v = 0; v < GRID_VERTICES; v++) {
        NUMBERS(g, 4, big, 10 * v + 10);
        grid_msh_point(g, v, big);
    }
    grid_text(g, "\n$EndNodes\n$Elements\n3\n");
    NUMBERS(g, 4, big, 1, 1, 2, 1, 3, 9, 10, 20);         /* a line */
    NUMBERS(g, 4, big, 3, 1, 2, 2, 7, 9, 10, 20, 30, 40); /* the quadrilateral */
    NUMBERS(g, 4, big, 2, 1, 0, 3, 20, 50, 30);           /* the triangle, without tags */
    grid_text(g, "\n$EndElements\n");
}

static void grid_msh_41(grid_bytes *g, bool big)
{
    grid_text(g, "$Entities\n");
    NUMBERS(g, 8, big, 1, 1, 2, 0);
    NUMBERS(g, 4, big, 1); /* a point */
    for (int i = 0; i < 3; i++) grid_real(g, 0, true, big);
    NUMBERS(g, 8, big, 0);
    for (int entity = 0; entity < 3; entity++) { /* a line, and two faces */
        NUMBERS(g, 4, big, entity + 1);
        for (int i = 0; i < 6; i++) grid_real(g, 0, true, big);
        NUMBERS(g, 8, big, entity < 2 ? 1 : 0);
        if (entity < 2) NUMBERS(g, 4, big, entity == 0 ? 3 : 7);
        NUMBERS(g, 8, big, 1);
        NUMBERS(g, 4, big, 1);
    }
    grid_text(g, "\n$EndEntities\n$Nodes\n");
    NUMBERS(g, 8, big, 1, 5, 10, 50);
    NUMBERS(g, 4, big, 2, 2, 0);
    NUMBERS(g, 8, big, 5, 10, 20, 30, 40, 50);
    for (int v = 0; v < GRID_VERTICES; v++) grid_msh_point(g, v, big);
    grid_text(g, "\n$EndNodes\n$Elements\n");
    NUMBERS(g, 8, big, 3, 3, 1, 3);
    NUMBERS(g, 4, big, 1, 1, 1);
    NUMBERS(g, 8, big, 1, 1, 10, 20);
    NUMBERS(g, 4, big, 2, 2, 3);
    NUMBERS(g, 8, big, 1, 2, 10, 20, 30, 40);
    NUMBERS(g, 4, big, 2, 3, 2);
    NUMBERS(g, 8, big, 1, 3, 20, 50, 30);
    grid_text(g, "\n$EndElements\n");
}

grid_bytes grid_msh(int version, bool big)
{
    grid_bytes g = {0};
    grid_text(&g, "$MeshFormat\n%s 1 8\n", version == 22 ? "2.2" : "4.1");
    NUMBERS(&g, 4, big, 1);
    grid_text(&g, "\n$EndMeshFormat\n$Comments\n$End \n$EndComments\n$PhysicalNames\n2\n1 3 "
                  "\"shore\"\n2 7 \"sea\"\n$EndPhysicalNames\n");
    if (version == 22)
        grid_msh_22(&g, big);
    else
        grid_msh_41(&g, big);
    return g;
}

grid_bytes grid_vtk(bool old)
{
    grid_bytes g = {0};
    grid_text(&g, "# vtk DataFile Version %s\na test\nBINARY\nDATASET UNSTRUCTURED_GRID\n",
              old ? "3.0" : "5.1");
    grid_text(&g, "POINTS 5 float\n");
    for (int v = 0; v < GRID_VERTICES; v++) {
        grid_real(&g, grid_x[v], false, true);
        grid_real(&g, grid_y[v], false, true);
        grid_real(&g, 0, false, true);
    }
    if (old) {
        grid_text(&g, "\nCELLS 3 12\n");
        NUMBERS(&g, 4, true, 4, 0, 1, 2, 3, 2, 0, 1, 3, 1, 4, 2);
    } else {
        grid_text(&g, "\nMETADATA\nINFORMATION 0\n\nCELLS 4 9\nOFFSETS vtktypeint64\n");
        NUMBERS(&g, 8, true, 0, 4, 6, 9);
        grid_text(&g, "\nCONNECTIVITY vtktypeint64\n");
        NUMBERS(&g, 8, true, 0, 1, 2, 3, 0, 1, 1, 4, 2);
    }
    grid_text(&g, "\nCELL_TYPES 3\n");
    NUMBERS(&g, 4, true, 9, 3, 5);
    grid_text(&g, "\nPOINT_DATA 5\nSCALARS q short 1\nLOOKUP_TABLE default\n");
    NUMBERS(&g, 2, true, 0, 10, 20, 30, 40);
    grid_text(&g, "\nCELL_DATA 3\nFIELD FieldData 1\nphysical 1 3 int\n");
    NUMBERS(&g, 4, true, 7, 8, 0);
    grid_text(&g, "\n");
    return g;
}

/* Bytes as base64 at the end. */
static void grid_base64(grid_bytes *g, const unsigned char *p, size_t size)
{
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        uint32_t bits = (uint32_t)p[i] << 16;
        if (i + 1 < size) bits |= (uint32_t)p[i + 1] << 8;
        if (i + 2 < size) bits |= p[i + 2];
        for (size_t k = 0; k < 4; k++) {
            char c = i + k <= size ? letters[bits >> (18 - 6 * k) & 63] : '=';
            grid_add(g, &c, 1);
        }
    }
}

/* A block of VTU: its size in front, or the sizes of its packed blocks, which are two. */
static void grid_vtu_block(grid_bytes *g, const grid_bytes *content, grid_form form, bool text)
{
    grid_bytes head = {0}, body = {0};
    size_t word = form.wide ? 8 : 4, half = content->size / 2;
    if (form.packed) {
        grid_bytes sizes = {0};
        for (size_t begin = 0, i = 0; i < 2; i++, begin = half) {
            unsigned char packed[1024];
            uLongf size = sizeof packed;
            size_t piece = i == 0 ? half : content->size - half;
            compress(packed, &size, (const unsigned char *)content->bytes + begin, piece);
            grid_bits(&sizes, size, word, form.big);
            grid_add(&body, packed, size);
        }
        grid_bits(&head, 2, word, form.big);
        grid_bits(&head, content->size - half, word, form.big);
        grid_bits(&head, content->size - half, word, form.big);
        grid_add(&head, sizes.bytes, sizes.size);
        grid_release(&sizes);
    } else {
        grid_bits(&head, content->size, word, form.big);
        grid_add(&body, content->bytes, content->size);
    }
    if (text) {
        grid_base64(g, (unsigned char *)head.bytes, head.size);
        grid_base64(g, (unsigned char *)body.bytes, body.size);
    } else {
        grid_add(g, head.bytes, head.size);
        grid_add(g, body.bytes, body.size);
    }
    grid_release(&head);
    grid_release(&body);
}

/* One array of VTU: its element in the file, its data there or at the end. */
static void grid_vtu_array(grid_bytes *g, grid_bytes *end, const char *type, const char *name,
                           grid_bytes content, grid_form form, bool text)
{
    grid_text(g, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" ", type, name,
              strcmp(name, "Points") == 0 ? 3 : 1);
    if (text) {
        grid_text(g, "format=\"binary\">\n");
        grid_vtu_block(g, &content, form, true);
        grid_text(g, "\n</DataArray>\n");
    } else {
        grid_text(g, "format='appended' offset='%zu'/>\n", end->size);
        grid_vtu_block(end, &content, form, false);
    }
    grid_release(&content);
}

static grid_bytes grid_integer_bytes(const int *values, size_t count, size_t size, bool big)
{
    grid_bytes g = {0};
    grid_numbers(&g, values, count, size, big);
    return g;
}

#define INTEGERS(size, big, ...)                                                                   \
    grid_integer_bytes((const int[]){__VA_ARGS__},                                                 \
                       sizeof((const int[]){__VA_ARGS__}) / sizeof(int), size, big)

grid_bytes grid_vtu(grid_form form, bool text)
{
    grid_bytes g = {0}, end = {0}, points = {0}, q = {0};
    for (int v = 0; v < GRID_VERTICES; v++) {
        grid_real(&points, grid_x[v], form.wide, form.big);
        grid_real(&points, grid_y[v], form.wide, form.big);
        grid_real(&points, 0, form.wide, form.big);
        grid_real(&q, 10 * v, form.wide, form.big);
    }
    const char *real = form.wide ? "Float64" : "Float32";
    grid_text(&g,
              "<?xml version=\"1.0\"?>\n<!-- a > test -->\n<VTKFile type=\"UnstructuredGrid\" "
              "version=\"1.0\" byte_order=\"%s\" header_type=\"%s\"%s>\n<UnstructuredGrid>\n"
              "<Piece NumberOfPoints=\"5\" NumberOfCells=\"3\">\n<PointData>\n",
              form.big ? "BigEndian" : "LittleEndian", form.wide ? "UInt64" : "UInt32",
              form.packed ? " compressor=\"vtkZLibDataCompressor\"" : "");
    grid_vtu_array(&g, &end, real, "q", q, form, text);
    grid_text(&g, "</PointData>\n<CellData>\n");
    grid_vtu_array(&g, &end, "Int16", "physical", INTEGERS(2, form.big, 7, 8, 0), form, text);
    grid_text(&g, "</CellData>\n<Points>\n");
    grid_vtu_array(&g, &end, real, "Points", points, form, text);
    grid_text(&g, "</Points>\n<Cells>\n");
    grid_vtu_array(&g, &end, "Int32", "connectivity",
                   INTEGERS(4, form.big, 0, 1, 2, 3, 0, 1, 1, 4, 2), form, text);
    grid_vtu_array(&g, &end, "Int64", "offsets", INTEGERS(8, form.big, 4, 6, 9), form, text);
    grid_vtu_array(&g, &end, "UInt8", "types", INTEGERS(1, form.big, 9, 3, 5), form, text);
    grid_text(&g, "</Cells>\n</Piece>\n</UnstructuredGrid>\n");
    if (!text) {
        grid_text(&g, "<AppendedData encoding=\"raw\">\n_");
        grid_add(&g, end.bytes, end.size);
        grid_text(&g, "\n</AppendedData>\n");
    }
    grid_text(&g, "</VTKFile>\n");
    grid_release(&end);
    return g;
}

/* Add an array to a zip file, and its entry to the directory. */
static void grid_npz_array(grid_bytes *g, grid_bytes *directory, const char *name,
                           const char *descr, const char *shape, bool fortran, grid_bytes values,
                           bool packed)
{
    grid_bytes npy = {0}, head = {0};
    grid_text(&npy, "\x93NUMPY");
    grid_bits(&npy, 1, 2, false);
    grid_bits(&npy, 118, 2, false);
    char text[128];
    snprintf(text, sizeof text, "{'descr': '%s', 'fortran_order': %s, 'shape': %s, }", descr,
             fortran ? "True" : "False", shape);
    grid_text(&npy, "%-117s\n", text);
    grid_add(&npy, values.bytes, values.size);
    unsigned char deflated[2048];
    z_stream z = {.next_in = (unsigned char *)npy.bytes,
                  .avail_in = (unsigned)npy.size,
                  .next_out = deflated,
                  .avail_out = sizeof deflated};
    deflateInit2(&z, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
    deflate(&z, Z_FINISH);
    deflateEnd(&z);
    size_t size = packed ? z.total_out : npy.size;
    grid_bits(&head, packed ? 8 : 0, 2, false);
    grid_bits(&head, 0, 4, false); /* time */
    grid_bits(&head, crc32(0, (unsigned char *)npy.bytes, (unsigned)npy.size), 4, false);
    grid_bits(&head, size, 4, false);
    grid_bits(&head, npy.size, 4, false);
    grid_bits(&head, strlen(name), 2, false);
    grid_bits(&head, 0, 2, false); /* extra */
    grid_add(directory, "PK\1\2\x14\0\x14\0\0", 10);
    grid_add(directory, head.bytes, head.size);
    grid_add(directory, "\0\0\0\0\0\0\0\0\0", 10); /* comment, disk, attributes */
    grid_bits(directory, g->size, 4, false);
    grid_add(directory, name, strlen(name));
    grid_add(g, "PK\3\4\x14\0\0", 8);
    grid_add(g, head.bytes, head.size);
    grid_add(g, name, strlen(name));
    grid_add(g, packed ? (char *)deflated : npy.bytes, size);
    grid_release(&npy);
    grid_release(&head);
    grid_release(&values);
}

grid_bytes grid_npz(grid_form form, bool fortran)
{
    grid_bytes g = {0}, directory = {0}, points = {0}, q = {0};
    char real[8];
    snprintf(real, sizeof real, "%cf%d", form.big ? '>' : '<', form.wide ? 8 : 4);
    for (int i = 0; i < 2 * GRID_VERTICES; i++) {
        int v = fortran ? i % GRID_VERTICES : i / 2, y = fortran ? i / GRID_VERTICES : i % 2;
        grid_real(&points, y ? grid_y[v] : grid_x[v], form.wide, form.big);
    }
    for (int v = 0; v < GRID_VERTICES; v++) grid_real(&q, 10 * v, form.wide, form.big);
    grid_npz_array(&g, &directory, "q.npy", real, "(5,)", false, q, form.packed);
    grid_npz_array(&g, &directory, "points.npy", real, "(5, 2)", fortran, points, form.packed);
    grid_npz_array(&g, &directory, "triangles.npy", form.big ? ">i8" : "<i8", "(2, 4)", false,
                   INTEGERS(8, form.big, 0, 1, 2, 3, 1, 4, 2, 2), form.packed);
    grid_npz_array(&g, &directory, "physical.npy", "|u1", "(2,)", false, INTEGERS(1, false, 7, 0),
                   form.packed);
    grid_npz_array(&g, &directory, "title.npy", "<U5", "()", false, INTEGERS(4, false, 'a'),
                   form.packed);
    size_t begin = g.size;
    grid_add(&g, directory.bytes, directory.size);
    grid_add(&g, "PK\5\6\0\0\0", 8);
    grid_bits(&g, 5, 2, false);
    grid_bits(&g, 5, 2, false);
    grid_bits(&g, directory.size, 4, false);
    grid_bits(&g, begin, 4, false);
    grid_bits(&g, 0, 2, false);
    grid_release(&directory);
    return g;
}
