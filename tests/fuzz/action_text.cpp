// An action's text: read, printed, read again, compiled for a robot.
#include "host/author/action/compile.hpp"
#include "host/author/action/csv.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/unit/support/test_robot.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::refuses_only_by<model::LoadError>([&] {
    const action::Document read = action::parse_document("a.action", text);
    const std::string printed = action::text_of(read);
    fuzz::require(action::text_of(action::parse_document("a.action", printed)) == printed,
                  "what is printed is read and printed alike");
    const action::CompiledActions made = action::make_library(test::kRobot, {read});
    fuzz::require(action::check_library(made.words.data(), 4 * made.words.size()) ==
                      action::LibraryFault::kNone,
                  "a compiled library is sound");
    for (int number = 1; number <= made.library().count(); ++number)
      action::to_csv(test::kRobot, made, number);
  });
  return 0;
}
