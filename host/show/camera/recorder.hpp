#pragma once
#include <deque>
#include <functional>
#include <string>

#include "host/show/camera/rig.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::camera {

/// What the robot's cameras see, into its trace: of each picture the image on
/// /NAME/image/compressed (colour), /NAME/depth or /NAME/labels, and its lens on /NAME/camera_info,
/// in the frame NAME_optical, which /tf_static hangs on its link. In the file a picture stands a
/// little later than the ticks of its time.
class Recorder {
 public:
  /// All of it must outlive the recorder.
  Recorder(Rig& rig, const model::Entity& entity, const Params& params, record::TraceWriter& trace);

  /// For session::Hooks::exposed. Never throws: what goes wrong ends the pictures, not the run, and
  /// is failure().
  void exposed(const sim::Exposure& exposure, std::uint64_t stamp_ns);
  /// Waits for what is still being drawn; before the trace is closed.
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
  std::deque<std::uint64_t> stamps_ns_;  ///< of the moments that are on their way
  std::uint64_t pictures_ = 0;
  std::string failure_;
};

}  // namespace verp::camera
