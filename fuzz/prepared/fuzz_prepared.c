/* Any bytes as a prepared file. The checksums are made right first, so that what they would catch
 * reaches the checks behind them; each input is also opened as it is. */
#include "oracle/prepared/prepared_bytes.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool right)
{
    if (!right) abort();
}

static void open_once(const unsigned char *bytes, size_t size)
{
    static const char name[] = "input.mwm: ";
    mw_error error = {0};
    mw_prepared p = {0};
    mw_status status = mw__prepared_open(&p, "input.mwm", bytes, size, false, MW_ALONE, &error);
    if (status)
        require(status == MW_ERROR_INPUT && strncmp(error.message, name, strlen(name)) == 0);
    else
        require(prepared_bytes_query(&p));
    mw__prepared_release(&p);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    unsigned char *bytes = mw__alloc_lines(size, 1);
    if (!bytes) return 0;
    if (size) memcpy(bytes, data, size);
    open_once(bytes, size);
    prepared_bytes_repair(bytes, size);
    open_once(bytes, size);
    free(bytes);
    return 0;
}
