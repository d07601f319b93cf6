#include <dlfcn.h>
#include <elf.h>
#include <sys/ptrace.h>
#include <sys/types.h>
#include <sys/uio.h>

#include <cerrno>
#include <cstdarg>
#include <cstring>

/// with-can loads this into Debian 12's User-Mode Linux, which keeps 2696 bytes of extended
/// registers (HOST_FP_SIZE, arch/x86/um/user-offsets.c of Linux 6.1): all before AMX. If the PC has
/// more, ptrace accepts only the whole set (xstateregs_set, arch/x86/kernel/fpu/regset.c), and the
/// virtual machine would end. So its bytes are written over the process's whole set.

namespace {

using Ptrace = long (*)(int, pid_t, void*, void*);

constexpr std::size_t kMost = 65536;     // AMX: 11008
alignas(64) unsigned char whole[kMost];  // a kernel's stacks are small

long set_registers(Ptrace original, pid_t process, void* kind, void* data) {
  static std::size_t all_there_is = sizeof whole;  // equal for all processes
  auto* part = static_cast<iovec*>(data);
  iovec all{whole, all_there_is};
  if (part->iov_len < all_there_is && original(PTRACE_GETREGSET, process, kind, &all) != 0)
    return -1;
  all_there_is = all.iov_len;
  if (part->iov_len >= all_there_is) return original(PTRACE_SETREGSET, process, kind, data);
  std::memcpy(whole, part->iov_base, part->iov_len);
  return original(PTRACE_SETREGSET, process, kind, &all);
}

}  // namespace

extern "C" long ptrace(enum __ptrace_request request, ...) {
  static const auto original = reinterpret_cast<Ptrace>(::dlsym(RTLD_NEXT, "ptrace"));
  va_list list;
  va_start(list, request);
  const pid_t process = va_arg(list, pid_t);
  void* const address = va_arg(list, void*);
  void* const data = va_arg(list, void*);
  va_end(list);
  if (request == PTRACE_SETREGSET &&
      address == reinterpret_cast<void*>(std::size_t{NT_X86_XSTATE})) {
    return set_registers(original, process, address, data);
  }
  return original(request, process, address, data);
}
