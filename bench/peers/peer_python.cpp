// peer_python.cpp - SciPy and matplotlib, in a python3 of their own, which takes its times itself.
// Arrays are passed in files without a name, words on pipes.
#include "bench/peers/peer_list.h"
#include "bench/peers/peer_support.h"

#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

namespace peer_python
{
namespace
{

using namespace bench;

// Told "build POINTS TRIANGLES" or "locate QUERIES", it answers "SECONDS BYTES TRIANGLES"; at first
// it tells its version. SciPy locates in its own Delaunay triangulation, whose triangles it hands
// back.
const char script[] = R"(
import sys, time
import numpy
library = sys.argv[1]
path = ['/proc/self/fd/' + number for number in sys.argv[2:]]
def resident():
    with open('/proc/self/statm') as f:
        return int(f.read().split()[1]) * 4096
if library == 'scipy':
    import scipy
    from scipy.spatial import Delaunay
    def build(points, triangles):
        clock = time.perf_counter()
        mesh = Delaunay(points)
        seconds = time.perf_counter() - clock
        with open(path[1], 'wb') as f:
            mesh.simplices.astype(numpy.uint32).tofile(f)
        return mesh.find_simplex, seconds, len(mesh.simplices)
    print('SciPy', scipy.__version__, flush=True)
else:
    import matplotlib
    from matplotlib.tri import Triangulation, TrapezoidMapTriFinder
    def build(points, triangles):
        x, y = points[:, 0].copy(), points[:, 1].copy()
        clock = time.perf_counter()
        finder = TrapezoidMapTriFinder(Triangulation(x, y, triangles))
        return lambda q: finder(q[:, 0], q[:, 1]), time.perf_counter() - clock, len(triangles)
    print('matplotlib', matplotlib.__version__, flush=True)
for line in sys.stdin:
    task, *counts = line.split()
    if task == 'build':
        points = numpy.fromfile(path[0], dtype=float).reshape(-1, 2)
        triangles = numpy.fromfile(path[1], dtype=numpy.uint32).reshape(-1, 3).astype(numpy.int32)
        before = resident()
        find, seconds, count = build(points, triangles)
        print(seconds, max(0, resident() - before), count, flush=True)
    else:
        queries = numpy.fromfile(path[2], dtype=float).reshape(-1, 2)
        clock = time.perf_counter()
        found = find(queries)
        seconds = time.perf_counter() - clock
        with open(path[3], 'wb') as f:
            found.astype(numpy.int64).tofile(f)
        print(seconds, 0, 0, flush=True)
)";

[[noreturn]] void python_fail(const char *why)
{
    throw std::runtime_error(why);
}

// A file in memory.
class SharedFile
{
  public:
    int fd = memfd_create("meshwalk", 0); // inherited

    SharedFile()
    {
        if (fd < 0) python_fail("no file in memory");
    }
    ~SharedFile() { close(fd); }
    SharedFile(const SharedFile &) = delete;
    SharedFile &operator=(const SharedFile &) = delete;

    void put(const void *bytes, size_t size)
    {
        if (ftruncate(fd, 0) != 0) python_fail("a file in memory cannot be cleared");
        for (size_t done = 0; done < size;) {
            ssize_t more =
                pwrite(fd, static_cast<const char *>(bytes) + done, size - done, off_t(done));
            if (more <= 0) python_fail("a file in memory cannot be written");
            done += size_t(more);
        }
    }
    void get(void *bytes, size_t size) const
    {
        for (size_t done = 0; done < size;) {
            ssize_t more = pread(fd, static_cast<char *>(bytes) + done, size - done, off_t(done));
            if (more <= 0) python_fail("a file in memory is short");
            done += size_t(more);
        }
    }
};

struct PythonReply {
    double seconds;
    size_t bytes, triangles;
};

class PythonProcess
{
    pid_t pid = 0;
    FILE *to = nullptr, *from = nullptr;

    std::string line()
    {
        char text[256];
        if (!fgets(text, sizeof text, from)) python_fail("python3 has ended");
        text[strcspn(text, "\n")] = 0;
        return text;
    }

    void start(const char *library, int in, int out)
    {
        std::string number[4];
        const SharedFile *const shared[] = {&points, &triangles, &queries, &answers};
        for (size_t k = 0; k < 4; k++) number[k] = std::to_string(shared[k]->fd);
        const char *words[] = {"python3",
                               "-c",
                               script,
                               library,
                               number[0].c_str(),
                               number[1].c_str(),
                               number[2].c_str(),
                               number[3].c_str(),
                               nullptr};
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        if (posix_spawnp(&pid, words[0], &actions, nullptr, const_cast<char *const *>(words),
                         environ) != 0)
            pid = 0;
        posix_spawn_file_actions_destroy(&actions);
    }

