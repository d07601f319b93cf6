#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace verp::live {

struct Stamped {
  std::uint64_t time_ns = 0;
  std::shared_ptr<const std::string> data;
};

struct Frame {
  bool is_text = false;
  std::string bytes;
};

/// A viewer's subscriptions and bounded queue. A slow viewer loses the oldest messages and gets
/// their number.
class Subscriber {
 public:
  explicit Subscriber(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  /// False: the subscription, or one to that channel, exists.
  bool subscribe(std::uint32_t subscription, std::uint32_t channel);
  /// Drops its queued messages; false: no such subscription.
  bool unsubscribe(std::uint32_t subscription);
  bool wants_something() const { return !channels_.empty(); }

  /// Protocol texts go first and are never dropped.
  void say(std::string text) { texts_.push_back(std::move(text)); }
  /// Queues a message if the viewer has subscribed to its channel; returns whether it has.
  bool offer(std::uint32_t channel, const Stamped& message);
  void offer_time(std::uint64_t time_ns);

  std::optional<Frame> next();
  bool is_empty() const { return texts_.empty() && waiting_.empty(); }
  /// Reports the number of lost messages, unless it was reported already.
  void tell_dropped();

  std::uint64_t sent() const { return sent_; }
  std::uint64_t dropped() const { return dropped_; }
  /// Counts the queued messages as lost, too.
  void drop_all();

 private:
  struct Waiting {
    std::optional<std::uint32_t> subscription;  ///< nullopt: a time message
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
