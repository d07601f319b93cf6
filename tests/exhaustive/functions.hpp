#pragma once
#include <cstdint>
#include <string_view>

namespace verp::exhaustive {

struct UnaryFunction {
  std::string_view name;
  double bound_ulp;  ///< from common/math/elementary.hpp
  float (*tested)(float);
  double (*reference)(double);                 ///< double libm: exact to 2^-28 of a float's ulp
  long double (*fine_reference)(long double);  ///< where double cannot decide
  /// True where the contract defines the value itself (NaN, outside the domain).
  bool (*special)(float x, float& expected);
};

extern const UnaryFunction kUnaryFunctions[];
extern const int kUnaryFunctionCount;

inline constexpr double kAtan2BoundUlp = 2.0;

struct Pair {
  float y;
  float x;
};
/// The i-th pair of atan2 arguments. A quarter each: any two finite floats, exponents within 2,
/// within 30, a robot's lengths (1e-6 to 16). A pure function of i.
Pair stratified_pair(std::uint64_t i);

/// |result - exact| in float spacings at `exact`. Infinite if the result is not finite.
double error_ulp(float result, double exact);
double fine_error_ulp(float result, long double exact);

}  // namespace verp::exhaustive
