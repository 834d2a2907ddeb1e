/* space_engine_trimesh.c - trimesh with embreex, in a python3 of its own, which takes its times
 * itself. Arrays are passed in files of a temporary directory, words on pipes. */
#include "bench/space/space_engine.h"
#include "cli/frame/message.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* Told "build" or "cast", it answers with seconds; at first it tells its version. */
static const char script[] =
    "import os, sys, time\n"
    "import numpy, trimesh\n"
    "from trimesh.ray.ray_pyembree import RayMeshIntersector\n"
    "at = sys.argv[1]\n"
    "print('trimesh', trimesh.__version__, flush=True)\n"
    "for line in sys.stdin:\n"
    "    if line.strip() == 'build':\n"
    "        points = numpy.fromfile(at + '/points').reshape(-1, 3)\n"
    "        faces = numpy.fromfile(at + '/faces', numpy.uint32).reshape(-1, 3)\n"
    "        clock = time.perf_counter()\n"
    "        mesh = trimesh.Trimesh(points, faces.astype(numpy.int64), process=False)\n"
    "        caster = RayMeshIntersector(mesh)\n"
    "        caster.intersects_first(points[:1], numpy.ones((1, 3)))\n"
    "    else:\n"
    "        rays = numpy.fromfile(at + '/rays').reshape(-1, 6)\n"
    "        clock = time.perf_counter()\n"
    "        found = caster.intersects_first(rays[:, :3], rays[:, 3:])\n"
    "    seconds = time.perf_counter() - clock\n"
    "    if line.strip() != 'build':\n"
    "        found.astype(numpy.int64).astype(numpy.uint32).tofile(at + '/found')\n"
    "    print(seconds, flush=True)\n";

typedef struct python_caster {
    char directory[64];
    pid_t pid;
    FILE *to, *from;
} python_caster;

static void caster_path(const python_caster *c, const char *name, char path[128])
{
    snprintf(path, 128, "%s/%s", c->directory, name);
}

static bool caster_put(const python_caster *c, const char *name, const void *bytes, size_t size)
{
    char path[128];
    caster_path(c, name, path);
    FILE *file = fopen(path, "wb");
    bool done = file && fwrite(bytes, 1, size, file) == size;
    if (file && fclose(file) != 0) done = false;
    return done;
}

static bool caster_get(const python_caster *c, const char *name, void *bytes, size_t size)
{
    char path[128];
    caster_path(c, name, path);
    FILE *file = fopen(path, "rb");
    bool done = file && fread(bytes, 1, size, file) == size;
    if (file) fclose(file);
    return done;
}

static void caster_destroy(void *self)
{
    static const char *const names[] = {"points", "faces", "rays", "found"};
    python_caster *c = self;
    char path[128];
    if (!c) return;
    if (c->to) fclose(c->to);
    if (c->from) fclose(c->from);
    if (c->pid > 0) waitpid(c->pid, NULL, 0);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        caster_path(c, names[i], path);
        unlink(path);
    }
    if (c->directory[0]) rmdir(c->directory);
    free(c);
}

/* In the child: python3 with the ends of two pipes. */
static void caster_become_python(const python_caster *c, const int in[2], const int out[2])
{
    dup2(in[0], STDIN_FILENO);
    dup2(out[1], STDOUT_FILENO);
    for (int k = 0; k < 2; k++) {
        close(in[k]);
        close(out[k]);
    }
    if (!freopen("/dev/null", "w", stderr)) _exit(127);
    execlp("python3", "python3", "-c", script, c->directory, (char *)NULL);
    _exit(127);
}

/* Returns NULL where python3, trimesh or embreex is missing. */
static python_caster *caster_start(char version[64])
{
    python_caster *c = calloc(1, sizeof *c);
    int in[2] = {-1, -1}, out[2] = {-1, -1};
    if (!c) return NULL;
    strcpy(c->directory, "/tmp/meshwalk-bench-XXXXXX");
    if (!mkdtemp(c->directory)) c->directory[0] = 0;
    if (!c->directory[0] || pipe(in) != 0 || pipe(out) != 0) {
        caster_destroy(c);
        return NULL;
    }
    c->pid = fork();
    if (c->pid == 0) caster_become_python(c, in, out);
    close(in[0]);
    close(out[1]);
    c->to = fdopen(in[1], "w");
    c->from = fdopen(out[0], "r");
    if (c->to && c->from && fgets(version, 64, c->from)) {
        version[strcspn(version, "\n")] = 0;
        return c;
    }
    caster_destroy(c);
    return NULL;
}

static const char *caster_version(void)
{
    static char version[64];
    static bool known = false;
    if (known) return version[0] ? version : NULL;
    known = true;
    python_caster *c = caster_start(version);
    if (!c) version[0] = 0;
    caster_destroy(c);
    return version[0] ? version : NULL;
}

/* Returns the seconds that Python tells, or a negative number after a complaint. */
static double caster_ask(python_caster *c, const char *word)
{
    char line[64];
    fprintf(c->to, "%s\n", word);
    if (fflush(c->to) == 0 && fgets(line, sizeof line, c->from)) return strtod(line, NULL);
    complain("bench space: python3 with trimesh has ended");
    return -1;
}

static double caster_make(python_caster *c, const space_model *m)
{
    if (caster_put(c, "points", m->points, 3 * m->point_count * sizeof *m->points) &&
        caster_put(c, "faces", m->triangles, 3 * m->triangle_count * sizeof *m->triangles))
        return caster_ask(c, "build");
    complain("bench space: %s: %s", c->directory, strerror(errno));
    return -1;
}

static void *caster_build(const space_model *m, uint32_t threads, double *seconds, size_t *bytes)
{
    char version[64];
    python_caster *c = caster_start(version);
    (void)threads;
    *bytes = 0;
    *seconds = c ? caster_make(c, m) : -1;
    if (*seconds >= 0) return c;
    caster_destroy(c);
    return NULL;
}

static double caster_cast(void *scene, unsigned way, const space_rays *rays, space_rays_kind kind,
                          uint32_t threads, uint32_t *found)
{
    python_caster *c = scene;
    (void)way;
    (void)kind;
    (void)threads;
    double seconds = -1;
    if (caster_put(c, "rays", rays->ray, 6 * rays->count * sizeof *rays->ray))
        seconds = caster_ask(c, "cast");
    if (seconds >= 0 && caster_get(c, "found", found, rays->count * sizeof *found)) return seconds;
    complain("bench space: no answers of trimesh");
    return -1;
}

static double caster_follow(void *scene, unsigned way, const space_model *m, size_t moved,
                            double farthest, uint32_t threads)
{
    (void)way;
    (void)moved;
    (void)farthest;
    (void)threads;
    return caster_make(scene, m);
}

const space_engine space_engine_trimesh = {
    .name = "trimesh",
    .casts = {"batch"},
    .follows = {"rebuild"},
    .version = caster_version,
    .build = caster_build,
    .cast = caster_cast,
    .follow = caster_follow,
    .destroy = caster_destroy,
};
