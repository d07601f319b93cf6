// must say: Tilt: padding, or a field missing from VERP_FIELDS
#include "common/base/fields.hpp"

namespace {

/// Such a field would be neither digested nor recorded.
struct Tilt {
  float roll_rad = 0;
  float pitch_rad = 0;
#ifdef BROKEN
  VERP_FIELDS(roll_rad)
#else
  VERP_FIELDS(roll_rad, pitch_rad)
#endif
};
VERP_PACKED(Tilt);

}  // namespace
