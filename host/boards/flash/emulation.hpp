#pragma once
#include <memory>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/boards/board/qemu.hpp"
#include "host/boards/flash/plan.hpp"

/// Starts QEMU with the image: an emulated board has no persistent flash.
namespace verp::flash {

struct EmulatedLink {
  std::string what;   ///< "servo bus", "operator"
  std::string place;  ///< endpoint, or FIFO paths
};

struct EmulationPlan {
  board::QemuProcess::Launch launch;
  std::vector<EmulatedLink> links;
  BusProtocol protocol;
};

/// Plans the board: image for this protocol, pieces in memory, links in `folder`. Throws FlashError
/// without emulator or image, or for a long link path; NoSuchBoard for an unbuilt image.
EmulationPlan plan_emulation(const Recipe& recipe, BusProtocol protocol,
                             const std::vector<Piece>& pieces, const std::filesystem::path& folder);

/// A board that runs until this object ends.
class Emulation {
 public:
  /// Starts QEMU and waits for the links. Throws BoardError.
  explicit Emulation(const EmulationPlan& plan);

  /// Result of the boot check, from the operator port, for people; empty: no such port. Throws
  /// DeviceError without an answer.
  std::string told() const;

  bool running() { return !firmware_->poll_status().has_value(); }
  std::string described(const std::string& what) const { return firmware_->described(what); }

 private:
  std::string operator_place_;
  BusProtocol protocol_;
  std::unique_ptr<board::QemuProcess> firmware_;
};

}  // namespace verp::flash
