#pragma once
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

/// The part of Python's expressions that robots' xacro files use: numbers, texts, comparisons,
/// and/or/not, A if B else C, and functions of math.
namespace verp::xacro {

inline constexpr std::size_t kMostText = 65536;  ///< of a value: doublings end there

using Value = std::variant<double, std::string>;

/// What is wrong; the caller knows where.
class ExpressionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// As Python prints it.
std::string text_of(const Value& value);
bool is_true(const Value& value);
/// A number, where the text is one.
Value value_of(const std::string& text);

/// Throws ExpressionError. `look_up` gives a name's value, or throws it.
Value evaluate(std::string_view expression,
               const std::function<Value(const std::string& name)>& look_up);

}  // namespace verp::xacro
