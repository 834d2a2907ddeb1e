/* view_page.h - the page of `meshwalk view`, as the build made it (web/). */
#ifndef MW_CLI_VIEW_VIEW_PAGE_H
#define MW_CLI_VIEW_VIEW_PAGE_H

#include <stddef.h>

/* The page. Where what it shows belongs stands VIEW_PAGE_MARK. NULL if the build had no compiler
 * for WebAssembly. */
const char *view_page(size_t *size);

#define VIEW_PAGE_MARK "<!--what-to-show-->"

#endif
