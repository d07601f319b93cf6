#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <type_traits>
#include <vector>

/// The part of GoogleTest that the tests use, without exceptions. The program supplies
/// testing::put() and calls testing::run_all(); tests with fixtures need a heap.
namespace testing {

/// `text` may hold part of a line.
void put(const char* text);

/// A line; excess text is cut off.
class Message {
 public:
  Message& operator<<(const char* text) {
    for (; *text != 0 && size_ + 1 < sizeof text_; ++text) text_[size_++] = *text;
    text_[size_] = 0;
    return *this;
  }
  template <class T>
  Message& operator<<(const T& value) {
    char buffer[32];
    if constexpr (std::is_same_v<T, bool>) {
      return *this << (value ? "true" : "false");
    } else if constexpr (std::is_same_v<T, char>) {
      std::snprintf(buffer, sizeof buffer, "%c", value);
    } else if constexpr (std::is_enum_v<T>) {
      return *this << static_cast<std::underlying_type_t<T>>(value);
    } else if constexpr (std::is_floating_point_v<T>) {
      std::snprintf(buffer, sizeof buffer, sizeof(T) == 4 ? "%.9g" : "%.17g",
                    static_cast<double>(value));
    } else if constexpr (std::is_integral_v<T> && std::is_signed_v<T>) {
      std::snprintf(buffer, sizeof buffer, "%lld", static_cast<long long>(value));
    } else if constexpr (std::is_integral_v<T>) {
      std::snprintf(buffer, sizeof buffer, "%llu", static_cast<unsigned long long>(value));
    } else if constexpr (std::is_null_pointer_v<T>) {
      return *this << "nullptr";
    } else if constexpr (std::is_convertible_v<const T&, const char*>) {
      return *this << static_cast<const char*>(value);
    } else if constexpr (std::is_pointer_v<T>) {
      std::snprintf(buffer, sizeof buffer, "%p", static_cast<const void*>(value));
    } else {
      std::snprintf(buffer, sizeof buffer, "<%u bytes>", static_cast<unsigned>(sizeof(T)));
    }
    return *this << static_cast<const char*>(buffer);
  }
  const char* text() const { return text_; }

 private:
  char text_[512] = {};
  std::size_t size_ = 0;
};

/// Its constructor links it into a list before the program starts.
struct Case {
  Case(const char* suite_name, const char* case_name, void (*test_body)(), int type_number = -1)
      : suite(suite_name), name(case_name), body(test_body), type(type_number) {
    *tail = this;
    tail = &next;
  }
  const char* suite;
  const char* name;
  void (*body)();
  int type;  ///< -1: not typed
  Case* next = nullptr;

  static inline Case* first = nullptr;
  static inline Case** tail = &first;
  static inline int failures = 0;
};

class Test {};

template <class Value>
struct TestParamInfo {
  Value param;
};
template <class Value>
class TestWithParam : public Test {
 public:
  using ParamType = Value;
  static const Value& GetParam() { return *now; }
  static inline const Value* now = nullptr;
};
template <class First, class... More>
constexpr std::array<First, 1 + sizeof...(More)> Values(First first, More... more) {
  return {first, more...};
}
/// A suite's parameters; a test runs with each in turn.
template <class Suite>
struct Instances {
  template <class List>
  explicit Instances(const List& list) {
    all.insert(all.end(), list.begin(), list.end());
  }
  static inline std::vector<typename Suite::ParamType> all;
};

/// A fixture may be larger than the stack.
template <class Body>
void run_fixture() {
  auto* const test = new Body;
  test->body();
  delete test;
}
template <class Suite, class Body>
void run_instances() {
  if (Instances<Suite>::all.empty()) ++Case::failures;
  for (const auto& each : Instances<Suite>::all) {
    Suite::now = &each;
    run_fixture<Body>();
  }
}

template <class... Type>
struct Types {};

template <template <class> class Body, class List>
struct TypedCases;
template <template <class> class Body, class... Type>
struct TypedCases<Body, Types<Type...>> {
  TypedCases(const char* suite, const char* name)
      : cases{Case(suite, name, &Body<Type>::run, number++)...} {}
  int number = 0;
  Case cases[sizeof...(Type)];
};

/// Builds its message only on failure.
class Outcome {
 public:
  explicit Outcome(bool good) : good_(good) {}
  explicit operator bool() const { return good_; }
  template <class... Parts>
  Outcome& because(const Parts&... parts) {
    (message_ << ... << parts);
    return *this;
  }
  const char* text() const { return message_.text(); }

