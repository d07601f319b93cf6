#include "host/twin/bus/operator_port.hpp"

#include <utility>

#include "firmware/app/register_image.hpp"
#include "host/os/link/endpoint.hpp"
#include "host/twin/bus/order_packets.hpp"

namespace verp::bus {
namespace {

using app::reg;

constexpr std::uint32_t kPatience_us = 500'000;  // per answer, wall clock
constexpr std::uint32_t kSlice_us = 50'000;
constexpr std::uint32_t kLinger_us = 20'000;
constexpr int kAttempts = 6;

}  // namespace

OperatorPort::OperatorPort(const std::string& endpoint, std::function<bool()> give_up)
    : text_(endpoint), give_up_(std::move(give_up)), link_(link::parse_endpoint(endpoint)) {}

void OperatorPort::add_write(std::uint16_t address, const std::vector<std::uint8_t>& data) {
  append_write(outbox_, address, data);
  ++asked_;
}

void OperatorPort::add_read(std::uint16_t address, std::uint16_t length) {
  std::uint8_t packet[32];
  const std::size_t size = dxl::encode_read(packet, sizeof packet, kId, address, length);
  outbox_.insert(outbox_.end(), packet, packet + size);
  ++asked_;
}

void OperatorPort::add_order(const app::OperatorOrder& order) {
  asked_ += append_order(outbox_, order);
}

ControllerReport OperatorPort::exchange(const app::OperatorOrder* order) {
  if (order != nullptr) add_order(*order);
  const ControllerReport report = ask_report();
  if (order == nullptr || !refused_) return report;
  // A started controller obeys only an operator that first asked it to relax; a twin endangers
  // nobody.
  app::OperatorOrder again = *order;
  again.flags &= static_cast<std::uint16_t>(~kParameterWrite);  // already written and accepted
  add_write(reg("request"), {static_cast<std::uint8_t>(Request::kRelax)});
  add_order(again);
  return ask_report();
}

ControllerReport OperatorPort::ask_report() {
  constexpr std::uint16_t kFirst = reg("digest");
  constexpr std::uint16_t kSpan = app::reg_end("tick") - kFirst;
  add_read(kFirst, kSpan);
  const std::vector<std::uint8_t> data = ask();
  if (data.size() != kSpan) {
    throw SinkError(text_ + ": device 200 is not a controller of this program; check --operator");
  }
  return {.tick = dxl::get_u32(data.data() + reg("tick") - kFirst),
          .digest = dxl::get_u32(data.data()) | std::uint64_t{dxl::get_u32(data.data() + 4)} << 32};
}

int OperatorPort::action_count() {
  add_read(reg("action_count"), 2);
  const std::vector<std::uint8_t> data = ask();
  return data.size() == 2 ? dxl::get_u16(data.data()) : 0;
}

std::uint32_t OperatorPort::params_crc() {
  add_read(reg("model_information"), 4);
  const std::vector<std::uint8_t> data = ask();
  return data.size() == 4 ? dxl::get_u32(data.data()) : 0;
}

std::vector<std::uint8_t> OperatorPort::ask() {
  std::vector<std::uint8_t> data;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    link_.write(outbox_.data(), outbox_.size(), kPatience_us);
    if (collect(data)) {
      // A repeated request must not act later, so take its late answer now.
      std::uint8_t late[256];
      while (attempt > 0 && link_.read(late, sizeof late, kLinger_us) > 0) {
      }
      outbox_.clear();
      asked_ = 0;
      return data;
    }
    if (give_up_()) break;
  }
  throw SinkError(text_ +
                  ": the controller does not answer there as device 200; check --operator and its "
                  "wiring, or leave it out");
}

bool OperatorPort::collect(std::vector<std::uint8_t>& data) {
  dxl::Parser parser;
  std::uint8_t piece[256];
  std::size_t answers = 0;
  refused_ = false;
  for (std::uint32_t waited_us = 0; waited_us < kPatience_us && !give_up_();) {
    const std::size_t count = link_.read(piece, sizeof piece, kSlice_us);
    if (count == 0) waited_us += kSlice_us;
    for (std::size_t i = 0; i < count; ++i) {
      for (bool found = parser.push(piece[i]); found; found = parser.next()) {
        const dxl::Packet& packet = parser.packet();
        if (!packet.is_status() || packet.id != kId) continue;
        const auto error = static_cast<dxl::Error>(packet.error & ~dxl::kAlert);
        const bool not_now = answers == 0 && error == dxl::Error::kResultFail;
        refused_ = refused_ || not_now;
        if (error != dxl::Error::kNone && !not_now) {
          throw SinkError(text_ + ": the controller refuses an order (error " +
                          std::to_string(packet.error & ~dxl::kAlert) +
                          "); it may be of another version: rebuild its firmware");
        }
        data.assign(packet.parameters, packet.parameters + packet.size);
        if (++answers == asked_) return true;
      }
    }
  }
  return false;
}

}  // namespace verp::bus
