#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace verp::live {

/// A message as every viewer that wants it shares it.
struct Stamped {
  std::uint64_t time_ns = 0;
  std::shared_ptr<const std::string> data;
};

struct Frame {
  bool is_text = false;
  std::string bytes;
};

/// One viewer: what it wants, and what waits for it. That has a bound: who takes messages more
/// slowly than they come loses the oldest, so that it sees the present, and is told how many.
class Subscriber {
 public:
  explicit Subscriber(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// False: that subscription, or one to that channel, is there already.
  bool subscribe(std::uint32_t subscription, std::uint32_t channel);
  /// Drops what waits for it. False: there is none of that number.
  bool unsubscribe(std::uint32_t subscription);
  bool wants_something() const { return !channels_.empty(); }

  /// Texts of the protocol. They come first, and none is lost.
  void say(std::string text) { texts_.push_back(std::move(text)); }
  /// Whether it wants that.
  bool offer(std::uint32_t channel, const Stamped& message);
  void offer_time(std::uint64_t time_ns);

  /// The next to be sent.
  std::optional<Frame> next();
  bool is_empty() const { return texts_.empty() && waiting_.empty(); }
  /// Tells it how many it lost, if it was not told yet.
  void tell_dropped();

  std::uint64_t sent() const { return sent_; }
  std::uint64_t dropped() const { return dropped_; }
  /// What waits is lost, too.
  void drop_all();

 private:
  struct Waiting {
    std::optional<std::uint32_t> subscription;  ///< none: the time
    Stamped message;
  };
  static std::size_t cost(const Waiting& waiting);
  void put(Waiting waiting);
  void pop();

  std::size_t most_bytes_, bytes_ = 0;
  std::map<std::uint32_t, std::uint32_t> channels_;  ///< channel -> subscription
  std::deque<std::string> texts_;
  std::deque<Waiting> waiting_;
  std::uint64_t sent_ = 0, dropped_ = 0, told_ = 0;
};

}  // namespace verp::live