 private:
  bool good_;
  Message message_;
};

/// `Failure(...) = Message() << words` prints a failure.
class Failure {
 public:
  Failure(const char* file, int line, const char* what) : file_(file), line_(line), what_(what) {}
  void operator=(const Message& words) const {
    ++Case::failures;
    Message line;
    line << file_ << ":" << line_ << ": Failure\n" << what_ << "\n";
    put(line.text());
    put(words.text());
    put("\n");
  }

 private:
  const char* file_;
  int line_;
  const char* what_;
};

template <class A, class B, class Good>
Outcome compare(const char* a_text, const char* relation, const char* b_text, const A& a,
                const B& b, Good good) {
  Outcome outcome(good(a, b));
  if (!outcome) {
    outcome.because("Expected: (", a_text, ") ", relation, " (", b_text, "), actual: ", a, " vs ",
                    b);
  }
  return outcome;
}

inline Outcome near(const char* a_text, const char* b_text, double a, double b, double tolerance) {
  const double difference = std::fabs(a - b);
  Outcome outcome(difference <= tolerance);
  if (!outcome) {
    outcome.because("The difference between ", a_text, " and ", b_text, " is ", difference,
                    ", beyond ", tolerance, ": ", a, " vs ", b);
  }
  return outcome;
}

/// Within four units in the last place.
template <class Float, class Bits>
Outcome almost_equal(const char* a_text, const char* b_text, Float a, Float b) {
  constexpr Bits kSign = Bits{1} << (sizeof(Bits) * 8 - 1);
  const auto order = [](Float value) {
    Bits bits;
    std::memcpy(&bits, &value, sizeof bits);
    return (bits & kSign) != 0 ? static_cast<Bits>(~bits + 1) : static_cast<Bits>(bits | kSign);
  };
  const Bits p = order(a);
  const Bits q = order(b);
  Outcome outcome(a == a && b == b && (p > q ? p - q : q - p) <= 4);
  if (!outcome) outcome.because(a_text, " is not ", b_text, ": ", a, " vs ", b);
  return outcome;
}

inline Outcome truth(const char* text, bool actual, bool expected) {
  Outcome outcome(actual == expected);
  if (!outcome) outcome.because("Value of: ", text, "\nExpected: ", expected);
  return outcome;
}

inline Message full_name(const Case& test) {
  Message full;
  full << test.suite;
  if (test.type >= 0) full << "/" << test.type;
  full << "." << test.name;
  return full;
}

/// Returns the failures, or 1 if no test ran.
inline int run_all(const char* filter) {
  int run = 0;
  int failed = 0;
  for (const Case* test = Case::first; test != nullptr; test = test->next) {
    Message line = full_name(*test);
    if (std::strstr(line.text(), filter) == nullptr) continue;
    line << "\n";
    put("[ RUN      ] ");
    put(line.text());
    Case::failures = 0;
    test->body();
    ++run;
    if (Case::failures != 0) ++failed;
    put(Case::failures != 0 ? "[  FAILED  ] " : "[       OK ] ");
    put(line.text());
  }
  Message total;
  total << "[==========] " << run << " tests ran.\n[  PASSED  ] " << run - failed << " tests.\n";
  if (failed != 0) total << "[  FAILED  ] " << failed << " tests.\n";
  put(total.text());
  return run == 0 ? 1 : failed;
}

}  // namespace testing

#define TEST(suite, name)                                                              \
  static void suite##_##name##_body();                                                 \
  static ::testing::Case suite##_##name##_case(#suite, #name, &suite##_##name##_body); \
  static void suite##_##name##_body()

#define TYPED_TEST_SUITE(suite, types) using suite##_types = types
#define VERP_FIXTURE_(suite, name, runner)                              \
  struct suite##_##name : suite {                                       \
    void body();                                                        \
  };                                                                    \
  static ::testing::Case suite##_##name##_case(#suite, #name, &runner); \
  void suite##_##name::body()
