#include "host/run/session/live_orders.hpp"

#include <bit>

#include "common/model/tuning_ranges.hpp"

namespace verp::session {
namespace {

constexpr std::uint32_t kOrderTicks = 10;  // well inside command_hold_s

}  // namespace

void LiveOrders::take(const Command& command) {
  command_ = command;
  driving_ = changed_ = true;
}

void LiveOrders::press_emergency_stop(bool pressed) {
  stopped_ = pressed;
}

void LiveOrders::get_up() {
  get_up_ = GetUp(kGetUpTries, true);
  asked_ = changed_ = true;
}

void LiveOrders::let_get_up(bool by_itself) {
  by_itself_ = by_itself;
}

void LiveOrders::observe(safety::Mode mode, double period_s) {
  const GetUp::Phase phase = get_up_.observe(mode, period_s);
  if (phase == GetUp::Phase::kUp) changed_ = std::exchange(asked_, false) || changed_;
  if (phase == GetUp::Phase::kFell) changed_ = true;
  if (phase != GetUp::Phase::kGaveUp) return;
  if (std::exchange(asked_, false) || by_itself_) take({});
}

bool LiveOrders::write(int id, float value) {
  if (!in_range(id, value)) return false;
  for (auto& [waiting, bits] : writes_) {
    if (waiting != id) continue;
    bits = value;
    return true;
  }
  writes_.emplace_back(id, value);
  return true;
}

void LiveOrders::amend(std::uint32_t tick, app::OperatorOrder& order) {
  if (!driving_) {
    sequence_ = order.command.sequence;
  } else {
    const bool fresh = changed_ || tick % kOrderTicks == 0;
    if (fresh) ++sequence_;
    order.command = command_;
    order.command.sequence = sequence_;
    order.flags = fresh ? kCommandFresh : 0;
    changed_ = false;
  }
  if (asked_ || (by_itself_ && get_up_.down())) order.command.request = Request::kGetUp;
  if (stopped_) order.flags |= kEmergencyStop;
  if (writes_.empty()) return;
  order.flags |= kParameterWrite;
  order.parameter_id = static_cast<std::uint16_t>(writes_.front().first);
  order.parameter_bits = std::bit_cast<std::uint32_t>(writes_.front().second);
  writes_.pop_front();
}

}  // namespace verp::session
