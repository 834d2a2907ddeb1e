/* greedy.c - not made yet. */
#include "triangulate/kind.h"

mw_status mw__make_greedy(mw_triangulation *t, const mw_kind_options *options, mw_kind_report *report, mw_error *error)
{
    (void)t;
    (void)options;
    (void)report;
    return mw__fail(error, MW_ERROR_ARGUMENT, "not made yet");
}
