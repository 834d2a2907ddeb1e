/* edit.c - a mesh that is edited: what is kept for each triangle follows the changes, a cursor
 * goes on, and the log of the edits, as text, makes the same mesh again. */
#include <meshwalk/meshwalk.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 5, ROOM = 1000 };

static _Noreturn void fail(const char *message)
{
    fprintf(stderr, "%s\n", message);
    exit(1);
}

/* A square of side 4 with a vertex at each whole number, on the slope z = x. */
static mw_mesh *make_mesh(void)
{
    double points[SIDE * SIDE][3];
    mw_mesh *mesh;
    mw_error error;
    for (int i = 0; i < SIDE * SIDE; i++) {
        points[i][0] = points[i][2] = i % SIDE;
        points[i][1] = i / SIDE;
    }
    if (mw_delaunay(points[0], SIDE * SIDE, 3, NULL, NULL, NULL, &mesh, &error) ||
        mw_mesh_set_field(mesh, "z", &points[0][2], 3, &error))
        fail(error.message);
    return mesh;
}

/* The area of each triangle, as an example of what a program keeps beside a mesh; 0 for those that
 * are gone. */
static double area[ROOM];

static void measure(const mw_editor *editor, uint32_t triangle)
{
    uint32_t v[3];
    double p[3][2];
    if (triangle >= ROOM) fail("more triangles than this example has room for");
    area[triangle] = 0;
    if (!mw_editor_triangle(editor, triangle, v)) return;
    for (int k = 0; k < 3; k++) mw_editor_vertex(editor, v[k], p[k]);
    area[triangle] = mw_orient2d(p[0], p[1], p[2]) / 2;
}

/* Only triangles that an edit made, changed or freed are measured again. Those round a vertex that
 * is moved keep their vertices and are not listed; this program moves none. */
static void follow(const mw_editor *editor, const mw_change *change)
{
    size_t count = change->made + change->reused + change->freed;
    for (size_t i = 0; i < count; i++) measure(editor, change->triangle[i].triangle);
    printf("%zu triangles made, %zu reused, %zu freed, %u edges flipped", change->made,
           change->reused, change->freed, change->flips);
    double sum = 0;
    for (int i = 0; i < ROOM; i++) sum += area[i];
    printf("; the areas add up to %g\n", sum);
}

static void apply(mw_editor *editor, mw_edit edit)
{
    mw_change change;
    mw_error error;
    if (mw_edit_apply(editor, &edit, &change, &error)) {
        printf("%s: refused: %s\n", mw_edit_name(edit.kind), error.message);
        return;
    }
    printf("%s, vertex %u: ", mw_edit_name(edit.kind), change.vertex);
    follow(editor, &change);
}

static void where_is(const mw_editor *editor, mw_cursor *cursor, double x, double y)
{
    double z;
    mw_location at = mw_locate(mw_editor_locator(editor), cursor, x, y);
    mw_editor_interpolate(editor, mw_editor_field_by_name(editor, "z"), &at, 1, &z);
    printf("%g %g: %s, height %g\n", x, y, mw_where_name((mw_where)at.where), z);
}

/* Carry out the log of one editor in another one, by way of text as it would stand in a file. */
static void replay(const mw_editor *from, mw_editor *to)
{
    static const char *const fields[] = {"z"};
    const mw_edit_text_options names = {.fields = fields, .field_count = 1};
    char text[MW_EDIT_TEXT_SIZE];
    mw_error error;
    mw_edit_line again;
    size_t count;
    const mw_edit *log = mw_editor_log(from, &count);
    for (size_t i = 0; i < count; i++) {
        mw_edit_format(&(mw_edit_line){.kind = MW_EDIT_LINE_EDIT, .edit = log[i]}, &names, text);
        printf("    %s\n", text);
        if (mw_edit_parse(text, &names, &again, &error) ||
            mw_edit_apply(to, &again.edit, NULL, &error))
            fail(error.message);
    }
}

static bool is_same(const mw_editor *a, const mw_editor *b)
{
    mw_editor_info info;
    uint32_t v[3], w[3];
    mw_editor_describe(a, &info);
    for (uint32_t t = 0; t < info.triangle_range; t++) {
        int there = mw_editor_triangle(a, t, v);
        if (mw_editor_triangle(b, t, w) != there) return false;
        for (int k = 0; there && k < 3; k++)
            if (v[k] != w[k]) return false;
    }
    return true;
}

int main(void)
{
    mw_mesh *mesh = make_mesh();
    mw_editor *editor, *other;
    mw_editor_info info;
    mw_cursor cursor;
    mw_change change;
    mw_error error;
    mw_editor_options options = {.log = 1, .undo = 10};
    if (mw_editor_create(mesh, &options, &editor, &error) ||
        mw_editor_create(mesh, NULL, &other, &error) ||
        mw_cursor_init(mw_editor_locator(editor), NULL, &cursor, &error))
        fail(error.message);
    mw_mesh_destroy(mesh); /* an editor has a copy */
    mw_editor_describe(editor, &info);
    for (uint32_t t = 0; t < info.triangle_range; t++) measure(editor, t);

    where_is(editor, &cursor, 2.25, 2.5);
    /* a peak in field 0 */
    apply(editor, (mw_edit){.kind = MW_EDIT_INSERT, .x = 2.25, .y = 2.5, .value = 9});
    where_is(editor, &cursor, 2.25, 2.5);
    apply(editor, (mw_edit){.kind = MW_EDIT_REMOVE, .vertex = 12});
    apply(editor, (mw_edit){.kind = MW_EDIT_REMOVE, .vertex = 12});
    where_is(editor, &cursor, 2, 2);
    if (mw_edit_undo(editor, &change, &error)) fail(error.message);
    printf("undo, vertex %u: ", change.vertex);
    follow(editor, &change);
    where_is(editor, &cursor, 2, 2);

    printf("the log:\n");
    replay(editor, other);
    printf("carried out again it makes the same mesh: %s\n", is_same(editor, other) ? "yes" : "no");
    mw_editor_destroy(other);
    mw_editor_destroy(editor);
    return 0;
}
