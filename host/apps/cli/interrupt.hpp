#pragma once

namespace verp::cli {

/// From now on, a gone reader (SIGPIPE) or a file-size limit (SIGXFSZ) makes the write fail instead
/// of ending the program.
void keep_failing_writes();

/// From now on, SIGINT, SIGTERM and SIGHUP (unless under `nohup`) request the run's end; a second
/// one ends the program. For subcommands that poll interrupted().
void catch_interrupts();

/// Like catch_interrupts(), but no signal ends the program: it must first release a robot's torque.
void catch_interrupts_to_the_end();

/// Number of requests: 0, 1, or 2 for more.
int presses();

bool interrupted();

/// After an interrupt, a failed run's status is 130 (Ctrl-C) or 143 (SIGTERM).
int status_if_interrupted(int status);

}  // namespace verp::cli
