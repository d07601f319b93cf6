#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "common/control/step.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::record::test {

namespace fs = std::filesystem;

class TraceFolder : public ::testing::Test {
 protected:
  TraceFolder() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              (std::string("verp-") + info->name() + "-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  ~TraceFolder() override { fs::remove_all(folder_); }
  fs::path folder_;
};

inline Params sample_params() {
  Params params;
  std::strcpy(params.name, "sample");
  params.joint_count = 2;
  std::strcpy(params.joint[0].name, "l_hip");
  std::strcpy(params.joint[1].name, "l_knee");
  for (int j = 0; j < 2; ++j) {
    params.joint[j].axis.y = 1;
    params.joint[j].counts_per_rad = 651.9f;
    params.joint[j].zero_count = 2048;
  }
  params.joint[1].parent = 1;
  params.imu.gyro_rad_s_per_count = 0.001f;
  params.imu.accel_m_s2_per_count = 0.005f;
  return params;
}

inline Inputs sample_inputs(std::uint32_t tick) {
  Inputs inputs;
  inputs.tick = tick;
  inputs.fresh = 3;
  inputs.flags = kImuFresh;
  inputs.accel_count[2] = 1962;
  inputs.position_count[0] = 2048 + static_cast<std::int32_t>(tick);
  inputs.position_count[1] = 2048 - static_cast<std::int32_t>(tick);
  return inputs;
}

inline TickRecord record_of(const Inputs& inputs, const TickDigest& digest = {}) {
  TickRecord record;
  record.inputs = inputs;
  record.digest = digest;
  return record;
}

inline Trace sample_run(std::uint32_t ticks, const Params& params = sample_params()) {
  Trace trace;
  trace.params = params;
  State state;
  for (std::uint32_t tick = 0; tick < ticks; ++tick) {
    Outputs outputs;
    const Inputs inputs = sample_inputs(tick);
    step(params, state, inputs, outputs);
    trace.ticks.push_back(record_of(inputs, state.digest));
    if (tick % kKeyframeTicks == 0) trace.keyframes.push_back({tick, state});
  }
  return trace;
}

inline void write_run(const fs::path& file, std::uint32_t ticks, TraceOptions options = {},
                      bool close = true) {
  const Params params = sample_params();
  TraceWriter writer(file, params, {{"robot", "sample"}, {"seed", "1"}}, options);
  State state;
  const ros::BodyPose body;
  for (std::uint32_t tick = 0; tick < ticks; ++tick) {
    Outputs outputs;
    const Inputs inputs = sample_inputs(tick);
    step(params, state, inputs, outputs);
    const double effort_n_m[] = {0.5, -0.25 * tick};
    writer.append(record_of(inputs, state.digest), state, {}, &body, effort_n_m);
  }
  if (close) writer.close();
}

inline std::string slurp(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
inline void spit(const fs::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace verp::record::test
