#pragma once
#include <string>

/// The three streams of the program. A terminal that is gone, a reader that left or a full disk
/// behind them is no reason to lose a run: nothing here throws, and main() looks once, at the end,
/// whether the answer got out.
namespace verp::cli {

/// Opens what the caller closed (`>&-`), so that no file of ours becomes standard output by chance.
/// What is written there then fails.
void open_missing_streams();

/// To standard output, as it is.
void answer(const std::string& text);

/// To standard error, and a line break.
void complain(const std::string& line);

/// The exit status that remains when the answer did not get out; tells so unless the reader left.
int after_the_answer(int status);

}  // namespace verp::cli
