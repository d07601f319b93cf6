#pragma once
#include <cstring>
#include <deque>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "host/trace/record/mcap_reader.hpp"

namespace verp::record::mcap {

/// A file with all its messages, in memory.
struct WholeFile : File {
  std::vector<Message> messages;
  std::deque<std::string> data;
};

inline WholeFile parse(std::string_view bytes) {
  WholeFile whole;
  Reader reader(std::make_unique<std::istringstream>(std::string(bytes)));
  reader.read([&](const File&, const Message& message) {
    whole.messages.push_back(message);
    whole.messages.back().data = whole.data.emplace_back(message.data);
  });
  static_cast<File&>(whole) = std::move(reader).take();
  return whole;
}

/// The file with one more chunk, whose declared size may be a lie, under right CRCs.
inline std::string with_chunk(std::string_view bytes, std::string_view records,
                              std::string_view compression = "", std::uint64_t size = 0,
                              std::uint32_t crc = 0) {
  std::size_t at = kMagic.size();
  while (static_cast<Opcode>(bytes[at]) != Opcode::kDataEnd) {
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data() + at + 1, sizeof length);
    at += kRecordHead + length;
  }
  if (compression.empty()) size = records.size();
  if (compression.empty()) crc = crc32(records);
  std::string out(bytes.substr(0, at));
  out += Bytes()
             .record(Opcode::kChunk, Bytes()
                                         .u64(0)
                                         .u64(0)
                                         .u64(size)
                                         .u32(crc)
                                         .text(compression)
                                         .u64(records.size())
                                         .raw(records)
                                         .data)
             .data;
  out += Bytes().record(Opcode::kDataEnd, Bytes().u32(crc32(out)).data).data;
  Bytes footer;
  footer.u8(static_cast<std::uint8_t>(Opcode::kFooter)).u64(kFooterSize).u64(out.size()).u64(0);
  footer.u32(crc32(footer.data));
  return out + footer.data + std::string(kMagic);
}

inline std::string message_record(std::uint16_t channel, std::string_view data) {
  return Bytes()
      .record(Opcode::kMessage, Bytes().u16(channel).u32(0).u64(0).u64(0).raw(data).data)
      .data;
}

}  // namespace verp::record::mcap
