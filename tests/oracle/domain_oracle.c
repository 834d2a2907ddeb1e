/* domain_oracle.c - embeddings and tilings in 64-bit integers. */
#include "oracle/domain_oracle.h"

#include <math.h>
#include <stdlib.h>

int domain_oracle_exponent;

/* --- embeddings ------------------------------------------------------------------------------- */

static domain_spot spot_of(const double *points, uint32_t v)
{
    return (domain_spot){(int64_t)points[2 * (size_t)v], (int64_t)points[2 * (size_t)v + 1]};
}

static int64_t area2(domain_spot a, domain_spot b, domain_spot c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static bool same_spot(domain_spot a, domain_spot b)
{
    return a.x == b.x && a.y == b.y;
}

/* Is p inside the segment ab, not at its ends? */
static bool strictly_inside(domain_spot a, domain_spot b, domain_spot p)
{
    if (area2(a, b, p) != 0 || same_spot(a, p) || same_spot(b, p)) return false;
    return (p.x - a.x) * (b.x - p.x) + (p.y - a.y) * (b.y - p.y) > 0;
}

bool domain_oracle_corners(const arrays *a, uint32_t t, domain_spot out[3])
{
    const uint32_t *v = a->triangles + 3 * (size_t)t;
    for (int k = 0; k < 3; k++) out[k] = spot_of(a->points, v[k]);
    int64_t area = area2(out[0], out[1], out[2]);
    if (area < 0) {
        domain_spot swap = out[1];
        out[1] = out[2];
        out[2] = swap;
    }
    return area != 0;
}

/* The insides of two convex polygons are disjoint if and only if a line along an edge of one of
 * them separates them. */
static bool separates(const domain_spot a[3], const domain_spot b[3])
{
    for (int k = 0; k < 3; k++) {
        domain_spot p = a[k], q = a[(k + 1) % 3];
        if (area2(p, q, b[0]) <= 0 && area2(p, q, b[1]) <= 0 && area2(p, q, b[2]) <= 0) return true;
    }
    return false;
}

static bool is_flat_edge(const arrays *a, domain_spot p, domain_spot q)
{
    domain_spot c[3];
    for (uint32_t t = 0; t < a->triangle_count; t++) {
        if (domain_oracle_corners(a, t, c)) continue;
        for (int k = 0; k < 3; k++)
            if ((same_spot(c[k], p) && same_spot(c[(k + 1) % 3], q)) ||
                (same_spot(c[k], q) && same_spot(c[(k + 1) % 3], p)))
                return true;
    }
    return false;
}

/* Does a vertex of triangle c lie inside an edge of triangle b, with no flat triangle at that
 * edge? */
static bool has_vertex_in_edge(const arrays *a, const domain_spot b[3], const domain_spot c[3])
{
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            if (strictly_inside(b[k], b[(k + 1) % 3], c[l]) &&
                !is_flat_edge(a, b[k], b[(k + 1) % 3]))
                return true;
    return false;
}

bool domain_oracle_is_usable(const arrays *a)
{
    for (uint32_t t = 0; t < a->triangle_count; t++) {
        const uint32_t *v = a->triangles + 3 * (size_t)t;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return false;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t p = v[k], q = v[(k + 1) % 3], count = 0;
            for (uint32_t s = 0; s < 3 * a->triangle_count; s++) {
                uint32_t u = a->triangles[s], w = a->triangles[s % 3 == 2 ? s - 2 : s + 1];
                count += (u == p && w == q) || (u == q && w == p);
            }
            if (count > 2) return false;
        }
    }
    return true;
}

bool domain_oracle_is_embedding(const arrays *a)
{
    domain_spot b[3], c[3];
    if (!domain_oracle_is_usable(a)) return false;
    for (uint32_t s = 0; s < a->triangle_count; s++) {
        if (!domain_oracle_corners(a, s, b)) continue;
        for (uint32_t t = 0; t < a->triangle_count; t++) {
            if (t == s || !domain_oracle_corners(a, t, c)) continue;
            if (t > s && !separates(b, c) && !separates(c, b)) return false;
            if (has_vertex_in_edge(a, b, c)) return false;
        }
    }
    return true;
}

/* --- tilings ---------------------------------------------------------------------------------- */

static bool contains(const domain_spot c[3], domain_spot p)
{
    return area2(c[0], c[1], p) >= 0 && area2(c[1], c[2], p) >= 0 && area2(c[2], c[0], p) >= 0;
}

