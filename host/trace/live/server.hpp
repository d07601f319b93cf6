#pragma once
#include <poll.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "host/trace/live/connection.hpp"
#include "host/trace/live/live_error.hpp"
#include "host/trace/live/protocol.hpp"
#include "host/trace/live/subscriber.hpp"

namespace verp::live {

struct ServerOptions {
  std::string name = "VERP";                       ///< that viewers show
  std::vector<std::string> origins = {};           ///< of pages of others that may watch, too
  std::size_t most_bytes = 16 * 1024 * 1024;       ///< that may wait for one viewer
  std::chrono::milliseconds patience{2000};        ///< at the end, with one that takes nothing
  std::chrono::milliseconds patience_all{10'000};  ///< at the end, with all
};

/// What became of the stream.
struct Counts {
  std::uint64_t viewers = 0, sent = 0, dropped = 0;
};

/// Messages to whoever watches on this PC, by Foxglove's WebSocket protocol, from a thread of its
/// own. Whoever sends never waits for a viewer, and nothing that a viewer says reaches the sender.
/// Who subscribes gets the channel's last message first: a description that is sent once, too.
/// Any thread may call any function.
class Server {
 public:
  /// Offers 127.0.0.1:port; 0: any free one. Throws LiveError: the port is not to be had.
  explicit Server(std::uint16_t port, ServerOptions options = {});
  ~Server();  ///< finish()
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const { return port_; }
  /// The channel's number. Its own `id` is not looked at.
  std::uint32_t add_channel(Channel channel);
  std::optional<std::uint32_t> find_channel(std::string_view topic) const;
  void send(std::uint32_t channel, std::uint64_t time_ns, std::string_view data);

  /// Its thread runs before all that is not urgent (SCHED_FIFO), if the system lets it: it holds
  /// what a sender needs for some microseconds, and a sender that is urgent waits for no program
  /// that took the processor meanwhile. `priority`: below the sender's. False: the system lets
  /// nobody.
  bool run_before_others(int priority);
  /// Returns when a viewer has subscribed to something and for 0.3 s none to more (many subscribe
  /// to channel after channel, and what is sent meanwhile would be lost to them), or when
  /// `given_up`, which calls nothing of the server, says so.
  void wait_for_viewer(const std::function<bool()>& given_up);
  /// Sends what waits, as long as a viewer takes it, and says goodbye. Nothing is sent afterwards.
  void finish();
  Counts counts() const;

 private:
  struct Viewer {
    Viewer(Server& server, int socket)
        : connection(
              socket,
              [this, &server](bool is_text, std::string_view message) {
                server.hear(*this, is_text, message);
              },
              server.options_.origins),
          subscriber(server.options_.most_bytes) {}
    Connection connection;  ///< the thread's own
    Subscriber subscriber;  ///< under the lock
    bool greeted = false;   ///< knows the channels
  };
  struct KnownChannel {
    Channel channel;
    std::optional<Stamped> last;
  };

  void serve();
  void wait(std::chrono::milliseconds most);
  void accept_all();
  void hear(Viewer& viewer, bool is_text, std::string_view message);
  bool pump(Viewer& viewer);
  void greet(Viewer& viewer);
  void say_goodbye(Viewer& viewer, Connection::Clock::time_point since);
  void remove_gone();
  void wake();

  const ServerOptions options_;
  int listener_ = -1, bell_ = -1;
  std::uint16_t port_ = 0;
  bool rests_ = false;  ///< there was no descriptor for one who came
  std::vector<pollfd> polled_;
  std::atomic<bool> rung_ = false, finishing_ = false;

  mutable std::mutex lock_;
  std::condition_variable subscribed_;
  Connection::Clock::time_point changed_{};  ///< a channel was added, or subscribed to
  std::vector<KnownChannel> channels_;
  std::vector<std::unique_ptr<Viewer>> viewers_;
  std::uint64_t now_ns_ = 0;
  Counts gone_;  ///< of those who left
  std::thread thread_;
};

}  // namespace verp::live
