#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/apps/cli/json.hpp"
#include "host/run/session/session.hpp"

namespace CLI {
class App;
}

namespace verp::live {
class Server;
}
namespace verp::record::mcap {
class Listener;
}

namespace verp::tool {

struct LiveOptions {
  bool on = false;
  std::uint16_t port = 8765;  ///< default of the viewers
  bool waits = false;
  std::vector<std::string> origins = {};  ///< further web pages that may watch
};

void declare_live(CLI::App& app, LiveOptions& options);

/// Streams to viewers on this PC (host/trace/live). Does nothing without --live.
class LiveStream final : public session::Observer {
 public:
  /// Prints the address. Throws ToolError if the port is taken.
  LiveStream(const std::string& command, const LiveOptions& options);
  ~LiveStream() override;

  void begin(session::Session&) override { wait_for_viewer(); }
  void end(session::Session&) override { finish(); }

  /// Null without --live. `name`: empty for a single robot.
  record::mcap::Listener* robot(const std::string& name = {});
  live::Server* server();
  /// With --live-wait, waits for a viewer's subscription or an interrupt. Call it when all channels
  /// exist.
  void wait_for_viewer();
  /// Gives the server a priority just below a real-time loop's; call it before the loop.
  void run_beside_real_time();
  void finish();

  std::string text() const;
  void add_to(cli::Json& json) const;

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;  ///< null without --live
};

}  // namespace verp::tool
