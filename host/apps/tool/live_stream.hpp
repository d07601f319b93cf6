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

/// What is typed of a stream.
struct LiveOptions {
  bool on = false;
  std::uint16_t port = 8765;  ///< that viewers offer by themselves
  bool waits = false;
  std::vector<std::string> origins = {};  ///< of pages of others that may watch, too
};

/// --live, --live-wait and --live-origin. Once the command line is parsed, `options.on` says
/// whether.
void declare_live(CLI::App& app, LiveOptions& options);

/// What happens, to viewers on this PC while it happens (host/trace/live). Does nothing if nobody
/// asked for it.
class LiveStream final : public session::Observer {
 public:
  /// Tells on stderr where it is. Throws ToolError: the port is not to be had.
  LiveStream(const std::string& command, const LiveOptions& options);
  ~LiveStream() override;

  void begin(session::Session&) override { wait_for_viewer(); }
  void end(session::Session&) override { finish(); }

  /// Who hears what a robot's trace is given; null: nobody. `name`: among several, empty if it is
  /// alone.
  record::mcap::Listener* robot(const std::string& name = {});
  live::Server* server();
  /// With --live-wait: returns when somebody watches, or the run is interrupted. Its channels are
  /// there by now.
  void wait_for_viewer();
  /// Before a loop in real time, whose thread sends.
  void run_beside_real_time();
  /// There is no more; viewers get what waits for them.
  void finish();

  /// What became of it; empty: nobody asked.
  std::string text() const;
  void add_to(cli::Json& json) const;

 private:
  struct Stream;
  std::unique_ptr<Stream> stream_;  ///< null: nobody asked
};

}  // namespace verp::tool
