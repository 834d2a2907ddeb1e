/* mend_weld.c - coincident vertices become one. Each vertex that is kept takes what lies within the
 * tolerance and is not welded yet, so chains of near vertices do not collapse into one. */
#include "mend/mend_geometry.h"
#include "mend/vertex_tree.h"

/* Weld to v, which is kept, every later vertex near it. */
static bool weld_near(mw_mend_work *w, const mw_vertex_tree *tree, mw_vertex_list *found,
                      uint32_t v)
{
    double low[3], high[3];
    mw__vertex_box(w, v, v, low, high);
    if (!mw__vertex_tree_find(tree, low, high, found)) return false;
    for (uint32_t i = 0; i < found->count; i++) {
        uint32_t u = found->vertex[i];
        if (u > v && w->kept[u] == u && mw__mend_near(w, v, u)) w->kept[u] = v;
    }
    return true;
}

static bool weld_all(mw_mend_work *w)
{
    mw_vertex_list list = {0}, found = {0};
    bool done = true;
    for (uint32_t v = 0; v < w->vertex_count && done; v++)
        if (mw__mend_finite(w, v)) done = mw__vertex_list_add(&list, v);
    mw_vertex_tree tree = mw__vertex_tree_create(w, &list);
    for (uint32_t v = 0; v < w->vertex_count && done; v++) {
        if (w->kept[v] != v || !mw__mend_finite(w, v)) continue;
        done = weld_near(w, &tree, &found, v) && mw__job_step(w->job, v, w->vertex_count);
    }
    mw__vertex_list_release(&found);
    mw__vertex_tree_release(&tree);
    return done;
}

bool mw__mend_weld(mw_mend_work *w)
{
    mw__job_stage(w->job, "welding vertices", 0.3);
    if (!weld_all(w)) return false;
    for (uint32_t v = 0; v < w->vertex_count; v++)
        if (w->kept[v] != v && !mw__mend_note(w, MW_MEND_WELDED, MW_NONE, v, w->kept[v]))
            return false;
    for (size_t t = 0; t < w->count; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t v = w->triangle[t].v[k];
            if (v < w->vertex_count) w->triangle[t].v[k] = w->kept[v];
        }
    return true;
}
