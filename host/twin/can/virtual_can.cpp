#include "host/twin/can/virtual_can.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/frame.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "host/twin/can/device_node.hpp"

namespace verp::can {
namespace {

std::unique_ptr<Node> make_drive(const Params& params, int joint, sim::Plant& plant) {
  const JointParams& at = params.joint[joint];
  const ServoProfile& profile = params.servo[at.servo_profile % kServoProfiles];
  const DriveSetup setup{.counts_per_rad = std::abs(double{at.counts_per_rad}),
                         .p_gain = profile.position_p_gain,
                         .i_gain = profile.position_i_gain,
                         .d_gain = profile.position_d_gain};
  return std::make_unique<DriveNode>(drive_identity(profile.model_number, at.servo_id), at.servo_id,
                                     plant, joint, setup);
}

}  // namespace

VirtualCan::VirtualCan(const Params& params, sim::Plant& plant)
    : plant_(plant),
      period_ns_(std::uint64_t{params.period_us} * 1000),
      rates_{params.baud, params.baud} {
  for (int j = 0; j < params.servo_count(); ++j) plug_in(make_drive(params, j, plant));
  if (const std::uint8_t id = params.imu.device_id; id != 0) {
    plug_in(std::make_unique<ImuNode>(imu_identity(id), id, plant));
  }
  for (int foot = 0; foot < kFeet; ++foot) {
    const std::uint8_t id = params.feet.device_id[foot];
    if (id == 0) continue;
    plug_in(std::make_unique<FootNode>(foot_identity(id), id, plant, foot));
  }
}

void VirtualCan::plug_in(std::unique_ptr<Node> node) {
  places_.push_back({.node = std::move(node), .out = {}});
}

VirtualCan::Place* VirtualCan::place_of(std::uint8_t id) {
  const auto found = std::find_if(places_.begin(), places_.end(),
                                  [=](const Place& place) { return place.node->id() == id; });
  return found == places_.end() ? nullptr : &*found;
}

void VirtualCan::set_connected(std::uint8_t id, bool connected) {
  Place* place = place_of(id);
  if (place == nullptr) return;
  place->connected = connected;
  place->out.clear();
}

void VirtualCan::set_powered(std::uint8_t id, bool powered) {
  Place* place = place_of(id);
  if (place == nullptr || place->powered == powered) return;
  place->powered = powered;
  place->out.clear();
  powered ? place->node->power_on() : place->node->power_off();
}

void VirtualCan::leave_bus() {
  constexpr std::uint64_t kRecoveryBits = 128 * 11;  // ISO 11898-1, recessive
  ++errors_.bus_offs;
  errors_.dropped += static_cast<std::uint32_t>(out_.size());
  out_.clear();
  last_waits_ = false;
  off_until_ns_ = now_ns_ + canopen::wire_time_ns({kRecoveryBits, 0}, rates_);
}

bool VirtualCan::begins_tick(const CanFrame& frame) {
  return canopen::is_canopen(frame) && frame.id == canopen::kSyncId && frame.size == 1 &&
         frame.data[0] == 1;
}

bool VirtualCan::send(const CanFrame& frame) {
  if (!is_sound(frame) || frame.fd || out_.size() >= hal::kCanQueue) return false;
  if (now_ns_ < off_until_ns_) return false;
  if (!real_time_ && begins_tick(frame)) begin_tick();
  for (Waiting& each : out_) each.last = false;
  out_.push_back({frame, now_ns_, true});
  last_waits_ = true;
  return true;
}

void VirtualCan::begin_tick() {
  while (!out_.empty()) step(kNever_ns);
  const std::uint64_t ready_ns = std::max(now_ns_, wire_free_ns_);
  std::uint64_t start_ns = (ready_ns + period_ns_ - 1) / period_ns_ * period_ns_;
  if (ticking_) start_ns = std::max(start_ns, tick_start_ns_ + period_ns_);
  if (!ticking_) first_tick_ns_ = start_ns;
  ticking_ = true;
  tick_start_ns_ = start_ns;
  tick_ = static_cast<std::uint32_t>((start_ns - first_tick_ns_) / period_ns_);
  while (step(start_ns - 1)) {
  }
  now_ns_ = std::max(now_ns_, start_ns);
}

bool VirtualCan::poll(CanFrame& frame, std::uint32_t timeout_us) {
  if (arrived_.empty()) {
    while (last_waits_ && arrived_.empty()) step(kNever_ns);
    const std::uint64_t deadline_ns =
        last_waits_ ? kNever_ns
                    : std::max(now_ns_, last_begin_ns_ + std::uint64_t{timeout_us} * 1000);
    while (arrived_.empty() && step(deadline_ns)) {
    }
    if (arrived_.empty() || arrived_.front().end_ns > deadline_ns) {
      now_ns_ = deadline_ns;
      return false;
    }
    while (!real_time_ && arrived_.size() < kRoom && next_begin_ns() == wire_free_ns_) {
      step(wire_free_ns_);
    }
  }
  if (!real_time_) now_ns_ = std::max(now_ns_, arrived_.back().end_ns);
  return take(kNever_ns, frame);
}

bool VirtualCan::bring_until(std::uint64_t time_us, CanFrame& frame) {
  if (take(std::max(now_ns_, time_us * 1000), frame)) return true;
  reach(now_ns_);
  return false;
}

void VirtualCan::go_on_until(std::uint64_t time_us) {
  const std::uint64_t time_ns = time_us * 1000;
  while (step(time_ns)) {
  }
  now_ns_ = std::max(now_ns_, time_ns);
  reach(now_ns_);
}

bool VirtualCan::take(std::uint64_t deadline_ns, CanFrame& frame) {
  while (arrived_.empty() && step(deadline_ns)) {
  }
  if (arrived_.empty() || arrived_.front().end_ns > deadline_ns) {
    now_ns_ = deadline_ns;
    return false;
  }
  frame = arrived_.front().frame;
  now_ns_ = std::max(now_ns_, arrived_.front().end_ns);
  arrived_.pop_front();
  return true;
}

std::uint64_t VirtualCan::next_begin_ns() const {
  std::uint64_t first_ns = kNever_ns;
  for (const Waiting& each : out_) first_ns = std::min(first_ns, each.ready_ns);
  for (const Place& place : places_) {
    for (const Waiting& each : place.out) first_ns = std::min(first_ns, each.ready_ns);
  }
  return first_ns == kNever_ns ? kNever_ns : std::max(first_ns, wire_free_ns_);
}

bool VirtualCan::step(std::uint64_t limit_ns) {
  const std::uint64_t begin_ns = next_begin_ns();
  if (std::min(begin_ns, next_work_ns_) > limit_ns) return false;
  if (next_work_ns_ <= begin_ns) {
    work(next_work_ns_);
    next_work_ns_ += kWork_ns;
  } else {
    transmit(begin_ns);
  }
  return true;
}

// A frame on the wire at the end of a poll may have taken the plant past this time.
void VirtualCan::reach(std::uint64_t time_ns) {
  if (time_ns / 1000 > plant_.now_us()) plant_.advance_to(time_ns / 1000);
}

void VirtualCan::work(std::uint64_t time_ns) {
  reach(time_ns);
  for (Place& place : places_) {
    if (!place.powered) continue;
    place.node->work(time_ns / 1000);
    collect(place, time_ns);
  }
  passed(time_ns);
}

void VirtualCan::collect(Place& place, std::uint64_t time_ns) {
  CanFrame frame;
  while (place.node->say(frame, time_ns / 1000)) {
    if (place.connected) place.out.push_back({frame, time_ns});
  }
}

VirtualCan::Place* VirtualCan::arbitrate(std::uint64_t begin_ns, Waiting& winner) {
  std::deque<Waiting>* queue = nullptr;
  Place* sender = nullptr;
  std::size_t place_in_queue = 0;
  // In real time the controller's frames keep the order of their real wire.
  const auto compete = [&](std::deque<Waiting>& out, Place* who) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (out[i].ready_ns > begin_ns) continue;
      if (i > 0 && who == nullptr && real_time_) break;
      if (queue != nullptr && can_rank(out[i].frame) >= can_rank((*queue)[place_in_queue].frame))
        continue;
      queue = &out;
      sender = who;
      place_in_queue = i;
    }
  };
  compete(out_, nullptr);
  for (Place& place : places_) compete(place.out, &place);
  winner = (*queue)[place_in_queue];
  queue->erase(queue->begin() + static_cast<std::ptrdiff_t>(place_in_queue));
  return sender;
}

