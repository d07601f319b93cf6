#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/trace/record/mcap_format.hpp"

namespace verp::record::mcap {

struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t time_ns = 0;
  std::string_view data;
  std::uint64_t offset = 0;  ///< of the record in the file; of its chunk if that is compressed
};
struct Attachment {
  std::string_view media_type, data;
  std::uint64_t offset = 0;
};

/// Where a file stops being what its writer wrote.
struct Flaw {
  std::uint64_t offset = 0;
  std::string what;
  bool truncated = false;  ///< the bytes up to offset are whole; the end is missing
  std::uint64_t lost_messages =
      0;  ///< whole or begun in the incomplete chunk, as far as the file shows
};

/// Everything readable before the first flaw. Views point into the bytes given to parse(), and into
/// `unpacked`: not to be copied.
struct File {
  File() = default;
  File(File&&) = default;
  File(const File&) = delete;

  std::string_view profile, library;
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::vector<Message> messages;
  std::map<std::string, StringMap> metadata;
  std::map<std::string, Attachment> attachments;
  std::deque<std::string> unpacked;  ///< the compressed chunks
  std::optional<Flaw> flaw;

  const Channel* find_channel(std::string_view topic, std::uint16_t& id) const;
};

/// Total: any bytes give a File, with a flaw when they are not a whole, unchanged file of our
/// Writer. Covers every byte: chunk and attachment CRCs say where, the CRCs of the data section and
/// of the summary say that. Chunks compressed otherwise than by zstd and files without CRCs are
/// flaws: our writer makes none.
File parse(std::string_view bytes);

}  // namespace verp::record::mcap
