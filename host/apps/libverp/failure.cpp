#include "host/apps/libverp/failure.hpp"

#include <cmath>

#include "host/robot/model/load_error.hpp"
#include "host/trace/record/trace_error.hpp"

namespace verp::abi {
namespace {

thread_local std::string last_error;

verp_status status_of_current(std::string& why) {
  try {
    throw;
  } catch (const Failure& error) {
    why = error.what();
    return error.status();
  } catch (const model::LoadError& error) {
    why = error.what();
    return VERP_BAD_FILE;
  } catch (const record::TraceError& error) {
    why = error.what();
    return VERP_BAD_FILE;
  } catch (const std::invalid_argument& error) {
    why = error.what();
    return VERP_BAD_ARGUMENT;
  } catch (const std::exception& error) {
    why = error.what();
    return VERP_FAILED;
  } catch (...) {
    why = "something that is no std::exception was thrown";
    return VERP_FAILED;
  }
}

}  // namespace

int fail(const char* function) noexcept {
  try {
    std::string why;
    const verp_status status = status_of_current(why);
    last_error = std::string(function) + ": " + why;
    return status;
  } catch (...) {  // no memory for a message
    last_error.clear();
    return VERP_FAILED;
  }
}

void need(const void* argument, const char* name) {
  if (argument == nullptr) throw Failure(VERP_BAD_ARGUMENT, std::string(name) + " is null");
}

void need_text(const char* text, const char* name) {
  need(text, name);
  if (*text == '\0') throw Failure(VERP_BAD_ARGUMENT, std::string(name) + " is empty");
}

void need_text_or_null(const char* text, const char* name) {
  if (text != nullptr) need_text(text, name);
}

void need_size(std::uint64_t size, std::uint64_t wanted, const char* name) {
  if (size == wanted) return;
  throw Failure(VERP_BAD_ARGUMENT, std::string(name) + " is of " + std::to_string(size) +
                                       " bytes, not " + std::to_string(wanted));
}

double finite(double value, const char* name) {
  if (std::isfinite(value)) return value;
  throw Failure(VERP_BAD_ARGUMENT, std::string(name) + " is not a finite number");
}

}  // namespace verp::abi

const char* verp_last_error(void) {
  return verp::abi::last_error.c_str();
}
