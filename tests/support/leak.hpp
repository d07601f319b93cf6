#pragma once
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define VERP_FINDS_LEAKS
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define VERP_FINDS_LEAKS
#endif
#ifdef VERP_FINDS_LEAKS
#include <sanitizer/lsan_interface.h>
#endif

namespace verp::test {

/// Allowed leaks of a third-party library. The name says which and why.
struct SomebodyElsesLeak {
#ifdef VERP_FINDS_LEAKS
  SomebodyElsesLeak() {
    __lsan_disable();
  }
  ~SomebodyElsesLeak() {
    __lsan_enable();
  }
#else
  SomebodyElsesLeak() {}
  ~SomebodyElsesLeak() {}
#endif
  SomebodyElsesLeak(const SomebodyElsesLeak&) = delete;
  SomebodyElsesLeak& operator=(const SomebodyElsesLeak&) = delete;
};

}  // namespace verp::test
