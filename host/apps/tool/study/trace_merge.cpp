#include "host/trace/record/trace_merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/study/trace_words.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// "lead=a.mcap", or a file that gives the name.
record::NamedTrace named_trace(const std::string& word) {
  const std::size_t equals = word.find('=');
  std::error_code error;
  if (equals == std::string::npos || fs::exists(word, error)) {
    std::string name = fs::path(word).stem().string();
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !is_letter(c); }, '_');
    return {name, word};
  }
  const std::string name = word.substr(0, equals);
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_letter)) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp trace merge: {}: a robot's name is of letters, "
                                     "digits and _; give NAME=FILE",
                                     word));
  }
  return {name, word.substr(equals + 1)};
}

}  // namespace

int merge(const TraceWords& words) {
  std::vector<record::NamedTrace> traces;
  for (const std::string& word : words.files) {
    const record::NamedTrace named = named_trace(word);
    const auto same = std::find_if(traces.begin(), traces.end(),
                                   [&](const auto& each) { return each.robot == named.robot; });
    if (same != traces.end()) {
      throw cli::ToolError(
          cli::kBadInput,
          fmt::format("verp trace merge: {} and {}: two robots called {}; "
                      "give NAME={}",
                      same->file.string(), named.file.string(), named.robot, named.file.string()));
    }
    TraceWords one = words;
    one.file = named.file.string();
    refuse_same_file(one);
    traces.push_back(named);
  }
  if (traces.size() < 2) {
    throw cli::ToolError(cli::kBadInput, "verp trace merge: give two traces or more");
  }
  const std::size_t messages = record::merge_traces(traces, words.output, compression_of(words));
  cli::answer(fmt::format("{}: {} robots, {} messages\n", words.output, traces.size(), messages));
  return cli::kGood;
}

}  // namespace verp::tool
