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
  std::uint64_t offset = 0;  ///< record's, or its compressed chunk's
};
struct Attachment {
  std::string_view media_type, data;
  std::uint64_t offset = 0;
};

/// The first place where a file is not as its writer wrote it.
struct Flaw {
  std::uint64_t offset = 0;
  std::string what;
  bool truncated = false;           ///< intact before the offset; the end is missing
  std::uint64_t lost_messages = 0;  ///< in the incomplete chunk, as far as known
};

/// All before the first flaw. Views point into parse()'s bytes and `unpacked`, so it cannot be
/// copied.
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
  std::deque<std::string> unpacked;  ///< compressed chunks
  std::optional<Flaw> flaw;

  const Channel* find_channel(std::string_view topic, std::uint16_t& id) const;
};

/// Total: any bytes give a File, with a flaw unless they are an intact file of our Writer. Covers
/// every byte: CRCs of chunks and attachments locate damage, those of data section and summary
/// detect it. Our writer always writes CRCs and compresses only by zstd: anything else is a flaw.
File parse(std::string_view bytes);

}  // namespace verp::record::mcap
