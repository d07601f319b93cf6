#pragma once
#include <memory>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "host/boards/board/qemu.hpp"
#include "host/boards/flash/plan.hpp"

/// An emulated board is "flashed" by starting QEMU with the image: it has no flash that would
/// outlast it.
namespace verp::flash {

struct EmulatedLink {
  std::string what;   ///< "servo bus", "operator"
  std::string place;  ///< as other commands take it, or paths of FIFOs
};

struct EmulationPlan {
  board::QemuProcess::Launch launch;
  std::vector<EmulatedLink> links;
  BusProtocol protocol;  ///< of the robot's bus
};

/// The board with the image for this kind of bus and these pieces in its memory, its links in
/// `folder`. Throws FlashError when the board has no emulator, no such image, or the links' paths
/// are too long; this or NoSuchBoard when the image is not built.
EmulationPlan plan_emulation(const Recipe& recipe, BusProtocol protocol,
                             const std::vector<Piece>& pieces, const std::filesystem::path& folder);

/// A board that runs until this object ends.
class Emulation {
 public:
  /// Makes what the links need, starts QEMU and waits for the links. Throws BoardError.
  explicit Emulation(const EmulationPlan& plan);

  /// What its boot check came to, as its operator's port tells it: a line for people. Empty: the
  /// board has no such port. Throws DeviceError when nobody answers there.
  std::string told() const;

  /// False once QEMU has ended.
  bool running() { return !firmware_->poll_status().has_value(); }
  std::string described(const std::string& what) const { return firmware_->described(what); }

 private:
  std::string operator_place_;
  BusProtocol protocol_;
  std::unique_ptr<board::QemuProcess> firmware_;
};

}  // namespace verp::flash
