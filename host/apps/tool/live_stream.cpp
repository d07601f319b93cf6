#include "host/apps/tool/live_stream.hpp"

#include <fmt/format.h>

#include <deque>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/real_time.hpp"
#include "host/trace/live/robot_stream.hpp"

namespace verp::tool {
namespace {

std::unique_ptr<live::Server> open_server(const std::string& command, const LiveOptions& options) {
  const std::uint16_t port = options.port;
  try {
    return std::make_unique<live::Server>(
        port, live::ServerOptions{.name = command, .origins = options.origins});
  } catch (const live::LiveError& error) {
    throw cli::ToolError(
        cli::kNoDevice,
        fmt::format("{}: --live {}: {}; another stream has it perhaps: give "
                    "another port, such as --live {}",
                    command, port, error.what(), port < 65535 ? port + 1 : port - 1));
  }
}

}  // namespace

struct LiveStream::Stream {
  bool waits;
  std::unique_ptr<live::Server> server;
  std::deque<live::RobotStream> robots = {};
};

LiveStream::LiveStream(const std::string& command, const LiveOptions& options) {
  if (!options.on) return;
  stream_.reset(new Stream{options.waits, open_server(command, options)});
  cli::complain(
      fmt::format("{}: live on ws://127.0.0.1:{}: open that as a Foxglove WebSocket "
                  "connection{}",
                  command, server()->port(),
                  options.waits ? "; waiting for a viewer's first subscription" : ""));
}

LiveStream::~LiveStream() = default;

live::Server* LiveStream::server() {
  return stream_ == nullptr ? nullptr : stream_->server.get();
}

record::mcap::Listener* LiveStream::robot(const std::string& name) {
  return stream_ == nullptr ? nullptr : &stream_->robots.emplace_back(*stream_->server, name);
}

void LiveStream::wait_for_viewer() {
  if (stream_ != nullptr && stream_->waits) stream_->server->wait_for_viewer(cli::interrupted);
}

void LiveStream::run_beside_real_time() {
  if (stream_ != nullptr) stream_->server->run_before_others(cli::kLoopPriority - 1);
}

void LiveStream::finish() {
  if (stream_ != nullptr) stream_->server->finish();
}

std::string LiveStream::text() const {
  if (stream_ == nullptr) return "";
  const live::Counts counts = stream_->server->counts();
  return fmt::format("  {:<18}{} viewers, {} messages sent, {} left out for who was too slow\n",
                     "live", counts.viewers, counts.sent, counts.dropped);
}

void LiveStream::add_to(cli::Json& json) const {
  if (stream_ == nullptr) return;
  const live::Counts counts = stream_->server->counts();
  json["live"] = {{"port", stream_->server->port()},
                  {"viewers", counts.viewers},
                  {"sent", counts.sent},
                  {"dropped", counts.dropped}};
}

}  // namespace verp::tool
