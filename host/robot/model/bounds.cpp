#include "host/robot/model/bounds.hpp"

#include <fmt/format.h>

#include "host/robot/model/load_error.hpp"

namespace verp::model {

void require_within(const std::string& file, int line, const std::string& what, double value,
                    double low, double high, const char* unit) {
  if (value >= low && value <= high) return;
  throw LoadError(file, line, fmt::format("{} is out of range: {:g}", what, value),
                  fmt::format("give {:g} to {:g}{}; check the units", low, high, unit));
}

}  // namespace verp::model
