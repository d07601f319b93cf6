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

/// A run's cameras: a program beside it draws what they see, on another core, while the run goes
/// on. Moments go to it, pictures come back in the order of moments.
class Rig {
 public:
  enum class Pace {
    kEveryPicture,  ///< a run that is too fast for the pictures waits for them
    kNeverWaits     ///< it drops them
  };
  /// Starts `program` and waits until it can draw. Throws CameraError. On the main thread
  /// (DrawingProgram).
  Rig(const std::filesystem::path& program, const Stage& stage, Pace pace);
  ~Rig();
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  /// Throws CameraError once the program has ended.
  void expose(const Moment& moment);
  /// The pictures of the next moment of which they are due: with kEveryPicture the one kAhead
  /// before the last, else any that is done. Empty: none is.
  std::vector<Picture> take();
  /// Those of the next moment, however long it takes; empty: there are no more.
  std::vector<Picture> take_last();

  std::uint64_t moments() const { return sent_; }     ///< that were drawn or will be
  std::uint64_t dropped() const { return dropped_; }  ///< that were not
  double processor_s() const;                         ///< of the program so far

  /// So many moments may be on their way: fixed, so that which pictures a run gets when does not
  /// hang on how fast they are drawn.
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
  std::deque<std::vector<Picture>> done_;  ///< of each moment that is drawn and was not taken
  std::uint64_t processor_us_ = 0;
  bool ended_ = false;
  std::thread listener_;
};

}  // namespace verp::camera
