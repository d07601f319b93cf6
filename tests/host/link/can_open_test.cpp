#include <gtest/gtest.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <string>

#include "host/os/link/can_port.hpp"
#include "host/os/link/link.hpp"

// A kernel that refuses CAN sockets. tests/can covers vcan.

namespace verp::link {
namespace {

bool refuse_can_sockets(int error) {
  sock_filter rules[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, __NR_socket, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[0])),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AF_CAN, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | static_cast<unsigned>(error)),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{sizeof rules / sizeof rules[0], rules};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

std::string refusal(int error, const std::string& link) {
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    std::string text = "no filter";
    try {
      if (refuse_can_sockets(error)) {
        text = "opened";
        const CanPort port(parse_endpoint(link));
      }
    } catch (const LinkError& caught) {
      text = std::to_string(static_cast<int>(caught.kind())) + " " + caught.what();
    }
    const ssize_t written = ::write(ends[1], text.data(), text.size());
    ::_exit(written < 0 ? 1 : 0);
  }
  ::close(ends[1]);
  char text[512];
  const ssize_t count = ::read(ends[0], text, sizeof text);
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return {text, count > 0 ? static_cast<std::size_t>(count) : 0};
}

std::string with_kind(LinkError::Kind kind, const std::string& text) {
  return std::to_string(static_cast<int>(kind)) + " " + text;
}

TEST(OpenCan, NamesAKernelWithoutCanSockets) {
  EXPECT_EQ(refusal(EAFNOSUPPORT, "can:vcan0"),
            with_kind(LinkError::Kind::kUnsuitable,
                      "can:vcan0: this kernel has no CAN sockets; sudo modprobe can-raw, or use "
                      "one that is built with CONFIG_CAN"));
}

TEST(OpenCan, NamesAUserWhoMayNot) {
  for (const int error : {EPERM, EACCES}) {
    EXPECT_EQ(refusal(error, "can:can0"),
              with_kind(LinkError::Kind::kPermission,
                        "can:can0: no permission; ask for CAP_NET_RAW, or use sudo"));
  }
}

TEST(OpenCan, IsNoStreamOfBytes) {
  try {
    const Link link(parse_endpoint("can:can0"));
    FAIL() << "opened";
  } catch (const LinkError& error) {
    EXPECT_EQ(error.kind(), LinkError::Kind::kUnsuitable);
    EXPECT_NE(std::string(error.what()).find("frames, not a stream of bytes"), std::string::npos);
  }
}

// A wrong rate gives only error frames.
TEST(CanBitRate, OfAnotherRobotIsToldWithTheRemedy) {
  CanInterface interface;
  interface.name = "can3";
  interface.bitrate = 500'000;
  EXPECT_EQ(bit_rate_trouble(interface, "generic21", 1'000'000),
            "can3 runs at 500000 bit/s, the bus of generic21 at 1000000; ip link set can3 down && "
            "ip link set can3 up type can bitrate 1000000, or change baud in <verp:bus>");
  EXPECT_EQ(bit_rate_trouble(interface, "generic21", 500'000), "");
  interface.bitrate = 0;  // vcan, or a rate set elsewhere
  EXPECT_EQ(bit_rate_trouble(interface, "generic21", 1'000'000), "");
}

}  // namespace
}  // namespace verp::link
