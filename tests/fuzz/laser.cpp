// Replies of a Hokuyo laser (SCIP 2.0), in pieces, mostly with right checksums.
#include "host/os/link/scip.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace {

/// Every line but a reply's first ends with its sum.
void repair(std::string& stream) {
  bool echo = true;
  for (std::size_t at = 0, end = 0; at < stream.size(); at = end + 1) {
    end = stream.find('\n', at);
    if (end == std::string::npos) return;
    if (!echo && end > at)
      stream[end - 1] = verp::link::scip::sum_of(std::string_view(stream).substr(at, end - 1 - at));
    echo = end == at;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  const std::uint8_t how = bytes.byte();
  std::string stream(bytes.rest());
  if (how < 240) repair(stream);
  link::scip::Replies replies;
  for (std::size_t at = 0; at < stream.size(); at += 1U + how) {
    const std::string piece = stream.substr(at, 1U + how);
    replies.add(reinterpret_cast<const std::uint8_t*>(piece.data()), piece.size());
    for (auto reply = replies.next(); reply; reply = replies.next()) {
      hal::RangeScan scan;
      link::scip::read_scan(*reply, 20, scan);
      fuzz::require(scan.steps <= hal::kMostRangeSteps, "a scan fits");
    }
  }
  return 0;
}
