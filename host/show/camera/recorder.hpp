#pragma once
#include <deque>
#include <functional>
#include <string>

#include "host/show/camera/rig.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::camera {

/// Pictures in the robot's trace: /NAME/image/compressed (colour), /NAME/depth or /NAME/labels,
/// with the lens on /NAME/camera_info. Frame NAME_optical is on /tf_static. A picture comes a
/// little after its ticks.
class Recorder {
 public:
  /// The arguments must outlive it.
  Recorder(Rig& rig, const model::Entity& entity, const Params& params, record::TraceWriter& trace);

  /// A session::Hooks::exposed. Never throws: an error, in failure(), ends the pictures, not the
  /// run.
  void exposed(const sim::Exposure& exposure, std::uint64_t stamp_ns);
  /// Waits for pictures in progress; before the trace is closed.
  void finish();

  std::uint64_t pictures() const { return pictures_; }
  const std::string& failure() const { return failure_; }

 private:
  void place_lenses();
  void keep(const std::vector<Picture>& pictures);
  void guarded(const std::function<void()>& act);

  Rig& rig_;
  const model::Entity& entity_;
  const Params& params_;
  record::TraceWriter& trace_;
  std::deque<std::uint64_t> stamps_ns_;  ///< in progress
  std::uint64_t pictures_ = 0;
  std::string failure_;
};

}  // namespace verp::camera
