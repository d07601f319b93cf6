#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

/// CDR, the encoding of ROS 2; private to this folder.
namespace verp::record::ros {

/// Little-endian; a number is aligned to its size, from the end of the 4-byte encapsulation header.
class Cdr {
 public:
  template <class Number>
  Cdr& put(Number value) {
    while ((data_.size() - 4) % sizeof(Number) != 0) data_ += '\0';
    data_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    return *this;
  }
  Cdr& text(std::string_view value) {
    put(static_cast<std::uint32_t>(value.size() + 1));
    data_.append(value);
    data_ += '\0';
    return *this;
  }
  Cdr& header(std::uint64_t time_ns, std::string_view frame) {
    put(static_cast<std::int32_t>(time_ns / 1'000'000'000));
    put(static_cast<std::uint32_t>(time_ns % 1'000'000'000));
    return text(frame);
  }
  template <class Range>
  Cdr& doubles(const Range& values) {
    for (const double value : values) put(value);
    return *this;
  }
  Cdr& bytes(std::string_view values) {
    data_.append(values);
    return *this;
  }
  std::string take() { return std::move(data_); }

 private:
  std::string data_{"\0\1\0\0", 4};  // CDR_LE
};

/// Beyond the end, a read gives zeros and clears `good`.
class CdrReader {
 public:
  explicit CdrReader(std::string_view data) : data_(data) {}
  template <class Number>
  Number get() {
    while (at_ >= 4 && (at_ - 4) % sizeof(Number) != 0) ++at_;
    Number value{};
    good = good && at_ + sizeof(Number) <= data_.size();
    if (good) std::memcpy(&value, data_.data() + at_, sizeof(Number));
    at_ += sizeof(Number);
    return value;
  }
  std::string_view text() {
    const auto length = get<std::uint32_t>();
    good = good && length > 0 && at_ + length <= data_.size();
    const std::string_view found = good ? data_.substr(at_, length - 1) : "";
    if (good) at_ += length;
    return found;
  }
  std::string_view bytes(std::size_t length) {
    good = good && at_ <= data_.size() && length <= data_.size() - at_;
    const std::string_view found = good ? data_.substr(at_, length) : "";
    if (good) at_ += length;
    return found;
  }
  bool good = true;

 private:
  std::string_view data_;
  std::size_t at_ = 4;
};

}  // namespace verp::record::ros
