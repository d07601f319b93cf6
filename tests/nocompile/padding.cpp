// must say: Sample: padding, or a field missing from VERP_FIELDS
#include "common/base/fields.hpp"

namespace {

/// Padding differs from run to run.
struct Sample {
  std::uint8_t flags = 0;
#ifndef BROKEN
  std::uint8_t reserved[3] = {};
  VERP_FIELDS(flags, reserved, value)
#else
  VERP_FIELDS(flags, value)
#endif
  std::uint32_t value = 0;
};
VERP_PACKED(Sample);

}  // namespace
