// What users type behind an option: links, pushes, settings.
#include "host/os/link/endpoint.hpp"
#include "host/run/scenario/text.hpp"
#include "host/run/session/intervention.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::refuses_only_by<link::EndpointError>([&] {
    const link::Endpoint read = link::parse_endpoint(text);
    fuzz::require(link::parse_endpoint(link::to_text(read)) == read, "a link is read as printed");
  });
  fuzz::refuses_only_by<std::invalid_argument>(
      [&] { session::in_words(session::read_push(text)); });
  fuzz::refuses_only_by<std::invalid_argument>(
      [&] { session::in_words(session::read_setting(text)); });
  scenario::start_of(text);
  return 0;
}
