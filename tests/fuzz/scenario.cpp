// A run as JSON: read, printed, read again.
#include "host/run/scenario/text.hpp"

#include "host/robot/model/load_error.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::refuses_only_by<model::LoadError>([&] {
    const scenario::Scenario read = scenario::parse(text, "a.json");
    fuzz::require(scenario::parse(scenario::print(read), "b.json") == read,
                  "a scenario is read as it was printed");
  });
  return 0;
}
