#include "host/trace/live/connection.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "host/trace/live/handshake.hpp"

namespace verp::live {
namespace {

constexpr std::size_t kMostHead = 8192;
constexpr std::uint64_t kMostMessage = 64 * 1024;  // a viewer's subscription list
// A viewer that reads nothing is not read either, because answers to it would pile up.
constexpr std::size_t kMostUntaken = 64 * 1024;
constexpr std::size_t kAtOnce = 64 * 1024;  // before others have their turn
constexpr std::size_t kMessage = 64;        // wslay's overhead per queued message

bool would_block() {
  return errno == EAGAIN || errno == EWOULDBLOCK;
}

}  // namespace

Connection::Connection(int socket, OnMessage on_message, std::span<const std::string> origins)
    : socket_(socket), on_message_(std::move(on_message)), origins_(origins) {}

Connection::~Connection() {
  ::close(socket_);
}

short Connection::events() const {
  int events = 0;
  if (stage_ == Stage::kOpen) {
    if (::wslay_event_want_read(frames_.get()) != 0 && backlog() < kMostUntaken) events |= POLLIN;
    if (::wslay_event_want_write(frames_.get()) != 0) events |= POLLOUT;
  } else {
    events = POLLIN;
  }
  if (!out_.empty()) events |= POLLOUT;
  return static_cast<short>(events);
}

void Connection::ready(short events) {
  if ((events & (POLLERR | POLLNVAL)) != 0) return cut();
  budget_ = kAtOnce;
  if ((events & (POLLIN | POLLHUP)) != 0) stage_ == Stage::kOpen ? read_frames() : greet();
  if (stage_ != Stage::kGone) write();
}

void Connection::greet() {
  std::array<std::uint8_t, 2048> bytes{};
  const ssize_t count = receive(bytes.data(), bytes.size());
  if (count < 0 && would_block()) return;
  if (count <= 0) return cut();
  if (stage_ == Stage::kRefused) return;  // ignores all further input
  in_.append(reinterpret_cast<const char*>(bytes.data()), static_cast<std::size_t>(count));
  const std::size_t length = std::min(head_length(in_), in_.size());
  if (length == in_.size() && head_length(in_) == in_.npos && length < kMostHead) return;
  HandshakeAnswer answer = answer_handshake(std::string_view(in_).substr(0, length), origins_);
  in_.erase(0, length);
  out_ = std::move(answer.text);
  stage_ = Stage::kRefused;
  if (answer.accepted) open();
}

void Connection::open() {
  wslay_event_callbacks calls{};
  calls.recv_callback = [](wslay_event_context_ptr context, std::uint8_t* to, std::size_t size, int,
                           void* self) -> ssize_t {
    const ssize_t count = static_cast<Connection*>(self)->receive(to, size);
    if (count > 0) return count;
    const bool later = count < 0 && would_block();
    ::wslay_event_set_error(context, later ? WSLAY_ERR_WOULDBLOCK : WSLAY_ERR_CALLBACK_FAILURE);
    return -1;
  };
  calls.send_callback = [](wslay_event_context_ptr context, const std::uint8_t* from,
                           std::size_t size, int, void* self) -> ssize_t {
    const ssize_t count = static_cast<Connection*>(self)->take(from, size);
    if (count >= 0) return count;
    ::wslay_event_set_error(context,
                            would_block() ? WSLAY_ERR_WOULDBLOCK : WSLAY_ERR_CALLBACK_FAILURE);
    return -1;
  };
  calls.on_msg_recv_callback = [](wslay_event_context_ptr, const wslay_event_on_msg_recv_arg* what,
                                  void* self) {
    if (wslay_is_ctrl_frame(what->opcode)) return;  // wslay answers these itself
    static_cast<Connection*>(self)->on_message_(
        what->opcode == WSLAY_TEXT_FRAME,
        {reinterpret_cast<const char*>(what->msg), what->msg_length});
  };
  wslay_event_context_ptr context = nullptr;
  if (::wslay_event_context_server_init(&context, &calls, this) != 0) return cut();
  frames_.reset(context);
  ::wslay_event_config_set_max_recv_msg_length(context, kMostMessage);
  stage_ = Stage::kOpen;
  if (!in_.empty()) read_frames();
}

void Connection::read_frames() {
  if (::wslay_event_recv(frames_.get()) != 0) return cut();
  look_for_end();
}

void Connection::write() {
  while (!out_.empty()) {
    const ssize_t count = take(reinterpret_cast<const std::uint8_t*>(out_.data()), out_.size());
    if (count < 0) return would_block() ? void() : cut();
    out_.erase(0, static_cast<std::size_t>(count));
    if (out_.empty() && stage_ == Stage::kRefused) ::shutdown(socket_, SHUT_WR);
  }
  if (stage_ != Stage::kOpen) return;
  if (::wslay_event_send(frames_.get()) != 0) return cut();
  look_for_end();
}

/// Ends the connection if both sides have closed it, or wslay gave up.
void Connection::look_for_end() {
  if (::wslay_event_want_read(frames_.get()) == 0 && ::wslay_event_want_write(frames_.get()) == 0)
    cut();
}

bool Connection::send(bool is_text, std::string_view message) {
  if (stage_ != Stage::kOpen || closing_) return false;
  const wslay_event_msg frame{
      .opcode = static_cast<std::uint8_t>(is_text ? WSLAY_TEXT_FRAME : WSLAY_BINARY_FRAME),
      .msg = reinterpret_cast<const std::uint8_t*>(message.data()),
      .msg_length = message.size()};
  return ::wslay_event_queue_msg(frames_.get(), &frame) == 0;
}

std::size_t Connection::backlog() const {
  if (stage_ != Stage::kOpen) return out_.size();
  return out_.size() + ::wslay_event_get_queued_msg_length(frames_.get()) +
         kMessage * ::wslay_event_get_queued_msg_count(frames_.get());
}

void Connection::close(std::uint16_t code, std::string_view reason) {
  if (stage_ != Stage::kOpen || closing_) return;
  closing_ = true;
  ::wslay_event_queue_close(frames_.get(), code,
                            reinterpret_cast<const std::uint8_t*>(reason.data()), reason.size());
}

ssize_t Connection::receive(std::uint8_t* to, std::size_t size) {
  if (stage_ == Stage::kOpen && !in_.empty()) {
    const std::size_t count = std::min(size, in_.size());
    std::memcpy(to, in_.data(), count);
    in_.erase(0, count);
    return static_cast<ssize_t>(count);
  }
  ssize_t count = -1;
  errno = EAGAIN;
  if (budget_ == 0) return count;
  do {
    count = ::recv(socket_, to, std::min(size, budget_), 0);
  } while (count < 0 && errno == EINTR);
  if (count > 0) budget_ -= static_cast<std::size_t>(count);
  return count;
}

ssize_t Connection::take(const std::uint8_t* from, std::size_t size) {
  ssize_t count = 0;
  do {
    count = ::send(socket_, from, size, MSG_NOSIGNAL);
  } while (count < 0 && errno == EINTR);
  if (count > 0) moved_ = Clock::now();
  return count;
}

}  // namespace verp::live
