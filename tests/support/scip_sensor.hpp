#pragma once
#include <concepts>
#include <cstdint>
#include <string>
#include <vector>

#include "hal/contract/byte_link.hpp"

/// A SCIP 2.0 laser at a link, written from the specification (C-42-03320B). It answers BM, QT, MD
/// and SCIP2.0, and scans on request.
namespace verp::test {

template <std::derived_from<hal::ByteLink> Link>
class ScipSensor {
 public:
  explicit ScipSensor(Link& link) : link_(link) {}

  void listen() {
    std::uint8_t bytes[256];
    for (std::size_t size = 0; (size = link_.read(bytes, sizeof bytes, 0)) > 0;)
      heard_.append(reinterpret_cast<const char*>(bytes), size);
    for (std::size_t end = 0; (end = heard_.find('\n')) != heard_.npos; heard_.erase(0, end + 1)) {
      if (!silent_) answer(heard_.substr(0, end));
    }
  }
  /// One turn, if requested.
  void scan(std::uint32_t time_ms, const std::vector<std::uint32_t>& range_mm) {
    listen();
    if (silent_ || request_.empty()) return;
    std::string data;
    for (const std::uint32_t range : range_mm) data += in_six_bits(range, 3);
    say(request_ + "\n" + line("99") + line(in_six_bits(time_ms, 4)) + blocks(data) + "\n");
  }
  void be_silent(bool silent) {
    silent_ = silent;
    if (silent) request_.clear();  // as if unplugged
  }
  bool scanning() const { return !request_.empty(); }
  void say(const std::string& text) {
    std::size_t said = 0;
    while (said < text.size()) {
      const std::size_t count = link_.write(
          reinterpret_cast<const std::uint8_t*>(text.data()) + said, text.size() - said, 1000);
      if (count == 0) return;
      said += count;
    }
  }

 private:
  static std::string in_six_bits(std::uint32_t value, int characters) {
    std::string out;
    for (int shift = 6 * (characters - 1); shift >= 0; shift -= 6)
      out += static_cast<char>(0x30 + (value >> shift) % 64);
    return out;
  }
  static std::string line(const std::string& text) {
    unsigned sum = 0;
    for (const char c : text) sum += static_cast<unsigned char>(c);
    return text + static_cast<char>(0x30 + sum % 64) + "\n";
  }
  /// Lines of 64 characters.
  static std::string blocks(const std::string& data) {
    std::string out;
    for (std::size_t at = 0; at < data.size(); at += 64) out += line(data.substr(at, 64));
    return out;
  }
  void answer(const std::string& request) {
    const bool scan = request.starts_with("MD");
    if (scan && request.size() != 15) return say(request + "\n" + line("0C") + "\n");
    if (scan) request_ = request.substr(0, 13) + "00";
    if (request == "QT") request_.clear();
    say(request + "\n" + line("00") + "\n");
  }

  Link& link_;
  std::string heard_, request_;
  bool silent_ = false;
};

}  // namespace verp::test
