#include "host/run/session/flow.hpp"

#include <sys/mman.h>

#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define VERP_ADDRESS_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define VERP_ADDRESS_SANITIZER
#endif
#ifdef VERP_ADDRESS_SANITIZER
#include <sanitizer/common_interface_defs.h>
#endif

namespace verp::session {
namespace {

#ifdef VERP_ADDRESS_SANITIZER
constexpr std::size_t kStack_bytes = 1 << 20;  // cleared at each switch by the sanitizer
#else
constexpr std::size_t kStack_bytes = 8 << 20;  // as for a thread
#endif
constexpr std::size_t kGuard_bytes = 1 << 16;

// For the sanitizer. `keep` null: the stack ends.
void leave_stack([[maybe_unused]] void** keep, [[maybe_unused]] const void* bottom,
                 [[maybe_unused]] std::size_t bytes) {
#ifdef VERP_ADDRESS_SANITIZER
  __sanitizer_start_switch_fiber(keep, bottom, bytes);
#endif
}
void enter_stack([[maybe_unused]] void* kept, [[maybe_unused]] const void** from,
                 [[maybe_unused]] std::size_t* bytes) {
#ifdef VERP_ADDRESS_SANITIZER
  __sanitizer_finish_switch_fiber(kept, from, bytes);
#endif
}

}  // namespace

Flow::Stack::Stack()
    : memory_(::mmap(nullptr, kGuard_bytes + kStack_bytes, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0)) {
  if (memory_ == MAP_FAILED || ::mprotect(memory_, kGuard_bytes, PROT_NONE) != 0)
    throw std::system_error(errno, std::generic_category(), "no memory for a robot's stack");
}

Flow::Stack::~Stack() {
  ::munmap(memory_, kGuard_bytes + kStack_bytes);
}

void* Flow::Stack::bottom() const {
  return static_cast<std::byte*>(memory_) + kGuard_bytes;
}

Flow::~Flow() {
  if (stack_ == nullptr || ended_) return;
  unwinding_ = true;
  go();
}

bool Flow::resume() {
  if (ended_) return false;
  if (stack_ == nullptr) begin();
  go();
  while (outside_ != nullptr) {
    try {
      (*outside_)();
    } catch (...) {
      error_ = std::current_exception();
    }
    outside_ = nullptr;
    go();
  }
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return !ended_;
}

void Flow::begin() {
  stack_ = std::make_unique<Stack>();
  ::getcontext(&there_);
  there_.uc_stack.ss_sp = stack_->bottom();
  there_.uc_stack.ss_size = kStack_bytes;
  there_.uc_link = &here_;
  const auto self = reinterpret_cast<std::uintptr_t>(this);
  // makecontext() passes only ints.
  ::makecontext(&there_, reinterpret_cast<void (*)()>(&Flow::enter), 2,
                static_cast<unsigned>(std::uint64_t{self} >> 32), static_cast<unsigned>(self));
}

void Flow::enter(unsigned high, unsigned low) {
  auto* flow = reinterpret_cast<Flow*>(
      static_cast<std::uintptr_t>((std::uint64_t{high} << 32) | std::uint64_t{low}));
  enter_stack(nullptr, &flow->caller_bottom_, &flow->caller_bytes_);
  flow->run();
  leave_stack(nullptr, flow->caller_bottom_, flow->caller_bytes_);
}

void Flow::go() {
  leave_stack(&fake_here_, stack_->bottom(), kStack_bytes);
  ::swapcontext(&here_, &there_);
  enter_stack(fake_here_, nullptr, nullptr);
}

void Flow::back() {
  leave_stack(&fake_there_, caller_bottom_, caller_bytes_);
  ::swapcontext(&there_, &here_);
  enter_stack(fake_there_, &caller_bottom_, &caller_bytes_);
}

void Flow::run() {
  try {
    body_(*this);
  } catch (const Unwound&) {
  } catch (...) {
    error_ = std::current_exception();
  }
  ended_ = true;
}

void Flow::pause() {
  if (unwinding_) return;  // called by a destructor
  back();
  if (unwinding_) throw Unwound{};
}

void Flow::outside(const std::function<void()>& call) {
  outside_ = &call;
  back();
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

}  // namespace verp::session