/* The lowest triangle with an area that contains p, or MW_NONE. */
static uint32_t owner_of(const arrays *a, domain_spot p)
{
    domain_spot c[3];
    for (uint32_t t = 0; t < a->triangle_count; t++)
        if (domain_oracle_corners(a, t, c) && contains(c, p)) return t;
    return MW_NONE;
}

/* Twice the area of the convex hull, by Andrew's monotone chain; spots are sorted in place. */
static int compare_spots(const void *left, const void *right)
{
    const domain_spot *a = left, *b = right;
    if (a->x != b->x) return a->x < b->x ? -1 : 1;
    return a->y < b->y ? -1 : a->y > b->y;
}

static int64_t hull_area2(domain_spot *spots, size_t n)
{
    domain_spot *hull = malloc((2 * n + 1) * sizeof *hull);
    size_t count = 0;
    qsort(spots, n, sizeof *spots, compare_spots);
    for (size_t i = 0; i < n; i++) {
        while (count >= 2 && area2(hull[count - 2], hull[count - 1], spots[i]) <= 0) count--;
        hull[count++] = spots[i];
    }
    for (size_t i = n - 1, lower = count + 1; i-- > 0;) {
        while (count >= lower && area2(hull[count - 2], hull[count - 1], spots[i]) <= 0) count--;
        hull[count++] = spots[i];
    }
    int64_t area = 0;
    for (size_t i = 1; i + 1 < count; i++) area += area2(hull[0], hull[i], hull[i + 1]);
    free(hull);
    return area;
}

static domain_spot tile_spot(const mw_tiling *tiling, uint32_t v)
{
    return (domain_spot){(int64_t)ldexp(tiling->point[v].x, -domain_oracle_exponent),
                         (int64_t)ldexp(tiling->point[v].y, -domain_oracle_exponent)};
}

/* What is wrong with a tile by itself and with its links; NULL if nothing is. */
static const char *fault_of_tile(const mw_tiling *tiling, uint32_t t)
{
    const mw_triangle *tri = &tiling->tri[t];
    domain_spot c[3];
    if (tri->v[3] != tri->v[0]) return "v[3] is not v[0]";
    for (int k = 0; k < 3; k++) c[k] = tile_spot(tiling, tri->v[k]);
    if (area2(c[0], c[1], c[2]) <= 0) return "a tile is not counter-clockwise";
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t link = tri->link[k];
        if (link == MW_NONE) { /* a hull edge: everything on its left */
            for (uint32_t s = 0; s < tiling->tri_count; s++)
                for (int l = 0; l < 3; l++)
                    if (area2(c[k], c[(k + 1) % 3], tile_spot(tiling, tiling->tri[s].v[l])) < 0)
                        return "a tile without neighbour is not at the hull";
            continue;
        }
        if (mw__link_triangle(link) >= tiling->tri_count || mw__link_edge(link) > 2)
            return "a link leads nowhere";
        const mw_triangle *other = &tiling->tri[mw__link_triangle(link)];
        if (other->link[mw__link_edge(link)] != mw__link(t, k)) return "a link does not lead back";
        if (other->v[mw__link_edge(link)] != tri->v[k + 1] ||
            other->v[mw__link_edge(link) + 1] != tri->v[k])
            return "linked tiles do not share their edge";
    }
    return NULL;
}

/* Area and place of the tiles of user's triangles; owners. */
static const char *fault_of_users(const arrays *a, const mw_tiling *tiling)
{
    domain_spot c[3];
    for (uint32_t t = 0; t < a->triangle_count; t++) {
        bool live = domain_oracle_corners(a, t, c);
        int64_t area = live ? area2(c[0], c[1], c[2]) : 0;
        for (uint32_t s = 0; s < tiling->tri_count; s++) {
            const mw_triangle *tri = &tiling->tri[s];
            if (tri->user & MW_GHOST || (tri->user & MW_USER_MASK) != t) continue;
            if (!live) return "a flat triangle has a tile";
            domain_spot d[3];
            for (int k = 0; k < 3; k++) d[k] = tile_spot(tiling, tri->v[k]);
            area -= area2(d[0], d[1], d[2]);
            for (int k = 0; k < 3; k++)
                if (!contains(c, d[k])) return "a tile leaves its triangle";
            const uint32_t *v = a->triangles + 3 * (size_t)t;
            int64_t turn =
                area2(spot_of(a->points, v[0]), spot_of(a->points, v[1]), spot_of(a->points, v[2]));
            if ((turn < 0) != ((tri->user & MW_REVERSED) != 0))
                return "a tile's orientation is wrong";
        }
        if (area != 0) return "the tiles of a triangle do not have its area";
    }
    for (uint32_t s = 0; s < tiling->tri_count; s++)
        for (int k = 0; k < 3; k++)
            if (tiling->owner[tiling->tri[s].v[k]] !=
                owner_of(a, tile_spot(tiling, tiling->tri[s].v[k])))
                return "an owner is wrong";
    return NULL;
}

