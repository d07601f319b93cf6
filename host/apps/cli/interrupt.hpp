#pragma once

namespace verp::cli {

/// A gone reader (SIGPIPE) or a file-size limit (SIGXFSZ) then fails the write instead of ending
/// the program.
void keep_failing_writes();

/// SIGINT, SIGTERM and SIGHUP (unless under `nohup`) request the run's end; a second one ends the
/// program. For subcommands that poll interrupted().
void catch_interrupts();

/// Like catch_interrupts(), but no signal ends the program: it must first release a robot's torque.
void catch_interrupts_to_the_end();

/// Requests: 0, 1, or 2 for more.
int presses();

bool interrupted();

/// After an interrupt, a failed run's status is 130 (Ctrl-C) or 143 (SIGTERM).
int status_if_interrupted(int status);

}  // namespace verp::cli
