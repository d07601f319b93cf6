#pragma once
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

#include "host/show/camera/drawing_program.hpp"
#include "host/show/camera/wire.hpp"

namespace verp::camera {

/// A separate program draws on another core; pictures return in the order of moments.
class Rig {
 public:
  enum class Pace {
    kEveryPicture,  ///< the run waits for pictures
    kNeverWaits     ///< the rig drops pictures
  };
  /// Waits until it can draw. Throws CameraError. On the main thread (DrawingProgram).
  Rig(const std::filesystem::path& program, const Stage& stage, Pace pace);
  ~Rig();
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// Throws CameraError if the program has ended.
  void expose(const Moment& moment);
  /// Pictures of the next due moment, else empty. kEveryPicture: kAhead before the last; otherwise
  /// any that is done.
  std::vector<Picture> take();
  /// Waits for the pictures of the next moment; empty after the last.
  std::vector<Picture> take_last();

  std::uint64_t moments() const { return sent_; }     ///< drawn or in progress
  std::uint64_t dropped() const { return dropped_; }  ///< not drawn
  double processor_s() const;                         ///< the program's so far

  /// Moments in progress; fixed, so that drawing speed does not decide which pictures a run gets.
  static constexpr std::uint64_t kAhead = 8;

 private:
  std::vector<Picture> take_within(std::uint64_t on_their_way, bool wait);
  void listen();
  [[noreturn]] void fail_ended() const;

  const Pace pace_;
  DrawingProgram program_;
  std::uint64_t sent_ = 0, taken_ = 0, dropped_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable came_;
  std::deque<std::vector<Picture>> done_;  ///< drawn, not taken
  std::uint64_t processor_us_ = 0;
  bool ended_ = false;
  std::thread listener_;
};

}  // namespace verp::camera
