/* version.h - the version of the library, written once; CMake reads it from here. */
#ifndef MESHWALK_VERSION_H
#define MESHWALK_VERSION_H

#define MW_VERSION_MAJOR 0
#define MW_VERSION_MINOR 1
#define MW_VERSION_PATCH 0
#define MW_VERSION_STRING "0.1.0"

#endif