void VirtualCan::transmit(std::uint64_t begin_ns) {
  Waiting sent;
  const Place* sender = arbitrate(begin_ns, sent);
  if (sent.last) {
    last_waits_ = false;
    last_begin_ns_ = begin_ns;
  }
  if (sender == nullptr) now_ns_ = std::max(now_ns_, begin_ns);
  const canopen::FrameBits bits = canopen::exact_bits(sent.frame);
  bits_on_wire_ += bits.all();
  bare_bits_on_wire_ += canopen::frame_bits(sent.frame, canopen::Stuffing::kNone).all();
  ++frames_on_wire_;
  wire_free_ns_ = begin_ns + canopen::wire_time_ns(bits, rates_);
  const canopen::FrameBits pause{canopen::kIntermissionBits, 0};
  const std::uint64_t end_ns = wire_free_ns_ - canopen::wire_time_ns(pause, rates_);
  for (; next_work_ns_ <= end_ns; next_work_ns_ += kWork_ns) work(next_work_ns_);
  deliver(sent.frame, sender, end_ns);
  if (listener_) listener_(sent.frame, begin_ns, end_ns);
}

void VirtualCan::deliver(const CanFrame& frame, const Place* sender, std::uint64_t end_ns) {
  reach(end_ns);
  for (Place& place : places_) {
    if (&place == sender || !place.powered || !place.connected) continue;
    if (passes(frame, place.node->id())) tell(place, frame, end_ns);
  }
  if (sender != nullptr && end_ns >= off_until_ns_ && passes(frame, 0)) arrive(frame, end_ns);
  passed(end_ns);
}

