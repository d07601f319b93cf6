#pragma once
#include <concepts>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "host/apps/libverp/verp.h"

namespace verp::abi {

class Failure : public std::runtime_error {
 public:
  Failure(verp_status status, const std::string& why) : std::runtime_error(why), status_(status) {}
  verp_status status() const { return status_; }

 private:
  verp_status status_;
};

/// Makes the current exception this thread's last error; returns its status.
int fail(const char* function) noexcept;

/// No exception leaves an ABI function's body. Without a result: VERP_OK.
template <std::invocable Body>
int call(const char* function, Body body) noexcept {
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Body>>) {
      body();
      return VERP_OK;
    } else {
      return body();
    }
  } catch (...) {
    return fail(function);
  }
}

/// Throw Failure for a null argument, an empty text, or a struct of another size.
void need(const void* argument, const char* name);
void need_text(const char* text, const char* name);
void need_text_or_null(const char* text, const char* name);
template <class Struct>
void need_struct(const Struct* argument, const char* name) {
  need(argument, name);
  if (argument->size == sizeof(Struct)) return;
  throw Failure(VERP_BAD_ARGUMENT,
                std::string(name) + "->size is " + std::to_string(argument->size) + ", not " +
                    std::to_string(sizeof(Struct)) +
                    "; set it to sizeof, and compile against this library's verp.h");
}
void need_size(std::uint64_t size, std::uint64_t wanted, const char* name);
double finite(double value, const char* name);

}  // namespace verp::abi
