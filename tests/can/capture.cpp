#include "tests/can/capture.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

namespace verp::test {
namespace {

namespace fs = std::filesystem;

/// In the order of decode().
constexpr const char* kFields[] = {"can.id",
                                   "_ws.col.Info",
                                   "canopen.node_id",
                                   "canopen.sync.counter",
                                   "canopen.nmt_ctrl.cd",
                                   "canopen.nmt_ctrl.node_id",
                                   "canopen.nmt_guard.state",
                                   "canopen.em.err_code",
                                   "canopen.em.err_reg",
                                   "canopen.sdo.main_idx",
                                   "canopen.sdo.sub_idx",
                                   "canopen.sdo.abort_code",
                                   "canopen.pdo.data.bytes",
                                   "canopen.sdo.data.bytes",
                                   "data.data"};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

int run(std::vector<std::string> words, const fs::path& output) {
  return process::Child({.words = std::move(words),
                         .input = {},
                         .output = {.file = output},
                         .error = process::Stream{}})
      .wait();
}

std::optional<std::uint32_t> number(const std::string& text) {
  if (text.empty()) return std::nullopt;
  return static_cast<std::uint32_t>(std::stoul(text, nullptr, 0));
}

std::vector<std::uint8_t> bytes(const std::string& hex) {
  std::vector<std::uint8_t> all;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    all.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
  }
  return all;
}

Decoded decode_line(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, '\t');) cells.push_back(cell);
  cells.resize(std::size(kFields));
  Decoded frame;
  frame.id = number(cells[0]).value_or(0);
  frame.info = cells[1];
  std::size_t next = 2;
  for (auto* member :
       {&frame.node, &frame.sync, &frame.command, &frame.commanded, &frame.state, &frame.error_code,
        &frame.error_register, &frame.index, &frame.subindex, &frame.abort_code}) {
    *member = number(cells[next++]);
  }
  for (; frame.data.empty() && next < cells.size(); ++next) frame.data = bytes(cells[next]);
  return frame;
}

}  // namespace

std::uint32_t Decoded::value(std::size_t place, std::size_t count) const {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= std::uint32_t{data.at(place + i)} << 8 * i;
  return value;
}

Capture::Capture(const fs::path& folder, std::string interface)
    : interface_(std::move(interface)),
      log_(folder / "candump.log"),
      table_(folder / "tshark.txt"),
      candump_({.words = {"candump", "-L", "-d", "-r", "8000000", interface_},
                .input = {},
                .output = {.file = log_},
                .error = process::Stream{}}) {
  await_marker("1ABCDEF0#");
}

void Capture::await_marker(const char* frame) const {
  for (int i = 0; i < 200; ++i) {
    ASSERT_EQ(run({"cansend", interface_, frame}, {}), 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (text_of(log_).find(frame) != std::string::npos) return;
  }
  FAIL() << "candump does not hear cansend";
}

void Capture::await(const std::string& text) const {
  for (int i = 0; i < 1000; ++i) {
    if (text_of(log_).find(text) != std::string::npos) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ADD_FAILURE() << "nobody says " << text;
}

std::vector<Decoded> Capture::decode() {
  await_marker("1ABCDEF1#");
  candump_.tell(SIGINT);
  candump_.wait();
  EXPECT_EQ(text_of(log_).find("DROPCOUNT"), std::string::npos) << "candump lost frames";
  std::vector<std::string> words = {"tshark", "-r",    log_, "-d", "can.subdissector,canopen",
                                    "-T",     "fields"};
  for (const char* field : kFields) words.insert(words.end(), {"-e", field});
  EXPECT_EQ(run(words, table_), 0);
  std::vector<Decoded> frames;
  std::ifstream in(table_);
  for (std::string line; std::getline(in, line);) frames.push_back(decode_line(line));
  return frames;
}

}  // namespace verp::test
