#include <filesystem>
#include <fstream>
#include <iostream>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/study/trace_words.hpp"
#include "host/os/files/whole.hpp"
#include "host/study/signals/csv.hpp"

namespace verp::tool {
namespace {

/// Writes files completely or not at all; streams to devices and pipes.
void write_whole(signals::Table& table, const std::filesystem::path& file) {
  files::NewFile made(file);
  if (made.trouble().any())
    throw cli::ToolError(cli::kBadInput, file.string() + ": " + made.trouble().text());
  std::ofstream out(made.part());
  signals::write_csv(table, out);
  out.close();
  if (out && !made.keep().any()) return;
  throw cli::ToolError(
      cli::kRunFailed,
      file.string() + ": cannot be written to its end; free space, or write elsewhere");
}

}  // namespace

int export_csv(const TraceWords& words) {
  refuse_same_file(words);
  const record::Trace trace = load_trace(words);
  signals::Table table(trace, words.states);
  if (words.output.empty() || words.output == "-") {
    signals::write_csv(table, std::cout);
  } else {
    write_whole(table, words.output);
  }
  tell_of_other_decisions(trace, table.other_from());
  return cli::kGood;
}

}  // namespace verp::tool
