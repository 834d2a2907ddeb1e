#include "io/mesh/face_cut.h"

#include "predicates/predicates.h"

/* A face as seen in a plane of two coordinates. */
typedef struct cut_view {
    const double *points;
    const uint32_t *corners;
    size_t count;
    unsigned x, y; /* the coordinates: 0, 1 or 2 */
} cut_view;

typedef enum cut_shape { CUT_CONVEX, CUT_FLAT, CUT_CONCAVE } cut_shape;

static mw_point cut_point(const cut_view *f, size_t i)
{
    const double *p = f->points + 3 * (size_t)f->corners[i % f->count];
    return (mw_point){p[f->x], p[f->y]};
}

/* The side to which the face turns at corner i: 1 left, -1 right, 0 neither. */
static int cut_turn(const cut_view *f, size_t i)
{
    double turn =
        mw__orient2d(cut_point(f, i + f->count - 1), cut_point(f, i), cut_point(f, i + 1));
    return (turn > 0) - (turn < 0);
}

/* The direction of the edge from corner i: 1 if the next corner comes later in the order of x,
 * then y; 0 if it is at the same point. */
static int cut_direction(const cut_view *f, size_t i)
{
    mw_point a = cut_point(f, i), b = cut_point(f, i + 1);
    if (a.x != b.x) return a.x < b.x ? 1 : -1;
    return (a.y < b.y) - (a.y > b.y);
}

/* A closed line whose turns are all to one side is convex if it reverses its direction in x only
 * twice. */
static cut_shape cut_find_shape(const cut_view *f)
{
    bool left = false, right = false;
    int changes = 0, first = 0, last = 0;
    for (size_t i = 0; i < f->count; i++) {
        int turn = cut_turn(f, i), direction = cut_direction(f, i);
        left |= turn > 0;
        right |= turn < 0;
        if (direction == 0) continue;
        if (!first) first = direction;
        changes += last && direction != last;
        last = direction;
    }
    changes += last != first;
    if (!left && !right) return CUT_FLAT;
    return (left && right) || changes > 2 ? CUT_CONCAVE : CUT_CONVEX;
}

