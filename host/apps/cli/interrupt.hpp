#pragma once

namespace verp::cli {

/// From now on a reader that went away (SIGPIPE) or a limit on the size of files (SIGXFSZ) ends
/// nothing: the write that meets it fails.
void keep_failing_writes();

/// From now on SIGINT, SIGTERM and SIGHUP (the terminal was closed; unless `nohup` has us ignore
/// it) ask the run to end instead of ending the program; a second one ends it at once. For
/// subcommands that look at interrupted().
void catch_interrupts();

/// Likewise, but no press ends the program: who holds a robot's torque lets go of it first.
void catch_interrupts_to_the_end();

/// 0, 1, or 2: somebody asked, and asked again.
int presses();

/// Whether somebody asked.
bool interrupted();

/// Of a run that failed since somebody asked it to end, what shells say of one that a signal ended:
/// 130 after Ctrl-C, 143 after SIGTERM. Any other status is as it was.
int status_if_interrupted(int status);

}  // namespace verp::cli
