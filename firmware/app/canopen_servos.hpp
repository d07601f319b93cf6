#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/protocol/canopen/emcy.hpp"
#include "common/protocol/canopen/nmt.hpp"
#include "common/protocol/canopen/sync.hpp"
#include "firmware/app/answer_watch.hpp"
#include "firmware/app/bring_up_report.hpp"
#include "firmware/app/can_master.hpp"
#include "firmware/app/can_schedule.hpp"
#include "firmware/app/doubted_drives.hpp"
#include "firmware/app/drive_efforts.hpp"
#include "firmware/app/drive_telemetry.hpp"
#include "firmware/app/drive_writer.hpp"
#include "firmware/app/node_renewal.hpp"
#include "firmware/app/sensed_counts.hpp"
#include "firmware/app/sync_repair.hpp"
#include "firmware/app/sync_round.hpp"

/// The ServoBinding (contracts.hpp) for CANopen and CiA 402: drives, IMU and feet on one CanBus
/// (common/protocol/canopen/robot_plan.hpp).
namespace verp::app {

class CanopenServos {
 public:
  CanopenServos(const Params& params, hal::CanBus& bus);
  BringUpReport bring_up();
  void limit_torque(std::uint8_t percent) { writer_.limit_torque(percent); }

  /// Runs all SYNCs of the tick; keeps the sensors' answers for read_sensors().
  void read_positions(Inputs& inputs);
  std::uint64_t now_us() const { return began_us_; }
  /// Drives report a missing heartbeat in their statusword.
  void heard_nothing_for(std::uint64_t) {}

  void read_sensors(Inputs& inputs, bool imu);
  void send(const Outputs& outputs);
  const BusCounters& counters() const { return master_.counters; }
  std::uint32_t damaged() const { return master_.errors().errors; }
  std::uint32_t noise() const;
  const JointEffort* efforts() const { return efforts_.efforts(); }

 private:
  static constexpr int kMostWaiting = 64;   ///< frames before a tick; bounds a flooded bus
  static constexpr int kMostInWindow = 64;  ///< after each SYNC
  /// SDO requests in a tick; each may extend a window for a silent node.
  static constexpr std::uint8_t kHurries = 3;
  static constexpr std::uint8_t kProbeTicks = 8;       ///< ticks between waits for silent nodes
  static constexpr std::uint16_t kLongSilence = 5000;  ///< ticks; the count stops here
  static_assert(most_sent(kMaxJoints) <= hal::kCanQueue);

  // Drops frames that came after the last tick.
  void forget_stale(Inputs& inputs);

  // A flooded bus delays the SYNC and so its timeout: frames of this tick may use up the time of
  // all SYNCs, no more. True if none came although there was room.
  bool listen(Inputs& inputs);
  void take(const CanFrame& frame, Inputs& inputs);

  // False: not an answer to this tick's SYNCs.
  bool take_answer(const CanFrame& frame, int slot, unsigned number, Inputs& inputs);
  void take_drive(const CanFrame& frame, int joint, Answer worth, Inputs& inputs);
  bool take_response(const CanFrame& frame, int slot);
  void take_emergency(const CanFrame& frame, int slot);
  void take_heartbeat(const CanFrame& frame, int slot);
  void believe_boot(int slot);
  /// A drive answers no SYNC after its boot. If it answers, another device or program has its node
  /// id: stopping and setting it up again would make the robot fall.
  void judge_boots();
  /// Undoubted nodes that answer another SYNC.
  NodeMask astray() const;
  void renew();

  // The IMU is as silent as the worse of its two frames.
  void count_silence();

  const Params& params_;
  CanNodes nodes_;
  CanMaster master_;
  const std::uint8_t groups_;
  SyncRound round_{groups_};
  canopen::HeartbeatProducer heartbeat_{canopen::plan::kControllerNode};
  AnswerWatch answers_;
  DriveWriter writer_{params_};
  DoubtedDrives doubts_{params_};
  NodeRenewal renewal_{params_};
  DriveTelemetry telemetry_{params_};
  DriveEfforts efforts_{params_};
  SyncRepair repair_{params_};
  SensedCounts sensed_;
  NodeMask present_ = 0;
  NodeMask booted_ = 0;         ///< drives that said so in this tick
  NodeMask booted_before_ = 0;  ///< and in the tick before
  NodeMask given_up_ = 0;
  std::uint16_t silent_ticks_[AnswerWatch::kSources] = {};
  std::uint64_t began_us_ = 0;
  std::uint32_t heard_us_ = 0;
  std::uint32_t patience_us_ = 0;  ///< limit for all SYNCs of a tick
  std::uint8_t window_ = 0;        ///< last SYNC sent; 0: none
  std::uint8_t probe_ = 0;
  std::uint8_t hurries_ = 0;
  bool torque_ = false;
};

}  // namespace verp::app
