#include "host/trace/live/server.hpp"

#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

namespace verp::live {
namespace {

using Clock = Connection::Clock;
using std::chrono::milliseconds;

constexpr std::size_t kMostViewers = 16;
constexpr std::size_t kAhead = 64 * 1024;  // bytes queued beyond the socket
constexpr milliseconds kSettled{300};      // after this pause a viewer subscribes no more
constexpr milliseconds kGreeting{10'000};  // for a client's handshake
constexpr std::string_view kFull =
    "HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";

int listen_on(std::uint16_t& port) {
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int yes = 1;
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);  // only this PC may read
  socklen_t size = sizeof(place);
  auto* address = reinterpret_cast<sockaddr*>(&place);
  ::setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  if (listener < 0 || ::bind(listener, address, size) != 0 || ::listen(listener, 16) != 0 ||
      ::getsockname(listener, address, &size) != 0) {
    const std::string why = std::strerror(errno);
    if (listener >= 0) ::close(listener);
    throw LiveError(fmt::format("port {} of 127.0.0.1: {}", port, why));
  }
  port = ntohs(place.sin_port);
  return listener;
}

/// The thread receives no signals.
template <class Function>
std::thread quiet_thread(Function function) {
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(std::move(function));
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace

Server::Server(std::uint16_t port, ServerOptions options)
    : options_(std::move(options)),
      listener_(listen_on(port)),
      bell_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      port_(port) {
  thread_ = quiet_thread([this] { serve(); });
}

Server::~Server() {
  finish();
  ::close(bell_);
  ::close(listener_);
}

std::uint32_t Server::add_channel(Channel channel) {
  const std::lock_guard guard(lock_);
  channel.id = static_cast<std::uint32_t>(channels_.size() + 1);
  const std::string text = advertise({channel});
  channels_.push_back({std::move(channel), {}});
  changed_ = Clock::now();
  for (const auto& viewer : viewers_) {
    if (viewer->greeted) viewer->subscriber.say(text);
  }
  wake();
  return static_cast<std::uint32_t>(channels_.size());
}

std::optional<std::uint32_t> Server::find_channel(std::string_view topic) const {
  const std::lock_guard guard(lock_);
  for (const KnownChannel& each : channels_) {
    if (each.channel.topic == topic) return each.channel.id;
  }
  return {};
}

void Server::send(std::uint32_t channel, std::uint64_t time_ns, std::string_view data) {
  const Stamped message{time_ns, std::make_shared<const std::string>(data)};
  bool news = false;
  {
    const std::lock_guard guard(lock_);
    channels_.at(channel - 1).last = message;
    const bool later = time_ns > now_ns_;
    now_ns_ = std::max(now_ns_, time_ns);
    for (const auto& viewer : viewers_) {
      if (!viewer->greeted) continue;
      if (later) viewer->subscriber.offer_time(time_ns);
      news |= viewer->subscriber.offer(channel, message) || later;
    }
  }
  if (news) wake();
}

bool Server::run_before_others(int priority) {
  const sched_param wanted{.sched_priority = priority};
  return ::pthread_setschedparam(thread_.native_handle(), SCHED_FIFO, &wanted) == 0;
}

void Server::wait_for_viewer(const std::function<bool()>& given_up) {
  std::unique_lock guard(lock_);
  const auto somebody = [this] {
    return std::any_of(viewers_.begin(), viewers_.end(),
                       [](const auto& v) { return v->subscriber.wants_something(); });
  };
  const auto settled = [this] { return Clock::now() - changed_ >= kSettled; };
  while (!(somebody() && settled()) && !given_up()) subscribed_.wait_for(guard, milliseconds(50));
}

Counts Server::counts() const {
  const std::lock_guard guard(lock_);
  Counts counts = gone_;
  for (const auto& viewer : viewers_) {
    counts.viewers += viewer->greeted ? 1 : 0;
    counts.sent += viewer->subscriber.sent();
    counts.dropped += viewer->subscriber.dropped();
  }
  return counts;
}

void Server::finish() {
  finishing_ = true;
  wake();
  if (thread_.joinable()) thread_.join();
}

void Server::wake() {
  const std::uint64_t one = 1;
  if (!rung_.exchange(true)) [[maybe_unused]]
    const ssize_t always = ::write(bell_, &one, sizeof(one));
}

void Server::serve() {
  std::optional<Clock::time_point> finishing;
  bool more = false;
  while (!finishing || !viewers_.empty()) {
    wait(milliseconds(more ? 0 : finishing ? 20 : 1000));
    if (finishing_ && !finishing) finishing = Clock::now();
    if (!finishing && (polled_[1].revents & POLLIN) != 0) accept_all();
    more = false;
    for (const auto& viewer : viewers_) {
      more |= pump(*viewer);
      if (finishing) say_goodbye(*viewer, *finishing);
      if (viewer->connection.stage() != Connection::Stage::kOpen &&
          Clock::now() - viewer->connection.moved() > kGreeting)
        viewer->connection.cut();
    }
    remove_gone();
  }
}

/// Waits for work, then serves ready sockets.
void Server::wait(milliseconds most) {
  polled_.assign({{bell_, POLLIN, 0}, {rests_ ? -1 : listener_, POLLIN, 0}});
  for (const auto& viewer : viewers_)
    polled_.push_back({viewer->connection.socket(), viewer->connection.events(), 0});
  rests_ = false;
  if (::poll(polled_.data(), polled_.size(), static_cast<int>(most.count())) < 0) {
    for (pollfd& each : polled_) each.revents = 0;
  }
  std::uint64_t rings = 0;
  if ((polled_[0].revents & POLLIN) != 0) [[maybe_unused]]
    const ssize_t always = ::read(bell_, &rings, sizeof(rings));
  rung_ = false;
  for (std::size_t i = 2; i < polled_.size(); ++i) {
    if (polled_[i].revents != 0) viewers_[i - 2]->connection.ready(polled_[i].revents);
  }
}

void Server::accept_all() {
  while (true) {
    const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (socket < 0) {
      rests_ = errno == EMFILE || errno == ENFILE || errno == ENOMEM || errno == ENOBUFS;
      if (errno == ECONNABORTED || errno == EINTR) continue;
      return;
    }
    if (viewers_.size() >= kMostViewers && !make_room()) {
      ::send(socket, kFull.data(), kFull.size(), MSG_NOSIGNAL);
      ::close(socket);
      continue;
    }
    const int yes = 1;
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
    const std::lock_guard guard(lock_);
    viewers_.push_back(std::make_unique<Viewer>(*this, socket));
  }
}

/// Ends the viewer that has watched or read nothing for longest. False: all of them watch.
bool Server::make_room() {
  const auto now = Clock::now();
  const std::lock_guard guard(lock_);
  const auto is_idle = [&](const Viewer& viewer) {
    const bool stuck =
        viewer.connection.backlog() > 0 && now - viewer.connection.moved() > options_.patience;
    return viewer.connection.stage() != Connection::Stage::kGone &&
           (stuck || !viewer.subscriber.wants_something());
  };
  Viewer* longest = nullptr;
  for (const auto& viewer : viewers_) {
    if (!is_idle(*viewer)) continue;
    if (longest == nullptr || viewer->connection.moved() < longest->connection.moved())
      longest = viewer.get();
  }
  if (longest == nullptr) return false;
  longest->connection.cut();
  return true;
}

void Server::hear(Viewer& viewer, bool is_text, std::string_view message) {
  const Request request = parse_request(is_text ? message : "");
  const std::lock_guard guard(lock_);
  Subscriber& subscriber = viewer.subscriber;
  const auto refuse = [&](const std::string& why) { subscriber.say(status(Level::kError, why)); };
  if (!request.refused.empty()) refuse(request.refused);
  for (const auto& [id, channel] : request.subscribe) {
    if (channel == 0 || channel > channels_.size()) {
      refuse(fmt::format("subscription {}: there is no channel {}", id, channel));
    } else if (!subscriber.subscribe(id, channel)) {
      refuse(fmt::format("subscription {}, channel {}: subscribed already", id, channel));
    } else {
      changed_ = Clock::now();
      if (const auto& last = channels_[channel - 1].last) subscriber.offer(channel, *last);
    }
  }
  for (const std::uint32_t id : request.unsubscribe) {
    if (!subscriber.unsubscribe(id)) refuse(fmt::format("there is no subscription {}", id));
  }
  subscribed_.notify_all();
}

/// Fills the queue. True: more waits, and the socket would accept it.
bool Server::pump(Viewer& viewer) {
  Connection& connection = viewer.connection;
  if (connection.stage() != Connection::Stage::kOpen) return false;
  if (!viewer.greeted) greet(viewer);
  bool more = true;
  while (more && connection.backlog() < kAhead) {
    std::optional<Frame> frame;
    {
      const std::lock_guard guard(lock_);
      frame = viewer.subscriber.next();
    }
    more = frame && connection.send(frame->is_text, frame->bytes);
  }
  connection.write();
  return more && connection.stage() == Connection::Stage::kOpen && connection.backlog() == 0;
}

void Server::greet(Viewer& viewer) {
  const std::lock_guard guard(lock_);
  std::vector<Channel> channels;
  for (const KnownChannel& each : channels_) channels.push_back(each.channel);
  viewer.subscriber.say(server_info(options_.name));
  viewer.subscriber.say(advertise(channels));
  viewer.greeted = true;
}

void Server::say_goodbye(Viewer& viewer, Clock::time_point since) {
  Connection& connection = viewer.connection;
  if (!viewer.greeted) return connection.cut();
  const auto now = Clock::now();
  const bool stuck = now - std::max(since, connection.moved()) > options_.patience ||
                     now - since > options_.patience_all;
  const std::lock_guard guard(lock_);
  viewer.subscriber.tell_dropped();
  if (viewer.subscriber.is_empty() && connection.backlog() == 0) {
    connection.close(WSLAY_CODE_GOING_AWAY, "the run has ended");
    connection.write();
  }
  if (!stuck) return;
  viewer.subscriber.drop_all();
  connection.cut();
}

void Server::remove_gone() {
  const std::lock_guard guard(lock_);
  std::erase_if(viewers_, [this](const std::unique_ptr<Viewer>& viewer) {
    if (viewer->connection.stage() != Connection::Stage::kGone) return false;
    gone_.viewers += viewer->greeted ? 1 : 0;
    gone_.sent += viewer->subscriber.sent();
    gone_.dropped += viewer->subscriber.dropped();
    return true;
  });
}

}  // namespace verp::live
