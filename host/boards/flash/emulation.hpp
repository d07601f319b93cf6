#pragma once
#include <memory>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/boards/board/qemu.hpp"
#include "host/boards/flash/plan.hpp"

/// "Flashes" an emulated board by starting QEMU with the image; it has no persistent flash.
namespace verp::flash {

struct EmulatedLink {
  std::string what;   ///< "servo bus", "operator"
  std::string place;  ///< endpoint for other commands, or FIFO paths
};

struct EmulationPlan {
  board::QemuProcess::Launch launch;
  std::vector<EmulatedLink> links;
  BusProtocol protocol;
};

/// Plans the board with the image for this bus protocol, the pieces in its memory and its links in
/// `folder`. Throws FlashError if there is no emulator or image, or a link path is too long;
/// FlashError or NoSuchBoard if the image is not built.
EmulationPlan plan_emulation(const Recipe& recipe, BusProtocol protocol,
                             const std::vector<Piece>& pieces, const std::filesystem::path& folder);

/// A board that runs until this object ends.
class Emulation {
 public:
  /// Prepares the links, starts QEMU and waits for the links. Throws BoardError.
  explicit Emulation(const EmulationPlan& plan);

  /// Result of the boot check from the board's operator port, as a line for people; empty: no such
  /// port. Throws DeviceError if the port does not answer.
  std::string told() const;

  bool running() { return !firmware_->poll_status().has_value(); }
  std::string described(const std::string& what) const { return firmware_->described(what); }

 private:
  std::string operator_place_;
  BusProtocol protocol_;
  std::unique_ptr<board::QemuProcess> firmware_;
};

}  // namespace verp::flash
