#include "common/math/contraction.hpp"

/// Compiled with fused multiply-add, unlike everything else: exit 0 if that is noticed. Needs a
/// processor with FMA; without one there is nothing to notice.
int main() {
  if (!__builtin_cpu_supports("fma")) return 0;
  return verp::math::is_contracted(1.0F + 0x1p-13F, 1.0F + 0x1p-12F) ? 0 : 1;
}
