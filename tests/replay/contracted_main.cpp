#include "common/math/contraction.hpp"

/// Compiled without rounding of products; exit 0 if the check notices.
int main() {
  return verp::math::is_contracted(1.0F + 0x1p-13F, 1.0F + 0x1p-12F) ? 0 : 1;
}
