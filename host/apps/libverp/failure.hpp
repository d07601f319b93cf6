#pragma once
#include <concepts>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "host/apps/libverp/verp.h"

namespace verp::abi {

/// Why a call gives another status than VERP_OK.
class Failure : public std::runtime_error {
 public:
  Failure(verp_status status, const std::string& why) : std::runtime_error(why), status_(status) {}
  verp_status status() const { return status_; }

 private:
  verp_status status_;
};

/// Keeps the exception that is being handled as this thread's last error, and gives its status.
int fail(const char* function) noexcept;

/// A function of the ABI: no exception leaves it. A body that gives no status gives VERP_OK.
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

/// Throw Failure for an argument that is null, a text that is empty, or a struct of another size.
void need(const void* argument, const char* name);
void need_text(const char* text, const char* name);
/// Null stands for none, and an empty text for a mistake.
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
/// One of a whole struct's bytes.
void need_size(std::uint64_t size, std::uint64_t wanted, const char* name);
/// A finite number.
double finite(double value, const char* name);

}  // namespace verp::abi
