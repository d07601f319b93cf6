// A table of key frames: read, compiled for its robot, printed.
#include "host/author/action/csv.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/support/test_robot.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::refuses_only_by<model::LoadError>([&] {
    const action::Document read = action::from_csv(test::kRobot, "a.csv", text, "a");
    action::parse_document("a.action", action::text_of(read));
    const action::CompiledActions made = action::make_library(test::kRobot, {read});
    action::from_csv(test::kRobot, "b.csv", action::to_csv(test::kRobot, made, 1), "a");
  });
  return 0;
}
