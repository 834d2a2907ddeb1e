#include "support/calls/call_runs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void call_sum(uint64_t *sum, uint64_t value)
{
    *sum = (*sum ^ value) * UINT64_C(0x9e3779b97f4a7c15);
    *sum ^= *sum >> 29;
}

void call_sum_number(uint64_t *sum, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    call_sum(sum, bits);
}

void call_sum_mesh(uint64_t *sum, const mw_mesh *mesh)
{
    uint32_t v[3];
    call_sum(sum, mw_mesh_vertex_count(mesh));
    for (uint32_t t = 0; t < mw_mesh_triangle_count(mesh); t++) {
        mw_mesh_triangle(mesh, t, v);
        for (unsigned k = 0; k < 3; k++)
            call_sum(sum, (uint64_t)v[k] << 32 | mw_mesh_neighbour(mesh, t, k, NULL));
    }
}

void call_sum_locations(uint64_t *sum, const mw_location *at, size_t n)
{
    for (size_t i = 0; i < n; i++)
        call_sum(sum, (uint64_t)at[i].triangle << 8 | (uint64_t)at[i].where);
}

void call_expect(bool holds, const char *what)
{
    if (holds) return;
    fprintf(stderr, "after a failed call: %s\n", what);
    abort();
}

mw_status call_mesh_made(mw_status status, mw_mesh *mesh, uint64_t *sum)
{
    call_expect(!status == (mesh != NULL), "there is a mesh");
    if (!status) call_sum_mesh(sum, mesh);
    mw_mesh_destroy(mesh);
    return status;
}

mw_status call_check_made(mw_status status, mw_check *check, uint64_t *sum)
{
    call_expect(!status || (!check->defects && check->defect_count == 0), "there are defects");
    for (size_t i = 0; i < check->defect_count; i++)
        call_sum(sum, (uint64_t)check->defects[i].kind << 32 | check->defects[i].triangle);
    mw_check_release(check);
    return status;
}
