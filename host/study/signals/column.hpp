#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/model/params.hpp"

/// What a trace holds as columns of numbers: a line each tick, a column each signal.
namespace verp::signals {

/// How CSV writes a column's numbers.
enum class Format : std::uint8_t {
  kWhole,
  kFixed4,   ///< four decimals
  kFixed6,   ///< six decimals
  kDigits5,  ///< five digits that count
  kDigits6,
  kState,  ///< a field of State, as fields.hpp has it
};

/// SI units, sensor axes as the IMU has them.
struct Column {
  std::string name;     ///< the joint's in it is from a file
  std::string unit;     ///< empty: a number without, such as a phase
  std::string subject;  ///< what it is of: measured and goal of a joint have the same
  Format format = Format::kWhole;
};

/// In the order of the CSV; `states`: every field of the controller's State, too.
std::vector<Column> columns_of(const Params& params, bool states);

/// Those that `pattern` means, in their order: the one of that name, or else all that fit, `*`
/// being any letters and `?` any one. Empty: none.
std::vector<std::size_t> matching(const std::vector<Column>& columns, std::string_view pattern);

}  // namespace verp::signals
