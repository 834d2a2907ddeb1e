#include "cli/stream/number_rows.h"
#include "cli/output/csv_row.h"

#include <inttypes.h>
#include <string.h>

void number_rows_begin(mw_output *out)
{
    static const char header[] = "line,what,old,new\n";
    mw_output_write(out, header, strlen(header));
}

void number_rows_write(mw_output *out, text *row, int64_t line, const char *what,
                       const uint32_t *number, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (line > 0) text_printf(row, "%" PRId64, line);
        csv_row_word(row, what);
        csv_row_count(row, true, i);
        if (number[i] != MW_NONE)
            csv_row_count(row, true, number[i]);
        else
            text_string(row, ",-1");
        csv_row_end(row);
        mw_output_write(out, row->bytes, row->size);
        text_clear(row);
    }
}
