#include "io/netcdf/netcdf_file.h"

#include "base/posix.h"
#include "io/netcdf/netcdf_library.h"
#include "io/netcdf/rehearsal.h"
#include "io/text/byte_source.h"
#include "io/text/system_error.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Longest text of an attribute that is taken; a CRS as WKT is the longest of use. */
enum { TEXT_LIMIT = 1 << 16 };

typedef struct netcdf_dimension {
    size_t length;
    char name[MW_NETCDF_NAME];
} netcdf_dimension;

struct mw_netcdf {
    mw_netcdf_functions nc;
    int id;
    bool open;
    char *name;
    mw_netcdf_variable *variables;
    size_t variable_count;
    netcdf_dimension *dimensions;
    size_t dimension_count;
    uint64_t size; /* of the file, in bytes */
    int format;    /* as libnetcdf numbers them */
    bool in_memory;
};

bool mw__netcdf_begins(const char *head, size_t size)
{
    if (size >= 8 && memcmp(head, "\211HDF\r\n\032\n", 8) == 0) return true;
    return size >= 4 && memcmp(head, "CDF", 3) == 0 &&
           (head[3] == 1 || head[3] == 2 || head[3] == 5);
}

mw_status mw__netcdf_fail(const mw_netcdf *file, const mw_netcdf_variable *variable,
                          mw_error *error, const char *format, ...)
{
    if (!error) return MW_ERROR_INPUT;
    char message[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    if (variable)
        mw__fail(error, MW_ERROR_INPUT, "%.160s: variable %.64s: %s", file->name, variable->name,
                 message);
    else
        mw__fail(error, MW_ERROR_INPUT, "%.240s: %s", file->name, message);
    mw__message_clean(error->message);
    return MW_ERROR_INPUT;
}

/* What libnetcdf says of a code. Codes above 0 are those of the system; a file that ends too early
 * gives such a one, too. */
static mw_status netcdf_file_refuse(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                    int code, mw_error *error)
{
    static const int refusals[] = {ENOENT, EACCES, EISDIR, EMFILE, ENFILE};
    if (code == NETCDF_NO_MEMORY || code == ENOMEM) return mw__fail_memory(error);
    for (size_t i = 0; i < sizeof refusals / sizeof *refusals && !file->in_memory; i++)
        if (code == refusals[i]) return mw__fail_system(file->name, code, error);
    if (code > 0)
        return mw__netcdf_fail(file, variable, error, "the file is damaged or incomplete");
    return mw__netcdf_fail(file, variable, error, "%s", file->nc.nc_strerror(code));
}

static mw_status netcdf_file_dimensions(mw_netcdf *file, mw_error *error)
{
    file->dimensions = mw__calloc(file->dimension_count, sizeof *file->dimensions);
    if (!file->dimensions) return mw__fail_memory(error);
    for (size_t i = 0; i < file->dimension_count; i++) {
        netcdf_dimension *dimension = &file->dimensions[i];
        int code = file->nc.nc_inq_dim(file->id, (int)i, dimension->name, &dimension->length);
        if (code) return netcdf_file_refuse(file, NULL, code, error);
    }
    return MW_OK;
}

static mw_status netcdf_file_variable(mw_netcdf *file, size_t i, mw_error *error)
{
    mw_netcdf_variable *variable = &file->variables[i];
    int type = 0, rank = 0, code;
    variable->id = (int)i;
    code = file->nc.nc_inq_var(file->id, (int)i, variable->name, &type, &rank, NULL, NULL);
    variable->type = (mw_netcdf_type)type;
    variable->rank = (size_t)rank;
    if (!code && variable->rank <= MW_NETCDF_RANK)
        code = file->nc.nc_inq_vardimid(file->id, (int)i, variable->dimensions);
    if (code) return netcdf_file_refuse(file, NULL, code, error);
    for (size_t k = 0; k < variable->rank && variable->rank <= MW_NETCDF_RANK; k++) {
        size_t dimension = (size_t)variable->dimensions[k];
        if (dimension >= file->dimension_count)
            return mw__netcdf_fail(file, variable, error, "its dimensions are in another group");
        variable->lengths[k] = file->dimensions[dimension].length;
    }
    return MW_OK;
}

/* All that can be asked for by name is asked for once. */
static mw_status netcdf_file_inquire(mw_netcdf *file, mw_error *error)
{
    int dimensions = 0, variables = 0;
    int code = file->nc.nc_inq(file->id, &dimensions, &variables, NULL, NULL);
    if (!code) code = file->nc.nc_inq_format(file->id, &file->format);
    if (code) return netcdf_file_refuse(file, NULL, code, error);
    file->dimension_count = (size_t)dimensions;
    file->variable_count = (size_t)variables;
    file->variables = mw__calloc(file->variable_count, sizeof *file->variables);
    if (!file->variables) return mw__fail_memory(error);
    mw_status status = netcdf_file_dimensions(file, error);
    for (size_t i = 0; !status && i < file->variable_count; i++)
        status = netcdf_file_variable(file, i, error);
    return status;
}

static mw_status netcdf_file_start(const char *name, mw_netcdf **out, mw_error *error)
{
    *out = NULL;
    mw_netcdf *file = mw__calloc(1, sizeof *file);
    char *copy = strdup(name);
    mw_status status = file && copy ? mw__netcdf_load(name, &file->nc, error) : MW_ERROR_MEMORY;
    if (status) {
        if (!file || !copy) mw__fail_memory(error);
        free(copy);
        free(file);
        return status;
    }
    file->name = copy;
    *out = file;
    return MW_OK;
}

void mw__netcdf_close(mw_netcdf *file)
{
    if (!file) return;
    mw__netcdf_lock(&file->nc);
    if (file->open) file->nc.nc_close(file->id);
    mw__netcdf_unlock();
    free(file->variables);
    free(file->dimensions);
    free(file->name);
    free(file);
}

uint64_t mw__netcdf_file_size(const mw_netcdf *file)
{
    return file->size;
}

bool mw__netcdf_is_classic(const mw_netcdf *file)
{
    enum { FIRST_NETCDF_4 = 3, LAST_NETCDF_4 = 4 };
    return file->format < FIRST_NETCDF_4 || file->format > LAST_NETCDF_4;
}

const char *mw__netcdf_name(const mw_netcdf *file)
{
    return file->name;
}

size_t mw__netcdf_variable_count(const mw_netcdf *file)
{
    return file->variable_count;
}

const mw_netcdf_variable *mw__netcdf_variable_at(const mw_netcdf *file, size_t i)
{
    return &file->variables[i];
}

const mw_netcdf_variable *mw__netcdf_find(const mw_netcdf *file, const char *name)
{
    for (size_t i = 0; i < file->variable_count; i++)
        if (strcmp(file->variables[i].name, name) == 0) return &file->variables[i];
    return NULL;
}

mw_status mw__netcdf_need(const mw_netcdf *file, const char *name, const mw_netcdf_variable **out,
                          mw_error *error)
{
    *out = mw__netcdf_find(file, name);
    if (*out) return MW_OK;
    return mw__netcdf_fail(file, NULL, error, "there is no variable '%.80s'", name);
}

size_t mw__netcdf_dimension_count(const mw_netcdf *file)
{
    return file->dimension_count;
}

const char *mw__netcdf_dimension_at(const mw_netcdf *file, int dimension, size_t *length)
{
    if (length) *length = file->dimensions[dimension].length;
    return file->dimensions[dimension].name;
}

int mw__netcdf_dimension_find(const mw_netcdf *file, const char *name, size_t *length)
{
    for (size_t i = 0; i < file->dimension_count; i++)
        if (strcmp(file->dimensions[i].name, name) == 0) {
            if (length) *length = file->dimensions[i].length;
            return (int)i;
        }
    return -1;
}

static int netcdf_file_id(const mw_netcdf_variable *variable)
{
    return variable ? variable->id : NETCDF_GLOBAL;
}

/* A text of the type that netCDF-4 has for them; an attribute may hold several. */
static int netcdf_file_string(const mw_netcdf *file, int id, const char *attribute, size_t count,
                              char **text)
{
    char *first = NULL;
    if (count != 1) return 0;
    int code = file->nc.nc_get_att_string(file->id, id, attribute, &first);
    if (code) return code;
    if (first && strlen(first) <= TEXT_LIMIT) {
        *text = strdup(first);
        code = *text ? 0 : NETCDF_NO_MEMORY;
    }
    file->nc.nc_free_string(1, &first);
    return code;
}

static int netcdf_file_text(const mw_netcdf *file, int id, const char *attribute, char **text)
{
    int type = 0;
    size_t length = 0;
    int code = file->nc.nc_inq_att(file->id, id, attribute, &type, &length);
    if (code) return code == NETCDF_NO_ATTRIBUTE ? 0 : code;
    if (type == MW_NETCDF_STRING) return netcdf_file_string(file, id, attribute, length, text);
    if (type != MW_NETCDF_CHAR || length > TEXT_LIMIT) return 0;
    char *copy = mw__alloc(length + 1, 1);
    if (!copy) return NETCDF_NO_MEMORY;
    code = file->nc.nc_get_att_text(file->id, id, attribute, copy);
    copy[length] = 0;
    *text = code ? NULL : copy;
    if (code) free(copy);
    return code;
}

mw_status mw__netcdf_text(const mw_netcdf *file, const mw_netcdf_variable *variable,
                          const char *attribute, char **text, mw_error *error)
{
    *text = NULL;
    mw__netcdf_lock(&file->nc);
    int code = netcdf_file_text(file, netcdf_file_id(variable), attribute, text);
    mw_status status = code ? netcdf_file_refuse(file, variable, code, error) : MW_OK;
    mw__netcdf_unlock();
    return status;
}

bool mw__netcdf_number(const mw_netcdf *file, const mw_netcdf_variable *variable,
                       const char *attribute, double *value)
{
    int type = 0, id = netcdf_file_id(variable);
    size_t length = 0;
    mw__netcdf_lock(&file->nc);
    int code = file->nc.nc_inq_att(file->id, id, attribute, &type, &length);
    bool number =
        !code && length == 1 && type != MW_NETCDF_CHAR && type > 0 && type < MW_NETCDF_STRING;
    if (number) number = file->nc.nc_get_att_double(file->id, id, attribute, value) == 0;
    mw__netcdf_unlock();
    return number;
}

static mw_status netcdf_file_check_numbers(const mw_netcdf *file,
                                           const mw_netcdf_variable *variable, mw_error *error)
{
    if (variable->type != MW_NETCDF_CHAR && variable->type < MW_NETCDF_STRING) return MW_OK;
    return mw__netcdf_fail(file, variable, error, "it holds no numbers");
}

mw_status mw__netcdf_doubles(const mw_netcdf *file, const mw_netcdf_variable *variable,
                             const size_t *starts, const size_t *counts, double *values,
                             mw_error *error)
{
    mw_status status = netcdf_file_check_numbers(file, variable, error);
    if (status) return status;
    mw__netcdf_lock(&file->nc);
    int code = file->nc.nc_get_vara_double(file->id, variable->id, starts, counts, values);
    if (code) status = netcdf_file_refuse(file, variable, code, error);
    mw__netcdf_unlock();
    return status;
}

mw_status mw__netcdf_integers(const mw_netcdf *file, const mw_netcdf_variable *variable,
                              const size_t *starts, const size_t *counts, int64_t *values,
                              mw_error *error)
{
    _Static_assert(sizeof(long long) == sizeof *values, "both have 64 bits");
    mw_status status = netcdf_file_check_numbers(file, variable, error);
    if (status) return status;
    mw__netcdf_lock(&file->nc);
    int code =
        file->nc.nc_get_vara_longlong(file->id, variable->id, starts, counts, (void *)values);
    if (code) status = netcdf_file_refuse(file, variable, code, error);
    mw__netcdf_unlock();
    return status;
}

mw_status mw__netcdf_characters(const mw_netcdf *file, const mw_netcdf_variable *variable,
                                const size_t *starts, const size_t *counts, char *text,
                                mw_error *error)
{
    if (variable->type != MW_NETCDF_CHAR)
        return mw__netcdf_fail(file, variable, error, "it holds no text");
    mw__netcdf_lock(&file->nc);
    int code = file->nc.nc_get_vara_text(file->id, variable->id, starts, counts, text);
    mw_status status = code ? netcdf_file_refuse(file, variable, code, error) : MW_OK;
    mw__netcdf_unlock();
    return status;
}

/* --- opening ---------------------------------------------------------------------------------- */

/* Where the contents are: a path, or `size` bytes in memory. */
typedef struct netcdf_opening {
    mw_netcdf *file;
    const char *path;
    void *bytes;
    size_t size;
} netcdf_opening;

/* The caller holds the lock. */
static int netcdf_opening_open(const netcdf_opening *o)
{
    mw_netcdf *file = o->file;
    return o->path ? file->nc.nc_open(o->path, NETCDF_READ, &file->id)
                   : file->nc.nc_open_mem("memory", NETCDF_READ, o->size, o->bytes, &file->id);
}

/* Look at all attributes of a variable, or of the file. */
static void netcdf_rehearse_attributes(const mw_netcdf *file, const mw_netcdf_variable *variable)
{
    int count = 0;
    char name[MW_NETCDF_NAME];
    const int id = netcdf_file_id(variable);
    if (variable)
        file->nc.nc_inq_var(file->id, id, NULL, NULL, NULL, NULL, &count);
    else
        file->nc.nc_inq(file->id, NULL, NULL, &count, NULL);
    for (int k = 0; k < count; k++) {
        char *text;
        double number;
        if (file->nc.nc_inq_attname(file->id, id, k, name)) continue;
        if (mw__netcdf_text(file, variable, name, &text, NULL) == MW_OK) free(text);
        mw__netcdf_number(file, variable, name, &number);
    }
}

/* Read a variable of few values. */
static void netcdf_rehearse_values(const mw_netcdf *file, const mw_netcdf_variable *variable)
{
    enum { FEW = 1 << 12 };
    double values[FEW];
    size_t count = 1, starts[MW_NETCDF_RANK] = {0};
    if (variable->rank > MW_NETCDF_RANK) return;
    for (size_t k = 0; k < variable->rank; k++)
        count = variable->lengths[k] > FEW ? FEW + 1 : count * variable->lengths[k];
    if (count > 0 && count <= FEW)
        mw__netcdf_doubles(file, variable, starts, variable->lengths, values, NULL);
}

/* In the child, which has inherited the lock: do everything that is done with a file before its
 * values are read, and read the short variables. */
static void netcdf_rehearse(void *work)
{
    const netcdf_opening *o = work;
    mw_netcdf *file = o->file;
    if (netcdf_opening_open(o) == 0 && netcdf_file_inquire(file, NULL) == MW_OK) {
        mw__netcdf_unlock();
        netcdf_rehearse_attributes(file, NULL);
        for (size_t i = 0; i < file->variable_count; i++) {
            netcdf_rehearse_attributes(file, &file->variables[i]);
            netcdf_rehearse_values(file, &file->variables[i]);
        }
        mw__netcdf_lock(&file->nc);
    }
}

/* HDF5 follows addresses and counts of damaged files and may crash. So a child tries the file
 * first. If no child can be made, the file is opened without it. */
static bool netcdf_opening_is_safe(const netcdf_opening *o)
{
    mw_rehearsal rehearsal;
    mw__netcdf_lock(&o->file->nc); /* no other thread is in HDF5 while a child begins */
    const bool begun = mw__rehearsal_begin(&rehearsal, netcdf_rehearse, (void *)o);
    mw__netcdf_unlock();
    return !begun || mw__rehearsal_end(&rehearsal);
}

static mw_status netcdf_file_finish(mw_netcdf *file, int code, mw_error *error)
{
    file->open = code == 0;
    return code ? netcdf_file_refuse(file, NULL, code, error) : netcdf_file_inquire(file, error);
}

/* Open a file that has been started; it is closed if that fails. */
static mw_status netcdf_opening_run(const netcdf_opening *o, bool hdf5, mw_netcdf **out,
                                    mw_error *error)
{
    mw_status status = MW_OK;
    if (hdf5 && !netcdf_opening_is_safe(o))
        status = mw__netcdf_fail(o->file, NULL, error,
                                 "the file is damaged: HDF5 does not end when it opens it");
    if (!status) {
        mw__netcdf_lock(&o->file->nc);
        status = netcdf_file_finish(o->file, netcdf_opening_open(o), error);
        mw__netcdf_unlock();
    }
    if (!status) return MW_OK;
    mw__netcdf_close(o->file);
    *out = NULL;
    return status;
}

static bool netcdf_head_is_hdf5(const char *head, size_t size)
{
    return mw__netcdf_begins(head, size) && head[0] != 'C';
}

/* False also if it cannot be read; opening it then gives the error. */
static bool netcdf_path_is_hdf5(const char *path)
{
    char head[8];
    FILE *file = fopen(path, "rbe");
    if (!file) return false;
    const size_t size = fread(head, 1, sizeof head, file);
    fclose(file);
    return netcdf_head_is_hdf5(head, size);
}

/* libnetcdf takes a name such as http://... for the address of a server. */
static char *netcdf_file_plain_path(const char *path)
{
    size_t length = strlen(path) + 3;
    char *plain = mw__alloc(length, 1);
    if (plain) snprintf(plain, length, "%s%s", path[0] == '/' ? "" : "./", path);
    return plain;
}

mw_status mw__netcdf_open(const char *path, mw_netcdf **out, mw_error *error)
{
    char *plain = netcdf_file_plain_path(path);
    if (!plain) return mw__fail_memory(error);
    struct stat info;
    mw_status status = netcdf_file_start(path, out, error);
    if (!status) {
        (*out)->size = stat(path, &info) == 0 ? (uint64_t)info.st_size : 0;
        status = netcdf_opening_run(&(netcdf_opening){.file = *out, .path = plain},
                                    netcdf_path_is_hdf5(path), out, error);
    }
    free(plain);
    return status;
}

mw_status mw__netcdf_open_memory(const char *name, void *bytes, size_t size, mw_netcdf **out,
                                 mw_error *error)
{
    mw_status status = netcdf_file_start(name, out, error);
    if (status) return status;
    (*out)->size = size;
    (*out)->in_memory = true;
    return netcdf_opening_run(&(netcdf_opening){.file = *out, .bytes = bytes, .size = size},
                              netcdf_head_is_hdf5(bytes, size), out, error);
}
