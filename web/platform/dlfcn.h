/* dlfcn.h - a browser loads no libraries: netCDF files are refused with the library's message. */
#ifndef MW_WEB_DLFCN_H
#define MW_WEB_DLFCN_H

#include <stddef.h>

enum { RTLD_NOW, RTLD_LOCAL, RTLD_NODELETE };

static inline void *dlopen(const char *name, int flags)
{
    (void)name;
    (void)flags;
    return NULL;
}

static inline void *dlsym(void *library, const char *name)
{
    (void)library;
    (void)name;
    return NULL;
}

static inline int dlclose(void *library)
{
    return (void)library, 0;
}

#endif
