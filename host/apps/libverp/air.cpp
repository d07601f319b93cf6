#include "host/apps/libverp/air.hpp"

#include <cstring>
#include <stdexcept>

#include "host/apps/libverp/failure.hpp"
#include "host/apps/libverp/run.hpp"

namespace verp::abi {
namespace {

radio::Conditions conditions_of(const verp_radio& what) {
  radio::Conditions conditions;
  conditions.range_m = what.range_m;
  conditions.loss = what.loss;
  conditions.fade = what.fade;
  conditions.fade_s = what.fade_s;
  conditions.delay_s = what.delay_s;
  conditions.jitter_s = what.jitter_s;
  conditions.bytes_s = what.bytes_s;
  conditions.overhead = what.overhead_bytes;
  conditions.most_bytes = what.most_bytes;
  conditions.most_waiting = what.most_waiting;
  try {
    radio::check(conditions);
  } catch (const std::invalid_argument& wrong) {
    throw Failure(VERP_BAD_ARGUMENT, wrong.what());
  }
  return conditions;
}

}  // namespace

Air::Air(const verp_radio& what) : radio_(conditions_of(what), what.seed) {}

void Air::begin(std::size_t robots) {
  while (radio_.stations() < robots) radio_.add();
  heard_.resize(robots);
}

void Air::ticked(Run& run, std::uint32_t robot) {
  std::vector<radio::Place> places;
  for (std::size_t i = 0; i < run.session.size(); ++i) {
    const sim::Vec3 at = run.session.robot(i).twin().body().link_pose(0).translation();
    places.push_back({at.x(), at.y(), at.z()});
  }
  radio_.advance(run.session.now_us(), places);
  radio_.take_outcomes();  // they would accumulate
  std::deque<radio::ReceivedMessage>& heard = heard_[robot];
  for (radio::ReceivedMessage& each : radio_.take(static_cast<int>(robot))) {
    run.seat(robot).note_radio({.event = "heard",
                                .number = static_cast<std::int32_t>(each.number),
                                .from = each.from,
                                .to = static_cast<std::int32_t>(robot),
                                .data = each.data});
    heard.push_back(std::move(each));
    if (heard.size() > kMostHeard) heard.pop_front();
  }
}

int Air::send(Run& run, std::uint32_t robot, std::int32_t to, std::string data) {
  const auto number = static_cast<std::int32_t>(radio_.sent());
  const radio::Sent sent = radio_.send(static_cast<int>(robot), to, data, run.session.now_us());
  constexpr const char* kEvents[] = {"said", "too long", "too many", "nobody"};
  run.seat(robot).note_radio({.event = kEvents[static_cast<int>(sent)],
                              .number = sent == radio::Sent::kOnItsWay ? number : -1,
                              .from = static_cast<std::int32_t>(robot),
                              .to = to,
                              .data = data});
  if (sent == radio::Sent::kTooMany) return VERP_NOT_SENT;
  if (sent == radio::Sent::kTooLong) {
    throw Failure(VERP_BAD_ARGUMENT, "data is of " + std::to_string(data.size()) +
                                         " bytes: a message has at most " +
                                         std::to_string(radio_.conditions().most_bytes));
  }
  if (sent == radio::Sent::kNobody) {
    throw Failure(VERP_BAD_ARGUMENT,
                  "to is " + std::to_string(to) + ": it is another robot, or VERP_EVERYBODY");
  }
  return VERP_OK;
}

int Air::take(std::uint32_t robot, void* data, std::uint64_t room, std::uint64_t* size,
              std::uint32_t* from) {
  std::deque<radio::ReceivedMessage>& heard = heard_[robot];
  *size = 0;
  if (heard.empty()) return VERP_NO_MESSAGE;
  const radio::ReceivedMessage& next = heard.front();
  *size = next.data.size();
  if (room < next.data.size()) {
    throw Failure(VERP_BAD_ARGUMENT, "data has room for " + std::to_string(room) + " bytes, not " +
                                         std::to_string(next.data.size()));
  }
  std::memcpy(data, next.data.data(), next.data.size());
  if (from != nullptr) *from = static_cast<std::uint32_t>(next.from);
  heard.pop_front();
  return VERP_OK;
}

}  // namespace verp::abi
