#include "cli/version.h"
#include "cli/gdal/library_versions.h"
#include "cli/view/view_page.h"

#include <meshwalk/meshwalk.h>

void version_write(text *t)
{
#ifdef MW_CAIRO_VERSION
    const char *cairo = MW_CAIRO_VERSION ", built in: pictures and plots";
#else
    const char *cairo = NULL;
#endif
    size_t page_size;
    text_printf(t, "meshwalk %s\n", mw_version());
    library_versions_write(t);
    library_version_line(t, "Cairo", cairo, "no pictures, no plots");
    library_version_line(t, "view", view_page(&page_size) ? "built in: pages for browsers" : NULL,
                         "built without WebAssembly, no pages for browsers");
}
