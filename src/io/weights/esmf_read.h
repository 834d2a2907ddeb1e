/* esmf_read.h - weights in the layout of ESMF's weight files, from a file that is open. Private. */
#ifndef MW_SRC_IO_WEIGHTS_ESMF_READ_H
#define MW_SRC_IO_WEIGHTS_ESMF_READ_H

#include "base/job.h"
#include "io/netcdf/netcdf_file.h"

#include <meshwalk/weights.h>

/* Errors name the file and the variable; MW_ERROR_MEMORY also where the job is to stop. */
mw_status mw__esmf_read(const mw_netcdf *file, mw_job *job, mw_operator **out, mw_error *error);

#endif
