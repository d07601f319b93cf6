#include "host/author/xacro/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "host/robot/model/number.hpp"

namespace verp::xacro {
namespace {

constexpr int kMostNesting = 200;  // of brackets

using Look = std::function<Value(const std::string&)>;
using Arguments = std::vector<Value>;

double number_of(const Value& value) {
  if (const double* const number = std::get_if<double>(&value)) return *number;
  const std::string& text = std::get<std::string>(value);
  if (const auto number = model::parse_number(text)) return *number;
  throw ExpressionError("'" + text + "' is no number");
}

double nth(const Arguments& arguments, std::size_t n) {
  if (n >= arguments.size()) throw ExpressionError("a function has too few arguments");
  return number_of(arguments[n]);
}

const std::map<std::string, double (*)(double)>& functions_of_one() {
  static const std::map<std::string, double (*)(double)> kFunctions = {
      {"sin", std::sin},
      {"cos", std::cos},
      {"tan", std::tan},
      {"asin", std::asin},
      {"acos", std::acos},
      {"atan", std::atan},
      {"sqrt", std::sqrt},
      {"exp", std::exp},
      {"log", std::log},
      {"floor", std::floor},
      {"ceil", std::ceil},
      {"fabs", std::fabs},
      {"abs", std::fabs},
      {"round", std::round},
      {"int", std::trunc},
      {"radians", [](double x) { return x * std::numbers::pi / 180; }},
      {"degrees", [](double x) { return x * 180 / std::numbers::pi; }}};
  return kFunctions;
}

Value call(const std::string& name, const Arguments& arguments) {
  const auto simple = functions_of_one().find(name);
  if (simple != functions_of_one().end()) return simple->second(nth(arguments, 0));
  if (name == "float") return nth(arguments, 0);
  if (name == "str" && arguments.size() == 1) return text_of(arguments[0]);
  if (name == "bool" && arguments.size() == 1) return is_true(arguments[0]) ? 1.0 : 0.0;
  if (name == "atan2") return std::atan2(nth(arguments, 0), nth(arguments, 1));
  if (name == "pow") return std::pow(nth(arguments, 0), nth(arguments, 1));
  if (name == "min") return std::min(nth(arguments, 0), nth(arguments, 1));
  if (name == "max") return std::max(nth(arguments, 0), nth(arguments, 1));
  throw ExpressionError("there is no function '" + name + "'");
}

class Parser {
 public:
  Parser(std::string_view text, const Look& look_up) : text_(text), look_up_(look_up) {}

  Value parse() {
    const Value value = choice();
    skip_space();
    if (at_ != text_.size())
      throw ExpressionError("'" + std::string(text_.substr(at_)) + "' is not understood");
    return value;
  }

 private:
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  static bool is_of_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  }
  bool take(std::string_view token) {
    skip_space();
    if (text_.substr(at_, token.size()) != token) return false;
    const std::size_t end = at_ + token.size();
    const bool is_word = is_of_name(token.back());
    if (is_word && end < text_.size() && is_of_name(text_[end])) return false;
    at_ = end;
    return true;
  }

  Value choice() {
    if (++depth_ > kMostNesting) throw ExpressionError("its brackets are too deep");
    Value value = any();
    if (take("if")) {
      const bool taken = is_true(any());
      if (!take("else")) throw ExpressionError("an 'if' has no 'else'");
      const Value other = choice();
      if (!taken) value = other;
    }
    --depth_;
    return value;
  }

  Value any() {
    Value value = all();
    while (take("or")) {
      const Value other = all();
      if (!is_true(value)) value = other;
    }
    return value;
  }

  Value all() {
    Value value = negation();
    while (take("and")) {
      const Value other = negation();
      if (is_true(value)) value = other;
    }
    return value;
  }

  Value negation() {
    if (take("not")) return is_true(negation()) ? 0.0 : 1.0;
    return comparison();
  }

  Value comparison() {
    const Value left = sum();
    for (const std::string_view sign : {"==", "!=", "<=", ">=", "<", ">"}) {
      if (take(sign)) return compare(sign, left, sum()) ? 1.0 : 0.0;
    }
    return left;
  }

  static bool compare(std::string_view sign, const Value& left, const Value& right) {
    if (sign == "==") return left == right;
    if (sign == "!=") return left != right;
    const double a = number_of(left), b = number_of(right);
    return sign == "<=" ? a <= b : sign == ">=" ? a >= b : sign == "<" ? a < b : a > b;
  }

