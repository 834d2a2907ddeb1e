/* errors.c - what failures look like: a status, and an error object that you own with the place in
 * it. */
#include <meshwalk/meshwalk.h>
#include <stdio.h>

/* A mesh with a vertex number that does not exist: refused, and the triangle is named. */
static void broken_arrays(void)
{
    const double points[] = {0, 0, 1, 0, 0, 1};
    const int32_t triangles[] = {0, 1, 2, 1, 7, 2};
    mw_arrays arrays = {points, 3, 2, triangles, 2, MW_INT32};
    mw_mesh *mesh;
    mw_error error;
    mw_status status = mw_mesh_create(&arrays, NULL, &mesh, &error);
    printf("%s: %s (triangle %d)\n", mw_status_text(status), error.message, (int)error.triangle);
}

/* A mesh that covers a part of the plane twice: it can be built, but no search could give one
 * answer. */
static void overlapping_triangles(void)
{
    const double points[] = {0, 0, 4, 0, 0, 4, 1, 1, 5, 1, 1, 5};
    const uint32_t triangles[] = {0, 1, 2, 3, 4, 5};
    mw_arrays arrays = {points, 6, 2, triangles, 2, MW_UINT32};
    mw_check check;
    mw_error error;
    if (mw_check_arrays(&arrays, NULL, &check, &error)) return;
    printf("%s\n", check.valid ? "no defects" : "no embedding:");
    for (size_t i = 0; i < check.defect_count; i++) {
        char text[160];
        mw_defect_describe(&check.defects[i], text, sizeof text);
        printf("  %s\n", text);
    }
    mw_check_release(&check);
}

/* A file that is not there. */
static void missing_file(void)
{
    mw_mesh_file file;
    mw_error error;
    mw_status status = mw_read_mesh("no-such-file.off", NULL, &file, &error);
    printf("%s: %s\n", mw_status_text(status), error.message);
}

int main(void)
{
    broken_arrays();
    overlapping_triangles();
    missing_file();
    return 0;
}
