#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/protocol/canopen/robot_plan.hpp"
#include "common/protocol/canopen/sdo.hpp"
#include "firmware/app/can_nodes.hpp"

namespace verp::app {

/// The dxl::HardwareError nearest to a CiA 402 error code, for the core.
std::uint8_t hardware_error_of(std::uint16_t code);

/// Slow telemetry: at the end of each tick an expedited SDO upload from one drive, whose answer the
/// next tick takes. A drive without kTelemetry is asked for voltage and error code instead and
/// reports no temperature. A drive without those reports nothing.
class DriveTelemetry {
 public:
  explicit DriveTelemetry(const Params& params) : params_(params) {}

  void set_foreign(std::uint32_t drives) { plain_ = drives; }
  /// Asks this drive next: it has something to report.
  void hurry(int joint) { urgent_ = joint; }

  NodeMask asked() const { return asked_ < 0 ? 0 : node_bit(asked_); }

  /// The next request; false: there is no request. Skips drives in `busy`: each answer also proves
  /// that the bus is prompt. `missed`: the last request had no answer.
  bool next(CanFrame& frame, NodeMask busy, bool& missed);

  /// Takes an SDO response; false: not to the last request.
  bool receive(int joint, const CanFrame& frame);
  void put(Inputs& inputs);

 private:
  enum class Part : std::uint8_t { kAll, kVoltage, kError };

  static bool is_in(NodeMask mask, int joint) { return (mask & node_bit(joint)) != 0; }
  void choose(NodeMask busy);
  canopen::Address object() const;
  // A drive that cannot answer now is asked again in its next turn.
  void take_abort(int joint, canopen::Abort why);
  void take(std::uint32_t value);

  const Params& params_;
  int joint_ = 0;
  int asked_ = -1;
  int urgent_ = -1;
  std::uint32_t plain_ = 0;
  Part part_ = Part::kAll;
  bool more_ = false;  ///< ask the same drive again
  bool fresh_ = false;
  canopen::Address at_;
  canopen::plan::Telemetry value_;
};

}  // namespace verp::app
