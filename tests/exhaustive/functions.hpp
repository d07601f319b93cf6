#pragma once
#include <cstdint>
#include <string_view>

/// Each function, its reference, and the allowed difference.
namespace verp::exhaustive {

struct UnaryFunction {
  std::string_view name;
  double bound_ulp;  ///< documented in common/math/elementary.hpp
  float (*tested)(float);
  double (*reference)(double);                 ///< double libm: exact to 2^-28 of a float's ulp
  long double (*fine_reference)(long double);  ///< decides where double cannot
  /// True where the contract defines a value itself (NaN, outside the domain).
  bool (*special)(float x, float& expected);
};

extern const UnaryFunction kUnaryFunctions[];
extern const int kUnaryFunctionCount;

inline constexpr double kAtan2BoundUlp = 2.0;

struct Pair {
  float y;
  float x;
};
/// The i-th stratified pair of atan2 arguments. A quarter each: any two finite floats, exponents
/// within 2, exponents within 30, a robot's lengths (1e-6 to 16). A pure function of i, so any
/// finding repeats.
Pair stratified_pair(std::uint64_t i);

/// |result - exact| in units of the float spacing at `exact`. Infinite if the result is not finite.
double error_ulp(float result, double exact);
double fine_error_ulp(float result, long double exact);

}  // namespace verp::exhaustive
