#pragma once

namespace verp::cli {

/// Makes writes to a gone reader (SIGPIPE) or beyond a file-size limit (SIGXFSZ) fail instead of
/// ending the program.
void keep_failing_writes();

/// Makes SIGINT, SIGTERM and SIGHUP (a closed terminal, unless under `nohup`) request the run's
/// end; a second one ends the program. For subcommands that poll interrupted().
void catch_interrupts();

/// The same, but no signal ends the program, because it must first release a robot's torque.
void catch_interrupts_to_the_end();

/// Number of requests: 0, 1, or 2 for more.
int presses();

bool interrupted();

/// The shell's status for a run that failed after an interrupt: 130 after Ctrl-C, 143 after
/// SIGTERM. Other statuses stay.
int status_if_interrupted(int status);

}  // namespace verp::cli
