#pragma once
#include <cstdint>
#include <string_view>

/// What is compared with what, and how far apart the two may be.
namespace verp::exhaustive {

struct UnaryFunction {
  std::string_view name;
  double bound_ulp;  ///< documented in common/math/elementary.hpp
  float (*tested)(float);
  double (*reference)(double);                 ///< double libm: exact to 2^-28 of a float's ulp
  long double (*fine_reference)(long double);  ///< decides what the double can't
  /// True where the contract gives a value instead of the mathematical function (NaN, out of the
  /// domain).
  bool (*special)(float x, float& expected);
};

extern const UnaryFunction kUnaryFunctions[];
extern const int kUnaryFunctionCount;

inline constexpr double kAtan2BoundUlp = 2.0;

struct Pair {
  float y;
  float x;
};
/// The i-th of the stratified atan2 arguments: a quarter each of any two finite floats, exponents
/// within 2 of each other, within 30, and a robot's lengths (1e-6 to 16). A pure function of i, so
/// any finding repeats.
Pair stratified_pair(std::uint64_t i);

/// |result - exact| in units of the spacing of floats at `exact`. Infinite for a result that is not
/// finite.
double error_ulp(float result, double exact);
double fine_error_ulp(float result, long double exact);

}  // namespace verp::exhaustive