    void end()
    {
        if (to) fclose(to);
        if (from) fclose(from);
        if (pid) waitpid(pid, nullptr, 0);
    }

  public:
    SharedFile points, triangles, queries, answers;
    std::string version;

    explicit PythonProcess(const char *library)
    {
        int in[2], out[2];
        if (pipe2(in, O_CLOEXEC) != 0) python_fail("no pipe");
        if (pipe2(out, O_CLOEXEC) != 0) {
            close(in[0]);
            close(in[1]);
            python_fail("no pipe");
        }
        start(library, in[0], out[1]);
        close(in[0]);
        close(out[1]);
        to = fdopen(in[1], "w");
        from = fdopen(out[0], "r");
        try {
            if (!pid || !to || !from) python_fail("python3 cannot be started");
            version = line();
        } catch (...) {
            end();
            throw;
        }
    }
    ~PythonProcess() { end(); }
    PythonProcess(const PythonProcess &) = delete;
    PythonProcess &operator=(const PythonProcess &) = delete;

    PythonReply ask(const char *task, size_t count)
    {
        PythonReply reply;
        if (fprintf(to, "%s %zu\n", task, count) < 0 || fflush(to) != 0)
            python_fail("python3 has ended");
        if (sscanf(line().c_str(), "%lf %zu %zu", &reply.seconds, &reply.bytes, &reply.triangles) !=
            3)
            python_fail("python3 has failed");
        return reply;
    }
};

struct PythonFinder {
    PythonProcess child;
    const double *points;
    size_t bytes = 0;
    std::vector<uint32_t> own; // triangles of SciPy

    explicit PythonFinder(const char *library) : child(library) {}
};

// NULL where Python does not have the library. It is asked once.
const char *version_of(const char *library, std::string &version, bool &asked)
{
    if (!asked) {
        asked = true;
        try {
            version = PythonProcess(library).version;
        } catch (const std::exception &) {
            version.clear();
        }
    }
    return version.empty() ? nullptr : version.c_str();
}

const char *scipy_version()
{
    static std::string version;
    static bool asked;
    return version_of("scipy", version, asked);
}

const char *matplotlib_version()
{
    static std::string version;
    static bool asked;
    return version_of("matplotlib", version, asked);
}

double build(const char *library, const engine_mesh *mesh, void **self)
try {
    auto finder = std::make_unique<PythonFinder>(library);
    finder->points = mesh->points;
    finder->child.points.put(mesh->points, 2 * mesh->point_count * sizeof(double));
    finder->child.triangles.put(mesh->triangles, 3 * mesh->triangle_count * sizeof(uint32_t));
    PythonReply reply = finder->child.ask("build", mesh->point_count);
    finder->bytes = reply.bytes;
    finder->own.resize(3 * reply.triangles);
    finder->child.triangles.get(finder->own.data(), finder->own.size() * sizeof(uint32_t));
    *self = finder.release();
    return reply.seconds;
} catch (const std::exception &) {
    *self = nullptr;
    return ENGINE_FAILED;
}

double build_scipy(const engine_mesh *mesh, unsigned, void **self)
{
    return build("scipy", mesh, self);
}

double build_matplotlib(const engine_mesh *mesh, unsigned, void **self)
{
    return build("matplotlib", mesh, self);
}

size_t bytes(const void *self)
{
    return static_cast<const PythonFinder *>(self)->bytes;
}

void corners(const void *self, uint64_t answer, double xy[6])
{
    const PythonFinder &finder = *static_cast<const PythonFinder *>(self);
    for (size_t k = 0; k < 6; k++)
        xy[k] = finder.points[2 * size_t(finder.own[3 * answer + k / 2]) + k % 2];
}

void destroy(void *self)
{
    delete static_cast<PythonFinder *>(self);
}

double locate(void *self, const double *queries, size_t n, unsigned, uint64_t *answers)
try {
    static_assert(ENGINE_NONE == uint64_t(-1), "Python's -1 is the answer for no triangle");
    PythonProcess &child = static_cast<PythonFinder *>(self)->child;
    child.queries.put(queries, 2 * n * sizeof(double));
    double seconds = child.ask("locate", n).seconds;
    child.answers.get(answers, n * sizeof(uint64_t));
    return seconds;
} catch (const std::exception &) {
    return ENGINE_FAILED;
}

} // namespace
} // namespace peer_python

const engine_code *peer_python_engine(engine_id id)
{
    using namespace peer_python;
    static const engine_structure delaunay = {scipy_version, build_scipy, bytes, corners, destroy};
    static const engine_structure map = {matplotlib_version, build_matplotlib, bytes, nullptr,
                                         destroy};
    static const engine_code scipy = {&delaunay, locate, nullptr},
                             matplotlib = {&map, locate, nullptr};
    return id == ENGINE_SCIPY ? &scipy : id == ENGINE_MATPLOTLIB ? &matplotlib : nullptr;
}
