#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/tool/study/trace_words.hpp"
#include "host/os/link/system_clock.hpp"
#include "host/trace/live/server.hpp"
#include "host/trace/record/in_order.hpp"
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

}  // namespace

int play(const TraceWords& words) {
  record::mcap::Reader reader = record::open_mcap(words.file);
  const record::mcap::File& file = reader.read();
  record::refuse_flaw(words.file, file);  // a merged trace plays as well
  record::InOrder messages({{words.file, &reader}});
  const std::uint64_t count = file.messages;
  LiveStream live("verp trace play", words.live);
  record::mcap::Listener& to = *live.robot();
  for (const auto& [id, schema] : file.schemas) to.schema(id, schema);
  for (const auto& [id, channel] : file.channels) to.channel(id, channel);
  live.wait_for_viewer();
  const std::uint64_t begun_ns = link::monotonic_ns();
  std::optional<std::uint64_t> first_ns;
  std::size_t played = 0;
  while (const auto next = messages.next()) {
    const record::mcap::Message& message = next->message;
    if (!first_ns) first_ns = message.time_ns;
    const auto after_ns = static_cast<double>(message.time_ns - *first_ns) / words.rate;
    if (!sleep_until(begun_ns + static_cast<std::uint64_t>(after_ns))) break;
    to.message(message.channel, message.time_ns, message.data);
    ++played;
  }
  live.finish();
  cli::answer(
      fmt::format("{}: {} of {} messages played\n{}", words.file, played, count, live.text()));
  if (played == count) return cli::kGood;
  cli::complain("verp trace play: interrupted");
  return cli::kRunFailed;
}

}  // namespace verp::tool
