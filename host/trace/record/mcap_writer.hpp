#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host/trace/record/mcap_format.hpp"

namespace verp::record::mcap {

enum class Compression : std::uint8_t { kNone, kZstd };

/// Gets all of a Writer's data at once (host/trace/live). Views are valid during the call.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void schema(std::uint16_t id, const Schema& schema) = 0;
  virtual void channel(std::uint16_t id, const Channel& channel) = 0;
  virtual void message(std::uint16_t channel, std::uint64_t time_ns, std::string_view data) = 0;
};

/// The process that is writing a file of that name, or 0.
int writer_of(const std::filesystem::path& path);

/// An append-only MCAP file: chunks with CRC and message indexes, summary and footer. A crash loses
/// only the open chunk. It grows as `part_path()` and is renamed in close(): writers of one path
/// never mix. Members throw TraceError on a disk error.
class Writer {
 public:
  /// kZstd compresses chunks that become shorter. Without `path` all goes to the listener, which
  /// must outlive the writer.
  Writer(std::filesystem::path path, std::string_view profile, std::string_view library,
         Compression compression = Compression::kNone, Listener* listener = nullptr);
  ~Writer();  ///< without close(): flushes, and leaves the part file without summary
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  std::uint16_t add_schema(std::string_view name, std::string_view encoding, std::string_view data);
  std::uint16_t add_channel(std::uint16_t schema, std::string_view topic,
                            std::string_view encoding);
  void add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view data);
  void add_metadata(std::string_view name, const StringMap& entries);
  void add_attachment(std::string_view name, std::string_view media_type, std::string_view data);
  /// Passes the open chunk to the operating system.
  void flush();
  /// Writes summary and footer and renames the file. Add nothing afterwards.
  void close();
  /// Removes the part file. Add nothing afterwards.
  void discard();

  std::size_t open_bytes() const { return chunk_.size(); }
  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& part_path() const { return part_; }

 private:
  struct Entry {
    std::uint64_t time_ns = 0;
    std::uint64_t offset = 0;
  };
  struct OpenChannel {
    std::string record;
    std::uint32_t sequence = 0;
    std::vector<Entry> entries;  ///< of the open chunk
    bool announced = false;      ///< schema and channel are in some chunk
    std::uint16_t schema = 0;
  };

  void put(std::string_view bytes);
  void end_chunk();
  Bytes write_message_indexes();  ///< of the open chunk; returns channel -> offset
  void write_summary();
  void group(Bytes& summary, Bytes& offsets, Opcode opcode, std::string_view records) const;

  std::filesystem::path path_, part_;
  const Compression compression_;
  Listener* listener_;
  std::FILE* file_ = nullptr;
  bool whole_ = false;  ///< close() has written everything
  std::uint64_t position_ = 0;
  std::uint32_t data_crc_ = 0;
  std::string chunk_;
  std::uint64_t chunk_start_ns_ = 0, chunk_end_ns_ = 0;
  std::uint64_t start_ns_ = 0, end_ns_ = 0, messages_ = 0;
  std::uint32_t chunks_ = 0, attachments_ = 0, metadata_ = 0;
  std::vector<std::string> schemas_;  ///< id is index + 1
  std::vector<bool> schema_announced_;
  std::vector<OpenChannel> channels_;  ///< id is index
  Bytes chunk_index_, attachment_index_, metadata_index_;
};

}  // namespace verp::record::mcap