#define TEST_F(suite, name) VERP_FIXTURE_(suite, name, (::testing::run_fixture<suite##_##name>))
#define TEST_P(suite, name) \
  VERP_FIXTURE_(suite, name, (::testing::run_instances<suite, suite##_##name>))
// Names of the parameters are left out.
#define INSTANTIATE_TEST_SUITE_P(prefix, suite, values, ...) \
  static const ::testing::Instances<suite> suite##_instances##prefix(values)

#define TYPED_TEST(suite, name)                                                              \
  template <class TypeParam>                                                                 \
  struct suite##_##name : suite<TypeParam> {                                                 \
    static void run() { ::testing::run_fixture<suite##_##name>(); }                          \
    void body();                                                                             \
  };                                                                                         \
  static ::testing::TypedCases<suite##_##name, suite##_types> suite##_##name##_cases(#suite, \
                                                                                     #name); \
  template <class TypeParam>                                                                 \
  void suite##_##name<TypeParam>::body()

// Keeps a caller's dangling `else` from binding to ours.
#define VERP_CHECK_(outcome_expression, on_failure)                                 \
  switch (0)                                                                        \
  case 0:                                                                           \
  default:                                                                          \
    if (const ::testing::Outcome verp_outcome = (outcome_expression); verp_outcome) \
      ;                                                                             \
    else                                                                            \
      on_failure ::testing::Failure(__FILE__, __LINE__, verp_outcome.text()) = ::testing::Message()

#define VERP_TRUE_(a, expected) ::testing::truth(#a, static_cast<bool>(a), expected)
#define VERP_COMPARE_(a, relation, b)         \
  ::testing::compare(#a, #relation, #b, a, b, \
                     [](const auto& x, const auto& y) { return x relation y; })
#define VERP_NEAR_(a, b, tolerance)                                       \
  ::testing::near(#a, #b, static_cast<double>(a), static_cast<double>(b), \
                  static_cast<double>(tolerance))
#define VERP_TEXT_(a, b)                 \
  ::testing::compare(#a, "==", #b, a, b, \
                     [](const char* x, const char* y) { return std::strcmp(x, y) == 0; })
#define VERP_FLOAT_(a, b) ::testing::almost_equal<float, std::uint32_t>(#a, #b, a, b)
#define VERP_DOUBLE_(a, b) ::testing::almost_equal<double, std::uint64_t>(#a, #b, a, b)

#define EXPECT_TRUE(a) VERP_CHECK_(VERP_TRUE_(a, true), )
#define EXPECT_FALSE(a) VERP_CHECK_(VERP_TRUE_(a, false), )
#define EXPECT_EQ(a, b) VERP_CHECK_(VERP_COMPARE_(a, ==, b), )
#define EXPECT_NE(a, b) VERP_CHECK_(VERP_COMPARE_(a, !=, b), )
#define EXPECT_LT(a, b) VERP_CHECK_(VERP_COMPARE_(a, <, b), )
#define EXPECT_LE(a, b) VERP_CHECK_(VERP_COMPARE_(a, <=, b), )
#define EXPECT_GT(a, b) VERP_CHECK_(VERP_COMPARE_(a, >, b), )
#define EXPECT_GE(a, b) VERP_CHECK_(VERP_COMPARE_(a, >=, b), )
#define EXPECT_NEAR(a, b, tolerance) VERP_CHECK_(VERP_NEAR_(a, b, tolerance), )
#define EXPECT_FLOAT_EQ(a, b) VERP_CHECK_(VERP_FLOAT_(a, b), )
#define EXPECT_DOUBLE_EQ(a, b) VERP_CHECK_(VERP_DOUBLE_(a, b), )
#define EXPECT_STREQ(a, b) VERP_CHECK_(VERP_TEXT_(a, b), )
#define ADD_FAILURE() VERP_CHECK_(::testing::Outcome(false).because("Failed"), )

#define ASSERT_TRUE(a) VERP_CHECK_(VERP_TRUE_(a, true), return )
#define ASSERT_FALSE(a) VERP_CHECK_(VERP_TRUE_(a, false), return )
#define ASSERT_EQ(a, b) VERP_CHECK_(VERP_COMPARE_(a, ==, b), return )
#define ASSERT_NE(a, b) VERP_CHECK_(VERP_COMPARE_(a, !=, b), return )
#define ASSERT_LT(a, b) VERP_CHECK_(VERP_COMPARE_(a, <, b), return )
#define ASSERT_LE(a, b) VERP_CHECK_(VERP_COMPARE_(a, <=, b), return )
#define ASSERT_GT(a, b) VERP_CHECK_(VERP_COMPARE_(a, >, b), return )
#define ASSERT_GE(a, b) VERP_CHECK_(VERP_COMPARE_(a, >=, b), return )
#define ASSERT_NEAR(a, b, tolerance) VERP_CHECK_(VERP_NEAR_(a, b, tolerance), return )
#define ASSERT_FLOAT_EQ(a, b) VERP_CHECK_(VERP_FLOAT_(a, b), return )
#define ASSERT_DOUBLE_EQ(a, b) VERP_CHECK_(VERP_DOUBLE_(a, b), return )
#define ASSERT_STREQ(a, b) VERP_CHECK_(VERP_TEXT_(a, b), return )
#define FAIL() VERP_CHECK_(::testing::Outcome(false).because("Failed"), return )
#define SCOPED_TRACE(words) static_cast<void>(words)
#define SUCCEED() static_cast<void>(0)
