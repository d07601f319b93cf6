#include "host/apps/libverp/handles.hpp"

#include <pthread.h>

#include <atomic>

namespace verp::abi {
namespace {

std::atomic<unsigned> passed_forks = 0;

}  // namespace

unsigned forks() {
  // The C library reports forks: a getpid() system call would take longer than a tick.
  static const int told = pthread_atfork(nullptr, nullptr, [] { ++passed_forks; });
  static_cast<void>(told);
  return passed_forks;
}

}  // namespace verp::abi
