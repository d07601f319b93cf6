#pragma once
#include <string>

/// A closed terminal, a gone reader or a full disk must not lose a run: nothing here throws, and
/// main() checks at the end whether the answer was written.
namespace verp::cli {

/// Opens streams that the caller closed (`>&-`), so that no file of ours becomes standard output.
/// Writes to them then fail.
void open_missing_streams();

void answer(const std::string& text);

void complain(const std::string& line);

/// The final exit status: an error if the answer was not written. Reports it, unless the reader
/// left.
int after_the_answer(int status);

}  // namespace verp::cli
