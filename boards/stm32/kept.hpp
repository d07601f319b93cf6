#pragma once
#include "boards/stm32/hardware.hpp"
#include "firmware/app/robot_images.hpp"
#include "firmware/app/settings.hpp"
#include "firmware/store/flash_store.hpp"
#include "firmware/store/shared_page.hpp"
#include "hal/chip/stm32/flash_pages.hpp"

/// Sectors that every memory.ld leaves free. One holds the robot, with its actions in the second
/// half. Two hold a log of settings; a new robot or new actions wait in the one without a log.
namespace verp::board {

class Kept {
  static constexpr std::uint8_t kRobotSector = 5;
  static constexpr std::uint8_t kLogSectors[2] = {6, 7};
  using Dog = stm32::IndependentWatchdog<Io>;
  using Pages = stm32::SectorPages<Io, Timer, Dog>;
  using Log = store::FlashStore<Pages>;
  using Room = store::WaitingRoom<Pages, Pages, Log>;

 public:
  /// Call at start, before robot or actions are used: finishes what a power loss interrupted.
  static void finish(Dog& dog) {
    Pages robot = robot_pages(dog), log = log_pages(dog);
    store::finish_waiting(robot, log, [&dog] { dog.feed(); });
  }

  /// `actions` follow the robot in its sector.
  Kept(Dog& dog, const ParamsImage& robot, const std::uint8_t* actions, std::size_t actions_bytes)
      : dog_(dog),
        log_pages_(log_pages(dog)),
        robot_pages_(robot_pages(dog)),
        room_(robot_pages_,
              static_cast<std::size_t>(actions - reinterpret_cast<const std::uint8_t*>(&robot)),
              actions_bytes, log_pages_, log),
        images(robot, actions, actions_bytes, room_) {
    log.open();
  }

  bool has_news() const {
    return images.accepted_robot() != nullptr || images.accepted_actions() > 0;
  }
  /// Writes the operator's new images over the active ones: reset next. A power loss leaves the old
  /// or the new ones. The boot check detects a flash failure.
  void write_news() {
    room_.replace(reinterpret_cast<const std::uint8_t*>(images.accepted_robot()),
                  sizeof(ParamsImage), images.accepted_actions(), images.actions_bytes(),
                  [this] { dog_.feed(); });
  }
  void keep(const app::Settings& now, bool may_erase) {
    settings.keep(now, may_erase);
    room_.work(may_erase);
  }

 private:
  static Pages log_pages(Dog& dog) { return {kFamily, kLogSectors[0], kLogSectors[1], timer, dog}; }
  static Pages robot_pages(Dog& dog) { return {kFamily, kRobotSector, kRobotSector, timer, dog}; }

  Dog& dog_;
  Pages log_pages_;
  Pages robot_pages_;

 public:
  Log log{log_pages_};
  app::SettingsKeeper<Log> settings{log};

 private:
  Room room_;

 public:
  using Images = app::RobotImages<Room>;
  Images images;
};

}  // namespace verp::board
