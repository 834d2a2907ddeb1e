#define _GNU_SOURCE /* F_DUPFD_CLOEXEC, O_CLOEXEC */
#include "io/text/descriptor.h"
#include "base/posix.h"

#include <errno.h>

int mw__descriptor_duplicate(int fd)
{
    return fcntl(fd, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
}

int mw__descriptor_open(const char *path, int flags, unsigned mode)
{
    int fd = open(path, flags | O_CLOEXEC, (mode_t)mode);
    if (fd < 0 || fd > STDERR_FILENO) return fd;
    int other = mw__descriptor_duplicate(fd), number = errno;
    close(fd);
    if (other < 0 && flags & O_EXCL) unlink(path);
    errno = number;
    return other;
}
