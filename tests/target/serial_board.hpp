#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/protocol/controller_table.hpp"
#include "host/boards/board/qemu.hpp"
#include "host/boards/board/temporary_directory.hpp"
#include "host/twin/bus/client.hpp"
#include "host/twin/bus/lockstep_server.hpp"
#include "tests/support/link_faults.hpp"
#include "tests/target/twin_run.hpp"

/// loop_<board> in QEMU, a socket at each serial port.
namespace verp::test {

class SerialBoard {
 public:
  /// Images go where the board's memory.ld puts them; empty: without.
  SerialBoard(const std::string& board, const std::vector<std::uint8_t>& params_image,
              const std::vector<std::uint8_t>& actions_image = {});

  link::Endpoint servo_port() const { return endpoint("servo.sock"); }
  /// Registers of the controller as integers.
  bus::Client& operator_port() { return operator_port_; }
  std::uint64_t read(const char* name);
  void write(const char* name, std::int64_t value);
  std::string described(const std::string& what) const { return firmware_.described(what); }

 private:
  link::Endpoint endpoint(const char* name) const;
  board::QemuProcess start(const std::string& board, const std::vector<std::uint8_t>& params,
                           const std::vector<std::uint8_t>& actions) const;
  std::vector<std::string> load(const char* name, const std::vector<std::uint8_t>& image,
                                const char* address) const;

  board::TemporaryDirectory directory_;
  board::QemuProcess firmware_;
  bus::Client operator_port_;
};

/// The flash content of `robot`.
std::vector<std::uint8_t> params_image(const Robot& robot);
std::vector<std::uint8_t> actions_image(const Robot& robot);

/// On the servo port's cable, once the loop ticks.
struct SerialTrouble {
  LinkFaults to_board, from_board;
  int cut_every = 0;  ///< pulls the cable after so many answers; that answer is lost
  std::uint32_t seed = 1;
  /// The twin waits before this tick for `pause`. 0: never.
  std::uint32_t pause_before = 0;
  std::function<void()> pause{};
};

struct SerialRun {
  TwinRun twin;
  std::uint64_t digest = 0;  ///< the controller's
  std::uint32_t tick = 0;    ///< the controller's
  std::string difference;    ///< see bus::ShadowLoop
  double ticks_per_s = 0;    ///< wall time
  std::uint64_t faults = 0;  ///< damaged bytes on the cable
  int cuts = 0;
  std::uint32_t bus_timeouts = 0;  ///< as the operator's registers report
  std::uint32_t bus_noise = 0;     ///< likewise
  bus::LockstepServer::Counters lockstep;
};

/// The twin is at the servo port, the script's operator at the other. Throws BoardError or
/// DeviceError.
SerialRun run_over_serial(SerialBoard& board, const Robot& robot, const Script& script,
                          const SerialTrouble& trouble = {});
SerialRun run_over_serial(SerialBoard& board, const Robot& robot, std::uint32_t ticks,
                          const SerialTrouble& trouble = {});

}  // namespace verp::test
