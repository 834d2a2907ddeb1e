#include "bench/core/machine.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

#define MODEL "model name"

void machine_processor(char *name, size_t size)
{
    char line[512];
    FILE *info = fopen("/proc/cpuinfo", "r");
    snprintf(name, size, "unknown processor");
    while (info && fgets(line, sizeof line, info)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, MODEL, sizeof MODEL - 1) != 0 || !colon) continue;
        line[strcspn(line, "\n")] = 0;
        snprintf(name, size, "%s", colon[1] == ' ' ? colon + 2 : colon + 1);
        break;
    }
    if (info) fclose(info);
}

void machine_date(machine_date_text date)
{
    struct tm day;
    time_t now = time(NULL);
    strftime(date, sizeof(machine_date_text), "%Y-%m-%d", gmtime_r(&now, &day));
}
