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
  std::string name = "VERP";
  std::vector<std::string> origins = {};           ///< further Origins whose pages may connect
  std::size_t most_bytes = 16 * 1024 * 1024;       ///< of one viewer's queue
  std::chrono::milliseconds patience{2000};        ///< for a viewer that reads nothing
  std::chrono::milliseconds patience_all{10'000};  ///< for all viewers
};

struct Counts {
  std::uint64_t viewers = 0, sent = 0, dropped = 0;
};

/// Streams to viewers on this PC by Foxglove's WebSocket protocol, from its own thread. A sender
/// never waits. A new subscriber first gets the channel's last message, so that descriptions reach
/// it. Any thread may call it.
class Server {
 public:
  /// Listens on 127.0.0.1:port; 0: any free port. Throws LiveError if it is not available.
  explicit Server(std::uint16_t port, ServerOptions options = {});
  ~Server();  ///< finish()
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const { return port_; }
  /// Returns the channel's number; ignores its `id`.
  std::uint32_t add_channel(Channel channel);
  std::optional<std::uint32_t> find_channel(std::string_view topic) const;
  void send(std::uint32_t channel, std::uint64_t time_ns, std::string_view data);

  /// Gives the server's thread SCHED_FIFO `priority`, below the sender's. Otherwise it could be
  /// preempted while it holds, for microseconds, a lock that senders need. False: denied.
  bool run_before_others(int priority);
  /// Waits until a viewer subscribed and then paused for 0.3 s, because it may subscribe channel by
  /// channel; or until `given_up`, which must not call the server.
  void wait_for_viewer(const std::function<bool()>& given_up);
  /// Sends queued messages while viewers read them, then closes. Later ones are not sent.
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
    Connection connection;  ///< server's thread only
    Subscriber subscriber;  ///< guarded by the lock
    bool greeted = false;   ///< it knows the channels
  };
  struct KnownChannel {
    Channel channel;
    std::optional<Stamped> last;
  };

  void serve();
  void wait(std::chrono::milliseconds most);
  void accept_all();
  bool make_room();
  void hear(Viewer& viewer, bool is_text, std::string_view message);
  bool pump(Viewer& viewer);
  void greet(Viewer& viewer);
  void say_goodbye(Viewer& viewer, Connection::Clock::time_point since);
  void remove_gone();
  void wake();

  const ServerOptions options_;
  int listener_ = -1, bell_ = -1;
  std::uint16_t port_ = 0;
  bool rests_ = false;  ///< no descriptor for a client
  std::vector<pollfd> polled_;
  std::atomic<bool> rung_ = false, finishing_ = false;

  mutable std::mutex lock_;
  std::condition_variable subscribed_;
  Connection::Clock::time_point changed_{};  ///< last new channel or subscription
  std::vector<KnownChannel> channels_;
  std::vector<std::unique_ptr<Viewer>> viewers_;
  std::uint64_t now_ns_ = 0;
  Counts gone_;  ///< of viewers that left
  std::thread thread_;
};

}  // namespace verp::live
