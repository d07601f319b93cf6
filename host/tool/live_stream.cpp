#include "host/tool/live_stream.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "host/tool/command.hpp"
#include "host/tool/console.hpp"
#include "host/tool/exit_status.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/real_time.hpp"

namespace verp::tool {
namespace {

std::unique_ptr<live::Server> open_server(const std::string& command, std::uint16_t port) {
  try {
    return std::make_unique<live::Server>(port, live::ServerOptions{.name = command});
  } catch (const live::LiveError& error) {
    throw ToolError(kNoDevice,
                    fmt::format("{}: --live {}: {}; another stream has it perhaps: give "
                                "another port, such as --live {}",
                                command, port, error.what(), port < 65535 ? port + 1 : port - 1));
  }
}

}  // namespace

void declare_live(CLI::App& app, LiveOptions& options) {
  app.add_option_function<std::uint16_t>(
         "--live",
         [&options](std::uint16_t port) {
           options.on = true;
           options.port = port;
         },
         "stream to Foxglove, Lichtblick or PlotJuggler on this PC while it happens, on this port "
         "(0: any free one)")
      ->expected(0, 1)
      ->type_name("PORT")
      ->check(CLI::Validator(
          [](std::string& text) {
            const std::string wrong = whole_number_between(0, 65535)(text);
            return wrong.empty() ? "" : wrong + "; a MODEL stands before --live";
          },
          "0..65535"))
      ->default_str(std::to_string(options.port));
  app.add_flag("--live-wait", options.waits, "begin when a viewer has subscribed to something")
      ->needs("--live");
}

LiveStream::LiveStream(const std::string& command, const LiveOptions& options)
    : command_(command), options_(options) {
  if (!options.on) return;
  server_ = open_server(command, options.port);
  complain(
      fmt::format("{}: live on ws://127.0.0.1:{}: open that as a Foxglove WebSocket "
                  "connection{}",
                  command, server_->port(),
                  options.waits ? "; waiting for a viewer's first subscription" : ""));
}

record::mcap::Listener* LiveStream::robot(const std::string& name) {
  return server_ == nullptr ? nullptr : &robots_.emplace_back(*server_, name);
}

void LiveStream::wait_for_viewer() {
  if (server_ != nullptr && options_.waits) server_->wait_for_viewer(interrupted);
}

void LiveStream::run_beside_real_time() {
  if (server_ != nullptr) server_->run_before_others(kLoopPriority - 1);
}

void LiveStream::finish() {
  if (server_ != nullptr) server_->finish();
}

std::string LiveStream::text() const {
  if (server_ == nullptr) return "";
  const live::Counts counts = server_->counts();
  return fmt::format("  {:<18}{} viewers, {} messages sent, {} left out for who was too slow\n",
                     "live", counts.viewers, counts.sent, counts.dropped);
}

void LiveStream::add_to(Json& json) const {
  if (server_ == nullptr) return;
  const live::Counts counts = server_->counts();
  json["live"] = {{"port", server_->port()},
                  {"viewers", counts.viewers},
                  {"sent", counts.sent},
                  {"dropped", counts.dropped}};
}

}  // namespace verp::tool
