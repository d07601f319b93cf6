#include "tests/exhaustive/golden.hpp"

#include <cstdio>

#include "tests/unit/math/golden_inputs.hpp"

namespace verp::exhaustive {
namespace {

using namespace math::golden;

void print_bits(std::uint32_t bits) {
  std::printf("0x%08XU, ", bits);
}

void print_hash(std::uint64_t hash) {
  std::printf("    0x%016llXU,\n", static_cast<unsigned long long>(hash));
}

}  // namespace

void print_golden() {
  std::printf(
      "#pragma once\n#include <cstdint>\n\n"
      "#include \"tests/unit/math/golden_inputs.hpp\"\n\n"
      "/// Printed by `verp_exhaustive --golden`, then formatted. Other bits than these on any "
      "target\n"
      "/// are a broken floating-point contract, not a tolerance.\n"
      "namespace verp::math::golden {\n\n"
      "inline constexpr std::uint32_t kResults[kFunctionCount][kArgumentCount] = {\n");
  for (const Function& function : kFunctions) {
    std::printf("    {  // %s\n", function.name);
    for (const float x : kArguments) print_bits(to_bits(function.call(x)));
    std::printf("},\n");
  }
  std::printf("};\n\ninline constexpr std::uint32_t kAtan2Results[kPointCount] = {\n");
  for (const Point& p : kPoints) print_bits(to_bits(math::atan2(p.y, p.x)));
  std::printf("};\n\ninline constexpr std::uint64_t kHashes[kFunctionCount] = {\n");
  for (const Function& function : kFunctions) print_hash(hash_of(function.call, kHashCount));
  std::printf("};\n\ninline constexpr std::uint64_t kHashesWithin[kFunctionCount] = {\n");
  for (int i = 0; i < kFunctionCount; ++i) {
    print_hash(hash_within(kFunctions[i].call, kHashBound[i], kHashCount));
  }
  std::printf("};\n\ninline constexpr std::uint64_t kAtan2Hash =\n    0x%016llXU;\n",
              static_cast<unsigned long long>(hash_of_atan2(kHashCount)));
  std::printf("\n}  // namespace verp::math::golden\n");
}

}  // namespace verp::exhaustive
