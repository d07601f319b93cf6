#include "host/tool/json.hpp"

#include <cstdio>
#include <string>

namespace verp::tool {

void print_json(const Json& object) {
  // A model's name may hold any bytes; JSON must stay JSON.
  const std::string text = object.dump(2, ' ', false, Json::error_handler_t::replace);
  std::fputs((text + "\n").c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace verp::tool
