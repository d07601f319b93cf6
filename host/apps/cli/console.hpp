#pragma once
#include <string>

/// Standard output and error. A closed terminal, a gone reader or a full disk must not lose a run,
/// so nothing here throws; main() checks at the end whether the answer was written.
namespace verp::cli {

/// Opens the streams that the caller closed (`>&-`), so that no file of ours becomes standard
/// output by chance. Writes to them then fail.
void open_missing_streams();

/// Writes `text` to standard output.
void answer(const std::string& text);

/// Writes `line` and a line break to standard error.
void complain(const std::string& line);

/// The final exit status: an error if the answer was not written. Reports that, unless the reader
/// left.
int after_the_answer(int status);

}  // namespace verp::cli
