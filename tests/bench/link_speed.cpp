#include "tests/bench/link_speed.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>
#include <vector>

#include "common/control/state.hpp"
#include "common/record/tick_record.hpp"
#include "firmware/app/link_messages.hpp"
#include "host/boards/board/board_error.hpp"
#include "host/boards/board/fifo_link.hpp"
#include "host/boards/board/qemu.hpp"

namespace verp::board {
namespace {

constexpr std::size_t kAnswerBytes = 200;

class Echo {
 public:
  Echo(FifoLink& link, const Params& params, std::uint32_t ticks)
      : link_(link), params_(params), ticks_(ticks) {}

  std::uint64_t serve() {
    while (!quit_) take_message();
    return polls_;
  }

 private:
  void need(std::size_t size) {
    while (end_ - begin_ < size) {
      std::memmove(inbox_.data(), inbox_.data() + begin_, end_ - begin_);
      end_ -= begin_;
      begin_ = 0;
      const std::size_t count =
          link_.read_some(inbox_.data() + end_, inbox_.size() - end_, kSilence);
      if (count == 0) throw BoardError("the board closed the link in mid-run; rebuild its image");
      end_ += count;
    }
  }

  void take_message() {
    link::MessageHeader header;
    need(sizeof header);
    std::memcpy(&header, inbox_.data() + begin_, sizeof header);
    need(sizeof header + header.size);
    begin_ += sizeof header + header.size;
    if (header.kind == link::Kind::kHello) answer_hello();
    if (header.kind == link::Kind::kPoll) answer_poll();
    quit_ = header.kind == link::Kind::kQuit;
  }

  void answer_hello() {
    const link::HelloReply reply{.params_size = sizeof(Params), .ticks = ticks_, .state_every = 0};
    link_.write(&reply, sizeof reply);
    link_.write(&params_, sizeof params_);
  }

  void answer_poll() {
    std::uint8_t answer[sizeof(link::PollReply) + kAnswerBytes] = {};
    link::PollReply reply;
    reply.now_us = ++polls_;
    reply.size = kAnswerBytes;
    std::memcpy(answer, &reply, sizeof reply);
    link_.write(answer, sizeof answer);
  }

  FifoLink& link_;
  const Params& params_;
  std::uint32_t ticks_;
  std::vector<std::uint8_t> inbox_ = std::vector<std::uint8_t>(65536 + sizeof(link::MessageHeader));
  std::size_t begin_ = 0, end_ = 0;
  std::uint64_t polls_ = 0;
  bool quit_ = false;
};

/// Sends back each frame until the pipe ends.
[[noreturn]] void answer_frames(int from, int to) {
  std::array<std::uint8_t, kAnswerBytes> frame;
  while (read(from, frame.data(), frame.size()) == static_cast<ssize_t>(frame.size()) &&
         write(to, frame.data(), frame.size()) == static_cast<ssize_t>(frame.size())) {
  }
  _exit(0);
}

std::array<int, 2> open_pipe() {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw BoardError("can't make a pipe");
  return ends;
}

}  // namespace

OneCore::OneCore() {
  sched_getaffinity(0, sizeof before_, &before_);
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(sched_getcpu(), &one);
  sched_setaffinity(0, sizeof one, &one);
}

OneCore::~OneCore() {
  sched_setaffinity(0, sizeof before_, &before_);
}

double measure_pipes(std::uint32_t round_trips) {
  const auto there = open_pipe(), back = open_pipe();
  const pid_t child = fork();
  if (child < 0) throw BoardError("can't start a second process");
  if (child == 0) {
    close(there[1]);
    answer_frames(there[0], back[1]);
  }
  std::array<std::uint8_t, kAnswerBytes> frame{};
  const auto start = std::chrono::steady_clock::now();
  bool whole = true;
  for (std::uint32_t i = 0; i < round_trips && whole; ++i) {
    whole = write(there[1], frame.data(), frame.size()) == static_cast<ssize_t>(frame.size()) &&
            read(back[0], frame.data(), frame.size()) == static_cast<ssize_t>(frame.size());
  }
  const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start;
  for (const int end : {there[0], there[1], back[0], back[1]}) close(end);
  waitpid(child, nullptr, 0);
  if (!whole) throw BoardError("a pipe lost a frame");
  return round_trips / used.count();
}

LinkSpeed measure_link(const std::string& board, const Params& params, std::uint32_t ticks,
                       bool with_step) {
  const EmulatedBoard& emulated = find_emulated_board(board);
  FifoLink link;
  std::vector<std::string> arguments = {link.to_board().string(), link.from_board().string()};
  if (with_step) arguments.push_back("step");
  QemuProcess firmware(
      {.board = emulated, .image = firmware_image(emulated, "link"), .arguments = arguments});
  link.connect(firmware, kStart);
  const auto start = std::chrono::steady_clock::now();
  const std::uint64_t polls = Echo(link, params, ticks).serve();
  const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start;
  return {.ticks_per_s = ticks / used.count(),
          .round_trips_per_s = static_cast<double>(polls) / used.count()};
}

}  // namespace verp::board
