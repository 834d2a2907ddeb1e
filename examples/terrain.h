/* terrain.h - what erosion and coarsen share: terrains from files, and into files; options, and
 * how a program ends. */
#ifndef EXAMPLES_TERRAIN_H
#define EXAMPLES_TERRAIN_H

#include <meshwalk/meshwalk.h>

/* Exit codes, those of the program meshwalk. */
enum { END_USAGE = 2, END_INPUT = 3, END_FAILED = 4 };

/* The name to begin messages with; main sets it. */
extern const char *program_name;

/* Print "NAME: ..." on standard error and end the program. */
_Noreturn void fail(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* An error of the library, and the code that it means. */
_Noreturn void fail_with(const mw_error *error);

/* The number that an option was given; ends the program unless it is from `low` to `high`. */
double option_number(const char *name, const char *text, double low, double high);

/* Read a terrain: a mesh as it is, or points, which are triangulated. Its heights are the field
 * "z". Vertices that no triangle has are left out, and so is all but the first of several points
 * at one place. */
mw_mesh *terrain_read(const char *path);

/* Does the ending of the name tell a format to write? Better asked before the work than after it.
 * */
int terrain_can_write(const char *path);
/* A mesh with the field "z", as one in space. */
void terrain_write(const char *path, const mw_mesh *mesh);

/* Seconds of a clock that only goes forward. */
double terrain_clock(void);

#endif
