#pragma once

namespace verp::tool {

/// From now on SIGINT and SIGTERM ask the run to end instead of ending the program; a second one
/// ends it at once. A reader that went away (SIGPIPE) is no reason to lose a run.
void catch_interrupts();

/// Whether somebody asked.
bool interrupted();

}  // namespace verp::tool
