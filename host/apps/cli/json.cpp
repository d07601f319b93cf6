#include "host/apps/cli/json.hpp"

#include <cstdio>
#include <string>

#include "host/apps/cli/console.hpp"

namespace verp::cli {

void print_json(const Json& object) {
  // A model's name may contain any bytes; JSON must stay valid.
  const std::string text = object.dump(2, ' ', false, Json::error_handler_t::replace);
  std::fputs((text + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void print_answer(bool as_json, const Json& object, const std::string& text) {
  as_json ? print_json(object) : answer(text);
}

}  // namespace verp::cli
