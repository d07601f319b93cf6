#pragma once
#include <fstream>
#include <string>

#include "tests/replay/long_trace.hpp"

namespace verp::replay {

inline constexpr std::uint32_t kTraceFileMagic = 0x3147'4E4C;  // "LNG1"

struct TraceFileHead {
  std::uint32_t magic = kTraceFileMagic;
  std::uint32_t params_size = sizeof(Params);
  std::uint32_t record_size = sizeof(TickRecord);
  std::uint32_t segments = 0;
};

/// False if it cannot be written.
inline bool write_trace_file(const std::string& path, const std::vector<Segment>& trace) {
  std::ofstream file(path, std::ios::binary);
  const auto put = [&](const auto& value) {
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(TraceFileHead{.segments = static_cast<std::uint32_t>(trace.size())});
  for (const Segment& segment : trace) {
    char name[kNameLength] = {};
    segment.name.copy(name, kNameLength - 1);
    put(name);
    put(segment.params);
    put(static_cast<std::uint32_t>(segment.ticks.size()));
    for (const TickRecord& tick : segment.ticks) put(tick);
  }
  file.close();
  return file.good();
}

/// Empty if the file is missing, cut, or from another build.
inline std::vector<Segment> read_trace_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const auto get = [&](auto& value) {
    file.read(reinterpret_cast<char*>(&value), sizeof value);
    return file.good();
  };
  TraceFileHead head;
  const TraceFileHead wanted;
  if (!get(head) || head.magic != wanted.magic || head.params_size != wanted.params_size ||
      head.record_size != wanted.record_size) {
    return {};
  }
  std::vector<Segment> trace(head.segments);
  for (Segment& segment : trace) {
    char name[kNameLength];
    std::uint32_t ticks = 0;
    if (!get(name) || !get(segment.params) || !get(ticks)) return {};
    segment.name = name;
    segment.ticks.resize(ticks);
    for (TickRecord& tick : segment.ticks) {
      if (!get(tick)) return {};
    }
  }
  return trace;
}

}  // namespace verp::replay
