/* Any bytes behind "LASF" as LAS; the first byte chooses the columns, a filter of classes, and
 * whether rows are kept as text. */
#include "reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const selections[] = {
        NULL, "classification,time",
        "x,y,z,intensity,return,returns,classification,scan_angle,user_data,point_source,time,red,"
        "green,blue"};
    if (size < 5) return 0;
    mw_point_reader_options options = {.columns = selections[data[0] % 3]};
    options.table = data[0] >> 6 & 1;
    if (data[0] & 0x80) options.classes[data[0] & 31] = 1;
    uint8_t *file = malloc(size - 1);
    require(file != NULL);
    memcpy(file, data + 1, size - 1);
    memcpy(file, "LASF", 4);
    fuzz_points("input.las", &options, file, size - 1);
    free(file);
    return 0;
}