/* Holes by Euler's formula, over the tiles of user's triangles: faces = E - V + 1 + components. */
static uint32_t euler_holes(const mw_tiling *tiling)
{
    uint32_t *parent = malloc((tiling->point_count + 1) * sizeof *parent);
    int64_t vertices = 0, edges = 0, triangles = 0, components = 0;
    for (uint32_t v = 0; v < tiling->point_count; v++) parent[v] = MW_NONE;
    for (uint32_t t = 0; t < tiling->tri_count; t++) {
        const mw_triangle *tri = &tiling->tri[t];
        if (tri->user & MW_GHOST) continue;
        triangles++;
        for (int k = 0; k < 3; k++) {
            uint32_t link = tri->link[k], v = tri->v[k], w = tri->v[0];
            bool first = link == MW_NONE || tiling->tri[mw__link_triangle(link)].user & MW_GHOST ||
                         mw__link_triangle(link) > t;
            edges += first;
            if (parent[v] == MW_NONE) {
                parent[v] = v;
                vertices++;
                components++;
            }
            while (parent[v] != v) v = parent[v];
            while (parent[w] != w) w = parent[w];
            if (v != w) components--;
            parent[v] = w;
        }
    }
    free(parent);
    return (uint32_t)(edges - vertices + components - triangles);
}

/* Holes must be numbered 0, 1, ... by the lowest triangle beside them. */
static const char *fault_of_holes(const mw_tiling *tiling)
{
    if (tiling->hole_count != euler_holes(tiling)) return "the number of holes is wrong";
    uint32_t before = 0, ghosts = 0;
    for (uint32_t hole = 0; hole < tiling->hole_count; hole++) {
        uint32_t lowest = MW_NONE;
        for (uint32_t t = 0; t < tiling->tri_count; t++)
            for (int k = 0; k < 3; k++) {
                const mw_triangle *tri = &tiling->tri[t];
                if (tri->user != (MW_GHOST | hole)) continue;
                if (tri->link[k] == MW_NONE) return "a hole reaches the hull";
                uint32_t user = tiling->tri[mw__link_triangle(tri->link[k])].user;
                if (user & MW_GHOST && user != tri->user) return "holes touch";
                if (!(user & MW_GHOST) && (user & MW_USER_MASK) < lowest)
                    lowest = user & MW_USER_MASK;
            }
        if (lowest == MW_NONE) return "a hole without border";
        if (lowest < before) return "holes are not in order";
        before = lowest;
    }
    for (uint32_t t = 0; t < tiling->tri_count; t++)
        ghosts += (tiling->tri[t].user & MW_GHOST) != 0;
    return ghosts == tiling->ghost_count ? NULL : "the number of ghosts is wrong";
}

const char *domain_oracle_fault(const arrays *a, const mw_tiling *tiling)
{
    if (!tiling->embedding) return "not marked as an embedding";
    int64_t area = 0;
    domain_spot *spots = malloc((3 * (size_t)tiling->tri_count + 1) * sizeof *spots);
    const char *fault = NULL;
    for (uint32_t t = 0; t < tiling->tri_count && !fault; t++) {
        fault = fault_of_tile(tiling, t);
        for (int k = 0; k < 3; k++)
            spots[3 * (size_t)t + (size_t)k] = tile_spot(tiling, tiling->tri[t].v[k]);
        area += area2(spots[3 * t], spots[3 * t + 1], spots[3 * t + 2]);
    }
    if (!fault && tiling->tri_count > 0 && area != hull_area2(spots, 3 * (size_t)tiling->tri_count))
        fault = "the tiles do not have the area of the hull";
    free(spots);
    if (!fault) fault = fault_of_users(a, tiling);
    return fault ? fault : fault_of_holes(tiling);
}