void VirtualCan::tell(Place& place, const CanFrame& frame, std::uint64_t end_ns) {
  place.node->hear(frame, end_ns / 1000);
  collect(place, end_ns);
}

void VirtualCan::arrive(const CanFrame& frame, std::uint64_t end_ns) {
  if (arrived_.size() >= kRoom) {
    ++errors_.overruns;
    return;
  }
  arrived_.push_back({frame, end_ns});
}

void VirtualCan::passed(std::uint64_t time_ns) {
  heard_ns_ = std::max(heard_ns_, time_ns);
  if (interference_ != nullptr) interference_->passed(time_ns / 1000);
}

void VirtualCan::bring(const CanFrame& frame, std::uint8_t receiver) {
  if (receiver == 0) return arrive(frame, heard_ns_);
  Place* place = place_of(receiver);
  if (place != nullptr && place->powered && place->connected) tell(*place, frame, heard_ns_);
}

void VirtualCan::crossed(const CanFrame& frame, std::uint64_t end_ns) {
  work_until(end_ns);
  deliver(frame, nullptr, end_ns);
  if (listener_) listener_(frame, end_ns, end_ns);
}

void VirtualCan::work_until(std::uint64_t time_ns) {
  for (; next_work_ns_ <= time_ns; next_work_ns_ += kWork_ns) work(next_work_ns_);
  reach(time_ns);
  now_ns_ = std::max(now_ns_, time_ns);
}

bool VirtualCan::take_said(CanFrame& frame) {
  for (Place& place : places_) {
    if (place.out.empty()) continue;
    frame = place.out.front().frame;
    place.out.pop_front();
    return true;
  }
  return false;
}

}  // namespace verp::can
