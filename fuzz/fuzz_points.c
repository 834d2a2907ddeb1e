/* Any bytes as points: the first line is the selection of columns, none if it is empty. As a table
 * of its own kind and as the vertices of a .node file, without and with the rows' texts. */
#include "reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char columns[64] = "";
    size_t length = 0;
    while (length < size && data[length] != '\n') length++;
    if (length < sizeof columns) memcpy(columns, data, length);
    size_t skipped = length < size ? length + 1 : size;
    mw_point_reader_options options = {.columns = columns[0] ? columns : NULL};
    size_t commas = 0;
    for (const char *p = columns; *p; p++) commas += *p == ',';
    /* a selection that is wrong in itself is no matter of the file */
    if (columns[0] && (commas == 0 || columns[0] == ',')) options.columns = "x,y";
    mw_point_reader *reader = NULL;
    mw_source source;
    mw_error error = {0};
    if (mw__source_memory(&source, "input.txt", "", 0, &error) != MW_OK) return 0;
    bool sound = mw__point_reader_start(source, &options, &reader, &error) == MW_OK;
    mw_point_reader_close(reader);
    if (!sound) options.columns = NULL;
    for (int round = 0; round < 3; round++) {
        options.table = round == 1;
        options.texts = round == 2;
        fuzz_points("input.txt", &options, data + skipped, size - skipped);
        fuzz_points("input.node", &options, data + skipped, size - skipped);
    }
    return 0;
}
