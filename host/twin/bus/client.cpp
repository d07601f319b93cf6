#include "host/twin/bus/client.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/protocol/feetech.hpp"
#include "common/protocol/feetech_table.hpp"

namespace verp::bus {
namespace {

constexpr std::uint32_t kArrival_us = 500'000;  // until the other end of a link appears
// The vendor's SDK waits 3 ms per id plus 16 ms for a broadcast Ping.
constexpr std::uint32_t kScan_us = 253 * 3'000 + 16'000;

constexpr std::array<const char*, 8> kErrors = {
    "",
    "Result Fail: it could not do that now",
    "Instruction Error: it does not know that instruction",
    "CRC Error: the packet came damaged",
    "Data Range Error: the value is out of range",
    "Data Length Error: only part of a register was written",
    "Data Limit Error: the value is beyond a limit set in the device",
    "Access Error: no such register, read-only, or locked while torque is on"};

}  // namespace

Client::Client(const link::Endpoint& endpoint, std::uint32_t timeout_us, BusProtocol protocol)
    : text_(link::to_text(endpoint)),
      baud_(endpoint.baud),
      timeout_us_(timeout_us),
      own_(endpoint),
      link_(*own_),
      bus_(link_, clock_),
      words_(make_client_words(protocol, bus_)) {
  wait_for_somebody();
}

Client::Client(link::Link& link, const link::Endpoint& endpoint, std::uint32_t timeout_us,
               BusProtocol protocol)
    : text_(link::to_text(endpoint)),
      baud_(endpoint.baud),
      timeout_us_(timeout_us),
      link_(link),
      bus_(link_, clock_),
      words_(make_client_words(protocol, bus_)) {
  wait_for_somebody();
}

void Client::wait_for_somebody() {
  if (link_.wait_connected(std::max(timeout_us_, kArrival_us))) return;
  if (text_.starts_with("pty:")) {
    throw DeviceError(fmt::format(
        "{}: nobody has opened this port, which is made anew; to open one that is there, give "
        "serial:PATH",
        link_.place()));
  }
  throw DeviceError(fmt::format(
      "{}: nobody is at the other end; start it, or check the cable, and try again", text_));
}

std::uint32_t Client::patience_us(std::size_t bytes) const {
  return timeout_us_ + (baud_ == 0 ? 0 : app::wire_us(bytes, baud_));
}

std::vector<Identity> Client::scan() {
  if (protocol() == BusProtocol::kFeetech) return scan_each();
  std::vector<Identity> found;
  // Noise may have been a device: another master's request was still being answered, or two
  // devices share an id.
  bool clean = false;
  for (int attempt = 0; attempt < kAttempts && !clean; ++attempt) {
    const std::uint32_t noise = words_->noise_bytes();
    scan_once(found);
    clean = words_->noise_bytes() == noise;
  }
  std::sort(found.begin(), found.end(),
            [](const Identity& a, const Identity& b) { return a.id < b.id; });
  // A late reply, or an answer to each attempt.
  const auto again = std::unique(found.begin(), found.end(),
                                 [](const Identity& a, const Identity& b) { return a.id == b.id; });
  found.erase(again, found.end());
  return found;
}

void Client::scan_once(std::vector<Identity>& found) {
  const std::size_t frame = words_->encode_ping(dxl::kBroadcast);
  words_->request(frame, std::max(kScan_us, patience_us(0)), [&](const ClientWords::Reply& reply) {
    if (reply.data.size() != 3) return app::Take::kStray;
    found.push_back({reply.id, dxl::get_u16(reply.data.data()), reply.data[2]});
    return app::Take::kMore;
  });
}

std::vector<Identity> Client::scan_each() {
  std::vector<Identity> found;
  for (int id = 0; id <= feetech::kMaxId; ++id) {
    if (const auto one = ping(static_cast<std::uint8_t>(id), 1)) found.push_back(*one);
  }
  return found;
}

std::optional<Client::Answer> Client::ask(std::uint8_t id, std::size_t frame, std::size_t size,
                                          int attempts) {
  if (owed_.replies > 0 && owed_.id == id && owed_.size == size) drop_late();
  const std::uint32_t patience = patience_us(frame + words_->status_bytes() + size);
  std::optional<Answer> answer;
  int made = 0;
  while (made < attempts && !answer) {
    ++made;
    words_->request(frame, patience, [&](const ClientWords::Reply& reply) {
      if (reply.id != id || (reply.error == 0 && reply.data.size() != size))
        return app::Take::kStray;
      answer = {reply.error, {reply.data.begin(), reply.data.end()}};
      return app::Take::kDone;
    });
  }
  tries_ = std::max(tries_, made);
  owed_ = {answer ? made - 1 : made, id, size, patience};
  return answer;
}

/// Later ones count as lost.
void Client::drop_late() {
  std::uint8_t bytes[256];
  for (bool anew = true; owed_.replies > 0; anew = false) {
    const std::size_t count = bus_.poll(bytes, sizeof bytes, 2 * owed_.patience_us);
    if (count == 0) break;
    owed_.replies -= words_->late_answers(owed_.id, {bytes, count}, anew);
  }
  owed_.replies = 0;
}

// A Ping's answer does not say what the servo is; a Read's does.
std::optional<Identity> Client::identify_feetech(std::uint8_t id, int attempts) {
  constexpr std::uint16_t kBytes = feetech::address::kModelNumber + 2;
  const auto answer = ask(id, words_->encode_read(id, 0, kBytes), kBytes, attempts);
  if (!answer) return std::nullopt;
  return Identity{id, feetech::get_u16(answer->data.data() + feetech::address::kModelNumber),
                  answer->data[feetech::address::kFirmwareMajor]};
}

std::optional<Identity> Client::ping(std::uint8_t id, int attempts) {
  if (protocol() == BusProtocol::kFeetech) return identify_feetech(id, attempts);
  const auto answer = ask(id, words_->encode_ping(id), 3, attempts);
  if (!answer || answer->error != 0) return std::nullopt;
  return Identity{id, dxl::get_u16(answer->data.data()), answer->data[2]};
}

std::vector<std::uint8_t> Client::read(std::uint8_t id, std::uint16_t address,
                                       std::uint16_t length) {
  const auto answer = ask(id, words_->encode_read(id, address, length), length, kAttempts);
  expect_good(id, address, "read", answer);
  return answer->data;
}

bool Client::read_once(std::uint8_t id, std::uint16_t address, std::uint16_t length) {
  const auto answer = ask(id, words_->encode_read(id, address, length), length, 1);
  return answer && answer->error == 0;
}

void Client::write(std::uint8_t id, std::uint16_t address, const std::vector<std::uint8_t>& data) {
  expect_good(id, address, "write", ask(id, words_->encode_write(id, address, data), 0, kAttempts));
}

void Client::silent(std::uint8_t id) const {
  const std::string reason =
      !link_.connected()      ? "the link was lost; plug it in again"
      : counters().strays > 0 ? "what came was no answer to it; another program uses this bus, or "
                                "the adapter echoes: see `verp bus doctor`"
      : crc_errors() > 0      ? "only damaged packets came; check the baud rate and the wiring"
                              : "check power, wiring, id and baud rate, or raise --timeout";
  throw DeviceError(fmt::format("{}: device {} did not answer, asked {} times: {}", text_, id,
                                kAttempts, reason));
}

void Client::expect_good(std::uint8_t id, std::uint16_t address, const char* what,
                         const std::optional<Answer>& answer) const {
  if (!answer) silent(id);
  if (answer->error == 0) return;
  const char* error =
      answer->error < kErrors.size() ? kErrors[answer->error] : "an error it has no name for";
  throw RefusedError(fmt::format("{}: device {} refused the {} at address {}: {}", text_, id, what,
                                 address, error),
                     static_cast<dxl::Error>(answer->error));
}

}  // namespace verp::bus
