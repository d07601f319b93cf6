#pragma once

namespace verp::tool {

/// From now on SIGINT, SIGTERM and SIGHUP (the terminal was closed; unless `nohup` has us ignore
/// it) ask the run to end instead of ending the program; a second one ends it at once. A reader
/// that went away (SIGPIPE) or a limit on the size of files (SIGXFSZ) is no reason to lose a run:
/// the write that meets it fails.
void catch_interrupts();

/// Whether somebody asked.
bool interrupted();

}  // namespace verp::tool
