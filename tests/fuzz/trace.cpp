// A trace: a recorded run of a few ticks, changed and given right checksums; read whole and as far
// as it goes, replayed, cut, merged, written anew.
#include <sstream>

#include "host/trace/record/decisions.hpp"
#include "host/trace/record/mcap_reader.hpp"
#include "host/trace/record/ros_radio.hpp"
#include "host/trace/record/trace_cut.hpp"
#include "host/trace/record/trace_merge.hpp"
#include "host/trace/record/trace_recover.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/mcap_repair.hpp"
#include "tests/host/record/sample.hpp"

namespace verp::fuzz {
namespace {

namespace fs = std::filesystem;

std::string recorded(bool compress) {
  const fs::path file = in_file("sound.mcap", "");
  fs::remove(file);
  record::test::write_run(file, 8, {.chunk_ticks = 3, .compress = compress});
  return record::test::slurp(file);
}

void read(const fs::path& file, record::Read mode) {
  refuses_only_by<record::TraceError>([&] {
    const record::Trace trace = record::read_trace(file, mode);
    record::Decisions decisions(trace);
    for (std::size_t i = 0; i < trace.ticks.size() && i < 64; ++i) decisions.at(trace.ticks[i]);
    record::core_of(trace);
  });
}

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  using fuzz::refuses_only_by;
  fuzz::Bytes bytes(data, size);
  static const std::string sound[] = {fuzz::recorded(false), fuzz::recorded(true)};
  const std::uint8_t how = bytes.byte();
  std::string changed = fuzz::patched(sound[how % 8 == 0 ? 1 : 0], bytes);
  if (how < 240) fuzz::repair_mcap(changed);
  record::mcap::Reader reader(std::make_unique<std::istringstream>(changed));
  std::uint64_t last = 0;
  reader.read([&](const record::mcap::File&, const record::mcap::Message& each) {
    last = each.part;
    record::ros::read_radio(each.data);
  });
  if (last != 0) reader.read_part(last, {[](const auto&, const auto&) {}});
  const std::filesystem::path file = fuzz::in_file("changed.mcap", changed);
  fuzz::read(file, how % 2 == 0 ? record::Read::kStrict : record::Read::kRecover);
  refuses_only_by<record::TraceError>([&] { record::for_each_picture(file, [](const auto&) {}); });
  const std::filesystem::path out = file.parent_path() / "out.mcap";
  refuses_only_by<record::TraceError>([&] {  // one of these, because each waits for the disk
    if (how % 16 == 1) record::recover_trace(file, out);
    if (how % 16 == 3) record::cut_trace(file, 0.02, 0.05, out);
    if (how % 16 == 5) record::merge_traces({{"a", file}, {"b", file}}, out);
  });
  std::filesystem::remove(out);
  return 0;
}
