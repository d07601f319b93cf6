#pragma once
#include <deque>
#include <functional>
#include <string>

#include "host/show/camera/rig.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::camera {

/// Writes camera pictures into the robot's trace: to /NAME/image/compressed (colour), /NAME/depth
/// or /NAME/labels, with the lens on /NAME/camera_info. Their frame is NAME_optical, which
/// /tf_static attaches to the camera's link. In the file a picture comes a little after the ticks
/// of its time.
class Recorder {
 public:
  /// All arguments must outlive the recorder.
  Recorder(Rig& rig, const model::Entity& entity, const Params& params, record::TraceWriter& trace);

  /// For session::Hooks::exposed. Never throws: an error, in failure(), ends the pictures and not
  /// the run.
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
  std::deque<std::uint64_t> stamps_ns_;  ///< of the moments in progress
  std::uint64_t pictures_ = 0;
  std::string failure_;
};

}  // namespace verp::camera
