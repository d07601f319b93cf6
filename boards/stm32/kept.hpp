#pragma once
#include "boards/stm32/hardware.hpp"
#include "common/action/kept.hpp"
#include "firmware/app/block_window.hpp"
#include "firmware/app/settings.hpp"
#include "firmware/store/flash_store.hpp"
#include "firmware/store/program_page.hpp"
#include "hal/chip/stm32/flash_pages.hpp"

/// What the board keeps in its own flash, in the sectors that every memory.ld here leaves free: the
/// robot at the beginning of one, whose second half is for its actions, and a log of settings in
/// two others.
namespace verp::board {

class Kept {
  static constexpr std::uint8_t kRobotSector = 5;
  static constexpr std::uint8_t kLogSectors[2] = {6, 7};
  using Dog = stm32::IndependentWatchdog<Io>;
  using Pages = stm32::SectorPages<Io, Timer, Dog>;
  using Log = store::FlashStore<Pages>;

 public:
  /// `actions`: behind the robot in its sector, so many bytes.
  Kept(Dog& dog, const ParamsImage& robot, const std::uint8_t* actions, std::size_t actions_bytes)
      : images(robot),
        dog_(dog),
        actions_(actions),
        actions_bytes_(actions_bytes),
        actions_offset_(
            static_cast<std::size_t>(actions - reinterpret_cast<const std::uint8_t*>(&robot))),
        log_pages_(kFamily, kLogSectors[0], kLogSectors[1], timer, dog),
        robot_pages_(kFamily, kRobotSector, kRobotSector, timer, dog) {
    log.open();
  }

  bool new_robot() const { return images.accepted() != nullptr; }
  /// Writes the robot that the operator sent over the one in force, which must not be used from
  /// then on, beside the actions that are there: reset next. If it fails, or the power does, the
  /// boot check finds out, and what is wrong with the actions.
  void write_robot() {
    store::program_beside(robot_pages_, 0, reinterpret_cast<const std::uint8_t*>(images.accepted()),
                          sizeof(ParamsImage),
                          {actions_offset_, action::kept_size(actions_, actions_bytes_)},
                          log_pages_, log.spare_page(), [this] { dog_.feed(); });
  }

  app::ParamsImages images;  ///< of the operator's window

 private:
  Dog& dog_;
  const std::uint8_t* actions_;
  std::size_t actions_bytes_, actions_offset_;
  Pages log_pages_;
  Pages robot_pages_;

 public:
  Log log{log_pages_};
  app::SettingsKeeper<Log> settings{log};
};

}  // namespace verp::board
