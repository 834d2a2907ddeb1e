/* Any bytes as Triangle's .node and .ele: the two files are parted by a line "---". */
#include "reader.h"

static const char divider[] = "---\n";

/* Where the divider stands, or the end. */
static size_t find_divider(const uint8_t *data, size_t size)
{
    for (size_t i = 0; i + strlen(divider) <= size; i++)
        if (memcmp(data + i, divider, strlen(divider)) == 0) return i;
    return size;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    size_t node_size = find_divider(data, size);
    size_t skipped = node_size < size ? node_size + strlen(divider) : size;
    mw_error error = {0};
    mw_source node, ele;
    mw_mesh_file file;
    mw_mesh_builder builder;
    if (mw__source_memory(&node, "input.node", data, node_size, &error) != MW_OK) return 0;
    if (mw__source_memory(&ele, "input.ele", data + skipped, size - skipped, &error) != MW_OK) {
        mw__source_close(&node);
        return 0;
    }
    mw__build_start(&builder, &file, &node);
    mw_status status = mw__read_node(&node, &builder, &error);
    if (!status) status = mw__read_ele(&ele, &builder, &error);
    if (!status) status = mw__build_finish(&builder, &error);
    mw__build_release(&builder);
    if (status)
        require_error(status, &error, "input.");
    else
        require_mesh(&file, size);
    mw_mesh_file_release(&file);
    mw__source_close(&node);
    mw__source_close(&ele);
    return 0;
}