  Value sum() {
    Value value = product();
    for (;;) {
      if (take("+")) {
        const Value other = product();
        const bool texts = std::holds_alternative<std::string>(value) &&
                           std::holds_alternative<std::string>(other);
        if (texts) {
          value = std::get<std::string>(value) + std::get<std::string>(other);
          if (std::get<std::string>(value).size() > kMostText)
            throw ExpressionError("its text is longer than 64 kB");
        } else {
          value = number_of(value) + number_of(other);
        }
      } else if (take("-")) {
        value = number_of(value) - number_of(product());
      } else {
        return value;
      }
    }
  }

  Value product() {
    Value value = signed_power();
    for (;;) {
      skip_space();
      if (text_.substr(at_, 2) == "**") return value;
      if (take("//")) {
        value = std::floor(quotient(value, signed_power()));
      } else if (take("*")) {
        value = number_of(value) * number_of(signed_power());
      } else if (take("/")) {
        value = quotient(value, signed_power());
      } else if (take("%")) {
        const Value other = signed_power();
        const double by = number_of(other);
        value = number_of(value) - by * std::floor(quotient(value, other));
      } else {
        return value;
      }
    }
  }

  static double quotient(const Value& left, const Value& right) {
    const double by = number_of(right);
    if (by == 0) throw ExpressionError("it divides by zero");
    return number_of(left) / by;
  }

  Value signed_power() {
    if (++depth_ > kMostNesting) throw ExpressionError("its signs are too many");
    Value value = 0.0;
    if (take("-")) {
      value = -number_of(signed_power());
    } else if (take("+")) {
      value = number_of(signed_power());
    } else {
      value = atom();
      if (take("**")) value = std::pow(number_of(value), number_of(signed_power()));
    }
    --depth_;
    return value;
  }

  Value atom() {
    skip_space();
    if (at_ == text_.size()) throw ExpressionError("it ends too early");
    const char c = text_[at_];
    if (c == '\'' || c == '"') return quoted(c);
    if (take("(")) {
      const Value value = choice();
      if (!take(")")) throw ExpressionError("a bracket is not closed");
      return value;
    }
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.') return number();
    if (is_of_name(c)) return name();
    throw ExpressionError(fmt::format("'{}' is not understood", text_.substr(at_)));
  }

  Value quoted(char mark) {
    const std::size_t end = text_.find(mark, at_ + 1);
    if (end == std::string_view::npos) throw ExpressionError("a quote is not closed");
    std::string text(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return text;
  }

  Value number() {
    std::size_t end = at_;
    while (end < text_.size() && (is_of_name(text_[end]) || text_[end] == '.' ||
                                  ((text_[end] == '-' || text_[end] == '+') &&
                                   (text_[end - 1] == 'e' || text_[end - 1] == 'E')))) {
      ++end;
    }
    const auto found = model::parse_number(text_.substr(at_, end - at_));
    if (!found)
      throw ExpressionError(fmt::format("'{}' is no number", text_.substr(at_, end - at_)));
    at_ = end;
    return *found;
  }

  Value name() {
    std::size_t end = at_;
    while (end < text_.size() && (is_of_name(text_[end]) || text_[end] == '.')) ++end;
    std::string word(text_.substr(at_, end - at_));
    at_ = end;
    if (word.rfind("math.", 0) == 0) word = word.substr(5);
    if (take("(")) return call(word, arguments());
    if (word == "True" || word == "true") return 1.0;
    if (word == "False" || word == "false") return 0.0;
    if (word == "pi") return std::numbers::pi;
    return look_up_(word);
  }

  Arguments arguments() {
    Arguments out;
    if (take(")")) return out;
    do {
      out.push_back(choice());
    } while (take(","));
    if (!take(")")) throw ExpressionError("a bracket is not closed");
    return out;
  }

  std::string_view text_;
  const Look& look_up_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::string text_of(const Value& value) {
  if (const std::string* const text = std::get_if<std::string>(&value)) return *text;
  return fmt::format("{:.15g}", std::get<double>(value));
}

bool is_true(const Value& value) {
  if (const double* const number = std::get_if<double>(&value)) return *number != 0;
  const std::string& text = std::get<std::string>(value);
  return !text.empty() && text != "false" && text != "False" && text != "0";
}

Value value_of(const std::string& text) {
  if (const auto number = model::parse_number(text)) return *number;
  if (text == "true" || text == "True") return 1.0;
  if (text == "false" || text == "False") return 0.0;
  return text;
}

Value evaluate(std::string_view expression, const Look& look_up) {
  return Parser(expression, look_up).parse();
}

}  // namespace verp::xacro
