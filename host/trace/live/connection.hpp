#pragma once
#include <wslay/wslay.h>

#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace verp::live {

/// The server's end of a WebSocket; it owns the socket. Never blocks: the owner polls socket() for
/// events() and calls ready().
class Connection {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Stage { kGreeting, kRefused, kOpen, kGone };
  using OnMessage = std::function<void(bool is_text, std::string_view message)>;

  /// `origins`: further allowed ones; they must outlive the connection.
  Connection(int socket, OnMessage on_message, std::span<const std::string> origins = {});
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  Stage stage() const { return stage_; }
  int socket() const { return socket_; }
  short events() const;
  void ready(short events);

  /// write() sends it as the socket accepts it. False: the connection is closing.
  bool send(bool is_text, std::string_view message);
  void write();
  /// Unsent bytes, with an overhead per message.
  std::size_t backlog() const;
  /// Queues the close frame, once. Wait until backlog() is 0, or queued messages are lost.
  void close(std::uint16_t code, std::string_view reason);
  void cut() { stage_ = Stage::kGone; }

  /// When it connected, or the socket last accepted bytes.
  Clock::time_point moved() const { return moved_; }

 private:
  struct FreeContext {
    void operator()(wslay_event_context_ptr context) const { ::wslay_event_context_free(context); }
  };
  void greet();
  void open();
  void read_frames();
  ssize_t receive(std::uint8_t* to, std::size_t size);  ///< 0: the peer has closed
  ssize_t take(const std::uint8_t* from, std::size_t size);
  void look_for_end();

  int socket_;
  OnMessage on_message_;
  std::span<const std::string> origins_;
  Stage stage_ = Stage::kGreeting;
  std::string in_, out_;  ///< handshake; once open, in_ holds later bytes
  std::unique_ptr<wslay_event_context, FreeContext> frames_;
  std::size_t budget_ = 0;  ///< left to read in this turn
  bool closing_ = false;
  Clock::time_point moved_ = Clock::now();
};

}  // namespace verp::live
