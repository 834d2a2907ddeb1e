/* descriptor.h - files are opened beyond the standard streams. Private.
 *
 * If a program was started with a standard stream closed, open() would give the number of that
 * stream to the next file. What is meant for the stream would then be written to that file, or be
 * read from it. */
#ifndef MW_SRC_IO_TEXT_DESCRIPTOR_H
#define MW_SRC_IO_TEXT_DESCRIPTOR_H

/* open(), never one of the descriptors 0 to 2, and closed by exec. -1 with errno; then a file made
 * by O_EXCL is gone again. */
int mw__descriptor_open(const char *path, int flags, unsigned mode);

/* Another descriptor of the same file, as above; -1 with errno. */
int mw__descriptor_duplicate(int fd);

#endif
