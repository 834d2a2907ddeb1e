/* hostile.c - the program: runs rounds of hostile input until the time is up.
 *
 *   hostile [--seconds S] [--seed N] [--rounds N] [SUBJECT ...]
 *
 * Without a subject, all of them take turns. Each round has a seed of its own; a failure prints the
 * command that repeats it. */
#include "hostile/hostile.h"
#include "base/clock.h"
#include "oracle/edit_require.h"

#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct subject {
    const char *name;
    hostile_round *round;
} subject;

static const subject subjects[] = {
    {"soup", hostile_soup},           {"graded", hostile_graded}, {"hubs", hostile_hubs},
    {"exponents", hostile_exponents}, {"stars", hostile_stars},   {"probes", hostile_probes},
    {"edits", hostile_edits},         {"memory", hostile_memory}, {"files", hostile_files},
    {"cancels", hostile_cancels},     {"forks", hostile_forks},
};
enum { SUBJECTS = sizeof subjects / sizeof *subjects, LONGEST_ROUND = 300 /* seconds */ };

static const char *subject_now = "";
static uint64_t seed_now;

uint64_t hostile_seed(void)
{
    return seed_now;
}

void hostile_failed(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vfprintf(stderr, format, list);
    va_end(list);
    fprintf(stderr, "\nrepeat with: hostile --rounds 1 --seed %llu %s\n",
            (unsigned long long)seed_now, subject_now);
    abort();
}

/* A signal ends the program as it would have, after saying which round it was. */
static void say_which(int signal_number)
{
    char text[160];
    int length =
        snprintf(text, sizeof text, "%s\nrepeat with: hostile --rounds 1 --seed %llu %s\n",
                 signal_number == SIGALRM ? "a round hangs" : "a round was ended by a signal",
                 (unsigned long long)seed_now, subject_now);
    if (write(2, text, (size_t)length) < 0) _exit(1);
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static void run_round(const subject *s, uint64_t seed)
{
    uint64_t random = mw__random_seed(seed, 0);
    subject_now = s->name;
    seed_now = seed;
    edit_case = (edit_case_now){.name = s->name, .seed = seed};
    alarm(LONGEST_ROUND);
    s->round(&random);
    alarm(0);
}

typedef struct arguments {
    double seconds;
    uint64_t seed, rounds; /* rounds 0: until the time is up */
    const subject *chosen[SUBJECTS];
    size_t count;
} arguments;

static void usage(const char *wrong)
{
    fprintf(stderr,
            "hostile: %s\nusage: hostile [--seconds S] [--seed N] [--rounds N] [SUBJECT "
            "...]\nsubjects:",
            wrong);
    for (size_t i = 0; i < SUBJECTS; i++) fprintf(stderr, " %s", subjects[i].name);
    fprintf(stderr, "\n");
    exit(2);
}

static void choose(arguments *a, const char *name)
{
    for (size_t i = 0; i < SUBJECTS; i++)
        if (strcmp(subjects[i].name, name) == 0 && a->count < SUBJECTS) {
            a->chosen[a->count++] = &subjects[i];
            return;
        }
    usage(name);
}

static arguments read_arguments(int argc, char **argv)
{
    arguments a = {.seconds = 10, .seed = 1};
    for (int i = 1; i < argc; i++) {
        if (strncmp(argv[i], "--", 2) != 0) {
            choose(&a, argv[i]);
            continue;
        }
        if (i + 1 == argc) usage("an option needs its value");
        const char *value = argv[i + 1];
        if (strcmp(argv[i], "--seconds") == 0)
            a.seconds = strtod(value, NULL);
        else if (strcmp(argv[i], "--seed") == 0)
            a.seed = strtoull(value, NULL, 10);
        else if (strcmp(argv[i], "--rounds") == 0)
            a.rounds = strtoull(value, NULL, 10);
        else
            usage(argv[i]);
        i++;
    }
    for (size_t i = 0; a.count == 0 && i < SUBJECTS; i++) a.chosen[i] = &subjects[i];
    if (a.count == 0) a.count = SUBJECTS;
    return a;
}

int main(int argc, char **argv)
{
    arguments a = read_arguments(argc, argv);
    const int signals[] = {SIGALRM, SIGSEGV, SIGABRT, SIGFPE, SIGBUS};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) signal(signals[i], say_which);
    double end = mw__seconds() + a.seconds;
    uint64_t round = 0;
    for (; a.rounds ? round < a.rounds : mw__seconds() < end; round++)
        for (size_t i = 0; i < a.count; i++) run_round(a.chosen[i], a.seed + round);
    printf("%llu rounds from seed %llu of:", (unsigned long long)round, (unsigned long long)a.seed);
    for (size_t i = 0; i < a.count; i++) printf(" %s", a.chosen[i]->name);
    printf("; nothing found\n");
    return 0;
}
