#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "host/trace/record/mcap_format.hpp"

namespace verp::record::mcap {

/// Valid during the call that gives it. Its channel and schema are declared.
struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t time_ns = 0;
  std::string_view data;
  std::uint64_t offset = 0;  ///< record's, or its compressed chunk's
  std::uint64_t part = 0;    ///< offset of its chunk; its own outside of chunks
};
struct Attachment {
  std::string_view media_type, data;
  std::uint64_t offset = 0;
};

/// The first place where a file is not as its writer wrote it.
struct Flaw {
  std::uint64_t offset = 0;
  std::string what;
  bool truncated = false;  ///< intact before the offset; the end is missing
  bool in_chunk = false;   ///< the end of a chunk is missing
};

/// The records that a reader left out because they are damaged.
struct LeftOut {
  std::uint64_t records = 0;   ///< chunks and attachments
  std::uint64_t bytes = 0;     ///< of them in the file
  std::uint64_t messages = 0;  ///< of channels that no whole record declares
};
/// The reader's choice at a damaged chunk or attachment.
enum class Damage : std::uint8_t { kEnds, kLeftOut };

/// All but the messages before the first flaw. Views are into `texts`.
struct File {
  File() = default;
  File(File&&) = default;
  File& operator=(File&&) = default;

  std::string profile, library;
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;  ///< of declared schemas
  std::map<std::string, StringMap> metadata;
  std::map<std::string, Attachment> attachments;
  std::uint64_t messages = 0;
  bool data_whole = false;   ///< no message is missing
  std::optional<Flaw> flaw;  ///< the first one
  LeftOut left_out;
  std::optional<Flaw> end;  ///< where reading ended early
  std::deque<std::string> texts;

  const Channel* find_channel(std::string_view topic, std::uint16_t& id) const;
};

using OnMessage = std::function<void(const File& so_far, const Message& message)>;

/// Total: any bytes give a File, with a flaw unless they are an intact file of our Writer. CRCs of
/// chunks and attachments locate damage, those of data section and summary detect it. Our writer
/// always writes CRCs and compresses only by zstd: anything else is a flaw. Holds one record and
/// one chunk, of at most kMostRecord bytes each, and File's texts, of as many.
class Reader {
 public:
  /// Seekable. With Damage::kLeftOut messages behind damaged chunks are given, too.
  explicit Reader(std::unique_ptr<std::istream> in, Damage damage = Damage::kEnds);
  ~Reader();
  Reader(Reader&&) noexcept;

  /// All messages before the first flaw, in file order, those of a chunk when its CRC fits; a
  /// truncated chunk gives its whole ones. May be called again.
  const File& read(const OnMessage& on_message = {});
  /// Only those of one Message::part, after read().
  void read_part(std::uint64_t part, const OnMessage& on_message);
  const File& file() const;
  /// Its last act.
  File take() &&;

 private:
  class Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace verp::record::mcap
