/* missing.h - what the library uses of POSIX and WASI has not: read before every file. */
#ifndef MW_WEB_MISSING_H
#define MW_WEB_MISSING_H

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* No process numbers; a file is never written over another process's. */
#define getpid() 1

/* Names are as they are, and files have no permissions. */
#define realpath(path, resolved) strdup(path)
#define fchmod(descriptor, mode) ((void)0)

/* Descriptors 0 to 2 are taken from the beginning, so none is ever duplicated. */
#define F_DUPFD_CLOEXEC 1030

#endif
