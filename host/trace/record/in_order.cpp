#include "host/trace/record/in_order.hpp"

#include <algorithm>
#include <tuple>

#include "host/trace/record/trace_error.hpp"

namespace verp::record {
namespace {

constexpr std::size_t kMostWaiting = std::size_t{512} << 20;

}  // namespace

bool InOrder::Waiting::operator<(const Waiting& other) const {
  const auto place = [](const Waiting& each) {
    const mcap::Message& message = each.next.message;
    return std::tuple(message.time_ns, each.next.source, message.part, each.number);
  };
  return place(other) < place(*this);
}

InOrder::InOrder(std::vector<Source> sources) : sources_(std::move(sources)) {
  for (std::size_t source = 0; source < sources_.size(); ++source) {
    std::optional<std::uint64_t> part;
    sources_[source].reader->read([&](const mcap::File&, const mcap::Message& message) {
      if (part != message.part) parts_.push_back({message.time_ns, message.part, source});
      part = message.part;
      parts_.back().first_ns = std::min(parts_.back().first_ns, message.time_ns);
    });
  }
  std::stable_sort(parts_.begin(), parts_.end(),
                   [](const Part& a, const Part& b) { return a.first_ns < b.first_ns; });
}

void InOrder::load(const Part& part) {
  auto bytes = std::make_shared<std::string>();
  std::vector<std::pair<mcap::Message, std::size_t>> messages;  // with their place in bytes
  sources_[part.source].reader->read_part(part.offset,
                                          [&](const mcap::File&, const mcap::Message& message) {
                                            messages.emplace_back(message, bytes->size());
                                            bytes->append(message.data);
                                          });
  for (std::size_t i = 0; i < messages.size(); ++i) {
    auto& [message, at] = messages[i];
    held_bytes_ += sizeof(Waiting) + message.data.size();
    message.data = std::string_view(*bytes).substr(at, message.data.size());
    waiting_.push({{part.source, message}, i, bytes});
  }
  if (held_bytes_ <= kMostWaiting) return;
  throw TraceError(
      sources_[part.source].path, part.offset,
      "chunks that overlap in time by more than " + std::to_string(kMostWaiting) + " bytes",
      "record the run again");
}

std::optional<InOrder::Next> InOrder::next() {
  while (loaded_ < parts_.size() &&
         (waiting_.empty() || parts_[loaded_].first_ns <= waiting_.top().next.message.time_ns)) {
    load(parts_[loaded_++]);
  }
  if (waiting_.empty()) return std::nullopt;
  const Next next = waiting_.top().next;
  held_bytes_ -= sizeof(Waiting) + next.message.data.size();
  given_ = waiting_.top().bytes;
  waiting_.pop();
  return next;
}

}  // namespace verp::record
