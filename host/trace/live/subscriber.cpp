#include "host/trace/live/subscriber.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/trace/live/protocol.hpp"

namespace verp::live {

bool Subscriber::subscribe(std::uint32_t subscription, std::uint32_t channel) {
  const bool used = std::any_of(channels_.begin(), channels_.end(),
                                [&](const auto& each) { return each.second == subscription; });
  return !used && channels_.try_emplace(channel, subscription).second;
}

bool Subscriber::unsubscribe(std::uint32_t subscription) {
  const bool was =
      std::erase_if(channels_, [&](const auto& each) { return each.second == subscription; }) > 0;
  std::erase_if(waiting_, [&](const Waiting& each) {
    const bool its = each.subscription == subscription;
    if (its) bytes_ -= cost(each);
    return its;
  });
  return was;
}

std::size_t Subscriber::cost(const Waiting& waiting) {
  return sizeof(Waiting) + (waiting.message.data == nullptr ? 0 : waiting.message.data->size());
}

bool Subscriber::offer(std::uint32_t channel, const Stamped& message) {
  const auto wanted = channels_.find(channel);
  if (wanted == channels_.end()) return false;
  put({wanted->second, message});
  return true;
}

void Subscriber::offer_time(std::uint64_t time_ns) {
  put({{}, {time_ns, nullptr}});
}

void Subscriber::put(Waiting waiting) {
  bytes_ += cost(waiting);
  waiting_.push_back(std::move(waiting));
  while (bytes_ > most_bytes_) pop();
  // The first loss at once, then each doubling.
  if (dropped_ > 0 && dropped_ >= 2 * told_) tell_dropped();
}

void Subscriber::pop() {
  if (waiting_.front().subscription) ++dropped_;
  bytes_ -= cost(waiting_.front());
  waiting_.pop_front();
}

void Subscriber::drop_all() {
  while (!waiting_.empty()) pop();
}

void Subscriber::tell_dropped() {
  if (told_ == dropped_) return;
  told_ = dropped_;
  say(status(Level::kWarning,
             fmt::format("{} messages left out: this viewer takes them more slowly than they come",
                         dropped_),
             "dropped"));
}

std::optional<Frame> Subscriber::next() {
  if (!texts_.empty()) {
    Frame frame{true, std::move(texts_.front())};
    texts_.pop_front();
    return frame;
  }
  if (waiting_.empty()) return {};
  const Waiting& first = waiting_.front();
  const Stamped& message = first.message;
  Frame frame{false, first.subscription
                         ? message_data(*first.subscription, message.time_ns, *message.data)
                         : time(message.time_ns)};
  if (first.subscription) ++sent_;
  bytes_ -= cost(first);
  waiting_.pop_front();
  return frame;
}

}  // namespace verp::live
