#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/sdo.hpp"
#include "host/os/link/can_port.hpp"

namespace verp::test {

/// Answers reads of four-byte objects, reports others as missing, and falls silent after `answers`
/// answers.
class ScriptedNode {
 public:
  using Tells = std::function<std::optional<std::uint32_t>(canopen::Address)>;
  static constexpr unsigned kForEver = std::numeric_limits<unsigned>::max();

  ScriptedNode(const link::Endpoint& endpoint, std::uint8_t id, Tells tells,
               unsigned answers = kForEver)
      : id_(id), tells_(std::move(tells)), answers_(answers), port_(endpoint) {
    thread_ = std::thread([this] { run(); });
  }
  ~ScriptedNode() {
    over_ = true;
    thread_.join();
  }
  ScriptedNode(const ScriptedNode&) = delete;
  ScriptedNode& operator=(const ScriptedNode&) = delete;

  unsigned unanswered() const { return unanswered_; }

 private:
  void run() {
    constexpr std::uint32_t kLook_us = 20'000;
    CanFrame frame;
    while (!over_) {
      if (port_.await(frame, kLook_us)) hear(frame);
    }
  }
  void hear(const CanFrame& frame) {
    namespace sdo = canopen::sdo;
    if (!canopen::is_canopen(frame) || frame.id != canopen::sdo_request_id(id_)) return;
    if (sdo::specifier_of(frame) != sdo::request::kUpload) return;
    if (answers_ == 0) {
      ++unanswered_;
      return;
    }
    --answers_;
    const canopen::Address at = sdo::address_of(frame);
    const std::uint32_t to = canopen::sdo_response_id(id_);
    constexpr std::uint8_t kFourBytes =
        sdo::command(sdo::response::kUpload, sdo::kExpedited | sdo::kSizeGiven);
    const std::optional<std::uint32_t> value = tells_(at);
    port_.send(value ? sdo::addressed(to, kFourBytes, at, *value)
                     : sdo::abort_frame(to, at, canopen::Abort::kNoObject));
  }

  const std::uint8_t id_;
  const Tells tells_;
  unsigned answers_;  ///< answers left
  link::CanPort port_;
  std::atomic<unsigned> unanswered_ = 0;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

}  // namespace verp::test
