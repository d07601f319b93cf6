#pragma once
#include <wslay/wslay.h>

#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace verp::live {

/// A WebSocket over one socket, which it owns; the server's end. Never waits: who polls socket()
/// for events() calls ready(). wslay does the frames, this the greeting and the bytes.
class Connection {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Stage { kGreeting, kRefused, kOpen, kGone };
  /// A whole message; binary ones as well.
  using Heard = std::function<void(bool is_text, std::string_view message)>;

  /// `origins`: of pages that are welcome besides; they outlive it.
  Connection(int socket, Heard heard, std::span<const std::string> origins = {});
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  Stage stage() const { return stage_; }
  int socket() const { return socket_; }
  short events() const;
  void ready(short events);

  /// Queues a message; write() has the socket take what it can. False: it is about to close.
  bool send(bool is_text, std::string_view message);
  void write();
  /// Bytes that the socket has not taken yet, and some for each message.
  std::size_t backlog() const;
  /// Queues the last frame, once: nothing more is sent. What waits would be lost: have backlog()
  /// empty.
  void close(std::uint16_t code, std::string_view reason);
  void cut() { stage_ = Stage::kGone; }

  /// When it came, or last took something.
  Clock::time_point moved() const { return moved_; }

 private:
  struct FreeContext {
    void operator()(wslay_event_context_ptr context) const { ::wslay_event_context_free(context); }
  };
  void greet();
  void open();
  void read_frames();
  ssize_t receive(std::uint8_t* to, std::size_t size);  ///< as recv(); 0: the other end is gone
  ssize_t take(const std::uint8_t* from, std::size_t size);
  void look_for_end();

  int socket_;
  Heard heard_;
  std::span<const std::string> origins_;
  Stage stage_ = Stage::kGreeting;
  std::string in_, out_;  ///< of the greeting; afterwards, in_ is what came with it
  std::unique_ptr<wslay_event_context, FreeContext> frames_;
  std::size_t budget_ = 0;  ///< bytes that may be read now: others want to be heard as well
  bool closing_ = false;
  Clock::time_point moved_ = Clock::now();
};

}  // namespace verp::live
