#include "io/netcdf/netcdf_output.h"

#include "base/posix.h"
#include "io/netcdf/netcdf_library.h"
#include "io/text/output.h"
#include "io/text/system_error.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct mw_netcdf_output {
    mw_netcdf_functions nc;
    mw_output *output; /* holds the file's place */
    char *shown;       /* the path, for messages */
    int id;
    bool open;
    int code;       /* the first failure, 0 if none */
    int system;     /* if the system refuses to write more: its error */
    char what[300]; /* what it befell */
};

static void netcdf_output_release(mw_netcdf_output *output)
{
    free(output->shown);
    free(output);
}

static mw_status netcdf_output_refuse(const mw_netcdf_output *output, int code, mw_error *error)
{
    if (code == NETCDF_NO_MEMORY) return mw__fail_memory(error);
    if (output->system) return mw__fail_system(output->shown, output->system, error);
    return mw__fail(error, MW_ERROR_SYSTEM, "%.160s: %s%s", output->shown, output->what,
                    output->nc.nc_strerror(code));
}

/* libnetcdf opens the file by name, where mw_output keeps the data until they are complete. */
static mw_status netcdf_output_create(mw_netcdf_output *output, mw_error *error)
{
    const char *path = mw_output_temporary(output->output);
    if (!path)
        return mw__fail(error, MW_ERROR_ARGUMENT,
                        "%.240s: netCDF can be written to a file only, not to a pipe",
                        output->shown);
    char *plain = mw__alloc(strlen(path) + 3, 1);
    if (!plain) return mw__fail_memory(error);
    sprintf(plain, "%s%s", path[0] == '/' ? "" : "./", path);
    mw__netcdf_lock(&output->nc);
    int code = output->nc.nc_create(plain, NETCDF_VERSION_4, &output->id);
    output->open = code == 0;
    if (!code) code = output->nc.nc_set_fill(output->id, NETCDF_NO_FILL, NULL);
    mw__netcdf_unlock();
    free(plain);
    return code ? netcdf_output_refuse(output, code, error) : MW_OK;
}

mw_status mw__netcdf_output_open(const char *path, mw_netcdf_output **out, mw_error *error)
{
    *out = NULL;
    mw_netcdf_output *output = mw__calloc(1, sizeof *output);
    if (!output) return mw__fail_memory(error);
    output->shown = strdup(strcmp(path, "-") == 0 ? "standard output" : path);
    mw_status status =
        output->shown ? mw__netcdf_load(output->shown, &output->nc, error) : mw__fail_memory(error);
    if (!status) status = mw__output_open_named(path, &output->output, error);
    if (status) {
        netcdf_output_release(output);
        return status;
    }
    status = netcdf_output_create(output, error);
    if (status)
        mw__netcdf_output_close(output, false, NULL);
    else
        *out = output;
    return status;
}

/* HDF5 tells that it could not write, but not why. The system does when more is written to the
 * file, which is given up in any case. Its error, or 0. */