static double cut_length_squared(const cut_view *f, size_t i)
{
    mw_point a = cut_point(f, i), b = cut_point(f, i + 2);
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/* Is a fan from corner i without flat triangles? If its neighbours lie on no straight line. */
static bool cut_is_open(const cut_view *f, size_t i)
{
    return cut_turn(f, i + 1) != 0 && cut_turn(f, i + f->count - 1) != 0;
}

static size_t cut_lower(const cut_view *f, size_t i, size_t k)
{
    return f->corners[i] <= f->corners[k] ? i : k;
}

/* The end of the diagonal of a quadrilateral with the lower number. */
static size_t cut_diagonal(const cut_view *f)
{
    size_t a = cut_lower(f, 0, 2), b = cut_lower(f, 1, 3);
    bool a_open = cut_is_open(f, a), b_open = cut_is_open(f, b);
    if (a_open != b_open) return a_open ? a : b;
    double a_length = cut_length_squared(f, 0), b_length = cut_length_squared(f, 1);
    if (a_length < b_length) return a;
    return b_length < a_length ? b : cut_lower(f, a, b);
}

/* The corner where the fan begins. */
static size_t cut_apex(const cut_view *f)
{
    if (f->count == 4) return cut_diagonal(f);
    size_t lowest = 0, open = SIZE_MAX;
    for (size_t i = 0; i < f->count; i++) {
        lowest = cut_lower(f, lowest, i);
        if (open != SIZE_MAX && f->corners[i] >= f->corners[open]) continue;
        if (cut_is_open(f, i)) open = i;
    }
    return open != SIZE_MAX ? open : lowest;
}

static void cut_fan(const cut_view *f, size_t apex, uint32_t *triangles)
{
    for (size_t i = 1; i + 1 < f->count; i++, triangles += 3) {
        triangles[0] = f->corners[apex];
        triangles[1] = f->corners[(apex + i) % f->count];
        triangles[2] = f->corners[(apex + i + 1) % f->count];
    }
}

/* Corners at one point can hide a turn; then triangles of the fan turn either way. */
static bool cut_turns_one_way(const cut_view *f, size_t apex)
{
    bool left = false, right = false;
    mw_point a = cut_point(f, apex);
    for (size_t i = 1; i + 1 < f->count; i++) {
        double turn = mw__orient2d(a, cut_point(f, apex + i), cut_point(f, apex + i + 1));
        left |= turn > 0;
        right |= turn < 0;
    }
    return !(left && right);
}

static cut_shape cut_in_view(const cut_view *f, uint32_t *triangles)
{
    cut_shape shape = cut_find_shape(f);
    if (shape == CUT_CONCAVE) return shape;
    size_t apex = cut_apex(f);
    if (!cut_turns_one_way(f, apex)) return CUT_CONCAVE;
    cut_fan(f, apex, triangles);
    return shape;
}

/* Twice the area of the face in the plane of the coordinates x and y, without its sign. */
static double cut_area(const cut_view *f, unsigned x, unsigned y)
{
    double area = 0;
    const double *a = f->points + 3 * (size_t)f->corners[0];
    for (size_t i = 1; i + 1 < f->count; i++) {
        const double *b = f->points + 3 * (size_t)f->corners[i];
        const double *c = f->points + 3 * (size_t)f->corners[i + 1];
        area += (b[x] - a[x]) * (c[y] - a[y]) - (b[y] - a[y]) * (c[x] - a[x]);
    }
    return fabs(area);
}

static bool cut_is_warped(const cut_view *f)
{
    for (size_t i = 1; i < f->count; i++)
        if (f->points[3 * (size_t)f->corners[i] + 2] != f->points[3 * (size_t)f->corners[0] + 2])
            return true;
    return false;
}

/* How far the two triangles of a quadrilateral cut at corner i lie in one plane: the product of
 * their normals. */
static double cut_fold(const cut_view *f, size_t i)
{
    double normal[2][3];
    const double *p[4];
    for (size_t k = 0; k < 4; k++) p[k] = f->points + 3 * (size_t)f->corners[(i + k) % 4];
    for (size_t n = 0; n < 2; n++)
        for (size_t x = 0, y = 1, z = 2; x < 3; x++, y = (y + 1) % 3, z = (z + 1) % 3)
            normal[n][x] = (p[n + 1][y] - p[0][y]) * (p[n + 2][z] - p[0][z]) -
                           (p[n + 1][z] - p[0][z]) * (p[n + 2][y] - p[0][y]);
    return normal[0][0] * normal[1][0] + normal[0][1] * normal[1][1] + normal[0][2] * normal[1][2];
}

/* A quadrilateral in space may be so warped that it is not convex in any projection. It is cut
 * along the diagonal at which it folds less, if that is less than a right angle. */
static bool cut_warped(const cut_view *f, uint32_t *triangles)
{
    if (f->count != 4 || !cut_is_warped(f)) return false;
    double folds[2] = {cut_fold(f, 0), cut_fold(f, 1)};
    size_t apex = folds[0] >= folds[1] ? 0 : 1;
    if (!(folds[apex] > 0)) return false;
    cut_fan(f, cut_lower(f, apex, apex + 2), triangles);
    return true;
}

bool mw__face_cut(const double *points, const uint32_t *corners, size_t count, uint32_t *triangles)
{
    cut_view f = {.points = points, .corners = corners, .count = count, .x = 0, .y = 1};
    cut_shape shape = cut_in_view(&f, triangles);
    if (shape == CUT_CONVEX) return true;
    double xy = cut_area(&f, 0, 1), yz = cut_area(&f, 1, 2), zx = cut_area(&f, 2, 0);
    if (yz > xy || zx > xy) {
        f.x = yz >= zx ? 1 : 2;
        f.y = yz >= zx ? 2 : 0;
        shape = cut_in_view(&f, triangles);
    }
    return shape != CUT_CONCAVE || cut_warped(&f, triangles);
}
