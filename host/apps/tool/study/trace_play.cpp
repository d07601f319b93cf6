#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/tool/study/trace_words.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/trace/live/server.hpp"
#include "host/trace/record/trace_parts.hpp"

namespace verp::tool {
namespace {

constexpr std::uint64_t kNap_ns = 20'000'000;  // interval between checks of Ctrl-C

/// False: interrupted.
bool sleep_until(std::uint64_t time_ns) {
  while (!cli::interrupted()) {
    const std::uint64_t now_ns = link::monotonic_ns();
    if (now_ns >= time_ns) return true;
    link::sleep_until_ns(std::min(time_ns, now_ns + kNap_ns));
  }
  return false;
}

std::vector<const record::mcap::Message*> in_order(const record::mcap::File& file) {
  std::vector<const record::mcap::Message*> all;
  for (const record::mcap::Message& message : file.messages) all.push_back(&message);
  std::stable_sort(all.begin(), all.end(),
                   [](const auto* a, const auto* b) { return a->time_ns < b->time_ns; });
  return all;
}

}  // namespace

int play(const TraceWords& words) {
  const std::string bytes = record::read_trace_bytes(words.file);
  const record::mcap::File file = record::mcap::parse(bytes);
  record::refuse_flaw(words.file, file);  // a merged trace plays as well
  LiveStream live("verp trace play", words.live);
  record::mcap::Listener& to = *live.robot();
  for (const auto& [id, schema] : file.schemas) to.schema(id, schema);
  for (const auto& [id, channel] : file.channels) to.channel(id, channel);
  const auto messages = in_order(file);
  live.wait_for_viewer();
  const std::uint64_t begun_ns = link::monotonic_ns();
  const std::uint64_t first_ns = messages.empty() ? 0 : messages.front()->time_ns;
  std::size_t played = 0;
  for (const record::mcap::Message* message : messages) {
    const auto after_ns = static_cast<double>(message->time_ns - first_ns) / words.rate;
    if (!sleep_until(begun_ns + static_cast<std::uint64_t>(after_ns))) break;
    to.message(message->channel, message->time_ns, message->data);
    ++played;
  }
  live.finish();
  cli::answer(fmt::format("{}: {} of {} messages played\n{}", words.file, played, messages.size(),
                          live.text()));
  if (played == messages.size()) return cli::kGood;
  cli::complain("verp trace play: interrupted");
  return cli::kRunFailed;
}

}  // namespace verp::tool
