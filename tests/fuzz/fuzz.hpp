#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "common/protocol/dynamixel2.hpp"
#include "host/os/files/temporary_directory.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace verp::fuzz {

/// A promise that every input keeps; ends the run if this one does not.
inline void require(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "broken: %s\n", promise);
  std::abort();
}

/// Calls `read`, which may throw these errors. Any other one ends the run.
template <class Error, class... More, class Read>
void refuses_only_by(const Read& read) {
  try {
    if constexpr (sizeof...(More) > 0) {
      refuses_only_by<More...>(read);
    } else {
      read();
    }
  } catch (const Error&) {
  }
}

/// The fuzzer's bytes, cut into numbers; zeros beyond the end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  std::size_t left() const { return left_; }
  template <class Number>
  Number take() {
    Number value{};
    const std::string_view some = take(sizeof value);
    if (!some.empty()) std::memcpy(&value, some.data(), some.size());
    return value;
  }
  std::uint8_t byte() { return take<std::uint8_t>(); }
  std::uint16_t word() { return take<std::uint16_t>(); }
  /// Below `end`, which is at least 1.
  std::size_t below(std::size_t end) { return take<std::uint32_t>() % end; }
  std::string_view take(std::size_t most) {
    const std::size_t size = most < left_ ? most : left_;
    const auto* from = reinterpret_cast<const char*>(data_);
    data_ += size;
    left_ -= size;
    return {from, size};
  }
  std::string_view rest() { return take(left_); }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

/// Changes a good file at a few places, for formats too large to be found by chance.
inline std::string patched(std::string file, Bytes& bytes) {
  for (int edits = bytes.byte() % 16; edits > 0 && bytes.left() > 0; --edits) {
    const std::uint8_t how = bytes.byte();
    const std::size_t at = bytes.below(file.size() + 1), count = 1 + how / 8;
    if (how % 8 == 0) file.erase(at, bytes.word());
    if (how % 8 == 1) file.insert(at, bytes.take(count));
    if (how % 8 == 2) file.insert(at, file.substr(bytes.below(file.size() + 1), bytes.word()));
    if (how % 8 == 3) file.resize(at);
    const std::string_view over = how % 8 > 3 ? bytes.take(count) : std::string_view();
    file.replace(at, over.size(), over);
  }
  return file;
}

/// Plain data of one type, changed in place: pairs of place and new bytes.
template <class Data>
void patch(Data& data, int most, Bytes& bytes) {
  for (int edits = bytes.byte() % (most + 1); edits > 0; --edits) {
    const std::size_t at = bytes.below(sizeof data);
    const std::string_view over = bytes.take(1 + bytes.byte() % 4);
    const std::size_t room = sizeof data - at;
    std::memcpy(reinterpret_cast<char*>(&data) + at, over.data(),
                over.size() < room ? over.size() : room);
  }
}

/// Writes the right CRC behind everything that looks like a Dynamixel packet.
inline void repair_packets(std::string& stream) {
  auto* bytes = reinterpret_cast<std::uint8_t*>(stream.data());
  for (std::size_t at = 0; at + dxl::kHeaderBytes < stream.size(); ++at) {
    if (std::memcmp(bytes + at, dxl::kHeader, sizeof dxl::kHeader) != 0) continue;
    const std::size_t end = dxl::kHeaderBytes + dxl::get_u16(bytes + at + dxl::kLengthAt);
    if (end < dxl::kHeaderBytes + 3 || at + end > stream.size()) continue;
    dxl::put_u16(bytes + at + end - 2, dxl::crc16(bytes + at, end - 2));
    at += end - 1;
  }
}
/// The first byte chooses whether checksums are repaired: they almost always are.
inline std::string packets(Bytes& bytes, std::size_t most) {
  const bool as_they_are = bytes.byte() == 0xFF;
  std::string stream(bytes.take(most));
  if (!as_they_are) repair_packets(stream);
  return stream;
}

/// Writes the bytes into a file of that name, in a folder that this process removes at its end.
inline std::filesystem::path in_file(const std::string& name, std::string_view bytes) {
  static const files::TemporaryDirectory folder;
  const std::filesystem::path file = folder.path() / name;
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

}  // namespace verp::fuzz
