/* commands.h - the commands of meshwalk-mpi. Private. */
#ifndef MWP_PROGRAM_COMMANDS_H
#define MWP_PROGRAM_COMMANDS_H

#include "cli/frame/options.h"
#include "mpi/program/service.h"

extern const command locate_pieces_command, sample_pieces_command, weights_pieces_command;

/* The ranks that carry out what the command orders. There is one such service for the program. */
service *program_service(void);

#endif