static int netcdf_output_try(const mw_netcdf_output *output)
{
    static const char zeros[1 << 16];
    size_t left = sizeof zeros;
    const int file = open(mw_output_temporary(output->output), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (file < 0) return errno;
    int code = 0;
    while (left > 0 && code == 0) {
        const ssize_t written = write(file, zeros, left);
        if (written < 0)
            code = errno;
        else
            left -= (size_t)written;
    }
    close(file);
    return code;
}

/* Note what a call of libnetcdf said. The first failure stays. */
static void netcdf_output_note(mw_netcdf_output *output, int code, const char *what,
                               const char *name)
{
    if (!code || output->code) return;
    output->code = code;
    if (code == NETCDF_HDF5) output->system = netcdf_output_try(output);
    snprintf(output->what, sizeof output->what, "%s %.200s: ", what, name);
}

int mw__netcdf_output_dimension(mw_netcdf_output *output, const char *name, size_t length)
{
    int dimension = -1;
    if (output->code) return -1;
    mw__netcdf_lock(&output->nc);
    int code = output->nc.nc_def_dim(output->id, name, length, &dimension);
    mw__netcdf_unlock();
    netcdf_output_note(output, code, "dimension", name);
    return code ? -1 : dimension;
}

int mw__netcdf_output_variable(mw_netcdf_output *output, const char *name, mw_netcdf_type type,
                               size_t rank, const int *dimensions)
{
    int variable = -1;
    if (output->code) return -1;
    mw__netcdf_lock(&output->nc);
    int code = output->nc.nc_def_var(output->id, name, (int)type, (int)rank, dimensions, &variable);
    mw__netcdf_unlock();
    netcdf_output_note(output, code, "variable", name);
    return code ? -1 : variable;
}

void mw__netcdf_output_text(mw_netcdf_output *output, int variable, const char *attribute,
                            const char *text)
{
    if (output->code) return;
    mw__netcdf_lock(&output->nc);
    int code = output->nc.nc_put_att_text(output->id, variable, attribute, strlen(text), text);
    mw__netcdf_unlock();
    netcdf_output_note(output, code, "attribute", attribute);
}

void mw__netcdf_output_number(mw_netcdf_output *output, int variable, const char *attribute,
                              mw_netcdf_type type, double value)
{
    mw__netcdf_output_list(output, variable, attribute, type, 1, &value);
}

void mw__netcdf_output_list(mw_netcdf_output *output, int variable, const char *attribute,
                            mw_netcdf_type type, size_t count, const double *values)
{
    if (output->code) return;
    mw__netcdf_lock(&output->nc);
    int code =
        output->nc.nc_put_att_double(output->id, variable, attribute, (int)type, count, values);
    mw__netcdf_unlock();
    netcdf_output_note(output, code, "attribute", attribute);
}

void mw__netcdf_output_pack(mw_netcdf_output *output, int variable, int level)
{
    if (output->code) return;
    mw__netcdf_lock(&output->nc);
    int code = output->nc.nc_def_var_deflate(output->id, variable, 1, 1, level);
    mw__netcdf_unlock();
    netcdf_output_note(output, code, "packing", "");
}

void mw__netcdf_output_chunks(mw_netcdf_output *output, int variable, const size_t *lengths)
{
    if (output->code) return;
    mw__netcdf_lock(&output->nc);
    int code = output->nc.nc_def_var_chunking(output->id, variable, NETCDF_CHUNKED, lengths);
    mw__netcdf_unlock();
    netcdf_output_note(output, code, "chunks", "");
}

void mw__netcdf_output_defined(mw_netcdf_output *output)
{
    if (output->code) return;
    mw__netcdf_lock(&output->nc);
    int code = output->nc.nc_enddef(output->id);
    mw__netcdf_unlock();
    netcdf_output_note(output, code, "definitions", "");
}

/* The name of a variable for a message. */
static void netcdf_output_note_values(mw_netcdf_output *output, int variable, int code)
{
    char name[MW_NETCDF_NAME] = "";
    if (!code) return;
    mw__netcdf_lock(&output->nc);
    if (output->nc.nc_inq_var(output->id, variable, name, NULL, NULL, NULL, NULL)) name[0] = 0;
    mw__netcdf_unlock();
    netcdf_output_note(output, code, "variable", name);
}

void mw__netcdf_output_doubles(mw_netcdf_output *output, int variable, const size_t *starts,
                               const size_t *counts, const double *values)
{
    if (output->code) return;
    mw__netcdf_lock(&output->nc);
    int code = output->nc.nc_put_vara_double(output->id, variable, starts, counts, values);
    mw__netcdf_unlock();
    netcdf_output_note_values(output, variable, code);
}

void mw__netcdf_output_integers(mw_netcdf_output *output, int variable, const size_t *starts,
                                const size_t *counts, const int64_t *values)
{
    if (output->code) return;
    mw__netcdf_lock(&output->nc);
    int code =
        output->nc.nc_put_vara_longlong(output->id, variable, starts, counts, (const void *)values);
    mw__netcdf_unlock();
    netcdf_output_note_values(output, variable, code);
}

void mw__netcdf_output_numbers(mw_netcdf_output *output, int variable, const size_t *starts,
                               const size_t *counts, const uint32_t *values)
{
    if (output->code) return;
    mw__netcdf_lock(&output->nc);
    int code = output->nc.nc_put_vara_uint(output->id, variable, starts, counts, values);
    mw__netcdf_unlock();
    netcdf_output_note_values(output, variable, code);
}

void mw__netcdf_output_characters(mw_netcdf_output *output, int variable, const size_t *starts,
                                  const size_t *counts, const char *text)
{
    if (output->code) return;
    mw__netcdf_lock(&output->nc);
    int code = output->nc.nc_put_vara_text(output->id, variable, starts, counts, text);
    mw__netcdf_unlock();
    netcdf_output_note_values(output, variable, code);
}

bool mw__netcdf_output_failed(const mw_netcdf_output *output)
{
    return output->code != 0;
}

mw_status mw__netcdf_output_close(mw_netcdf_output *output, bool commit, mw_error *error)
{
    if (!output) return MW_OK;
    int code = 0;
    mw__netcdf_lock(&output->nc);
    if (output->open) code = output->nc.nc_close(output->id);
    mw__netcdf_unlock();
    netcdf_output_note(output, code, "closing", "");
    bool whole = commit && !output->code;
    mw_status status = MW_OK;
    if (commit && !whole) status = netcdf_output_refuse(output, output->code, error);
    mw_status placed = mw_output_close(output->output, whole, status ? NULL : error);
    netcdf_output_release(output);
    return status ? status : placed;
}
