#include "host/trace/record/mcap_writer.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <utility>

#include "host/os/files/whole.hpp"
#include "host/trace/record/compression.hpp"
#include "host/trace/record/trace_error.hpp"

namespace verp::record::mcap {

namespace {
constexpr std::size_t kMessageRoom = 1u << 20;  // for declarations in its chunk

/// Locked for writer_of(); the lock ends with the process.
std::FILE* open_locked(const std::filesystem::path& path, std::filesystem::path& part) {
  const int descriptor = files::open_part(path, part);
  if (descriptor < 0) return nullptr;
  ::flock(descriptor, LOCK_EX | LOCK_NB);
  return ::fdopen(descriptor, "wb");
}

/// True if the file is no trace but, for example, a robot's file.
bool holds_something_else(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string start(kMagic.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(in.gcount()));
  return !start.empty() && start != kMagic;
}
/// True if some process has it open by open_part().
bool is_written(const std::filesystem::path& part) {
  const int descriptor = ::open(part.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool taken = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return taken;
}
}  // namespace

int writer_of(const std::filesystem::path& path) {
  const std::string begins = path.filename().string() + ".";
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begins) || !name.ends_with(".part") || !is_written(entry.path()))
      continue;
    int process = 0;
    std::from_chars(name.data() + begins.size(), name.data() + name.size(), process);
    if (process > 0) return process;
  }
  return 0;
}

Writer::Writer(std::filesystem::path path, std::string_view profile, std::string_view library,
               Compression compression, Listener* listener)
    : path_(std::move(path)), compression_(compression), listener_(listener) {
  if (path_.empty()) return;
  if (std::filesystem::is_directory(path_)) {
    throw TraceError(path_, "is a folder", "name a file, such as run.mcap");
  }
  // The finished trace would replace a device or pipe.
  if (std::filesystem::exists(path_) && !std::filesystem::is_regular_file(path_)) {
    throw TraceError(path_, "is not a regular file", "name another file, such as run.mcap");
  }
  if (holds_something_else(path_)) {
    throw TraceError(path_, 0, "is no trace, and would be replaced by one",
                     "name another file, such as run.mcap, or move this one away");
  }
  const auto target = files::target_of(path_);
  if (target) path_ = *target;
  if (target) file_ = open_locked(path_, part_);
  if (file_ == nullptr) {
    const files::Trouble trouble(errno);
    throw TraceError(path_, trouble.what(), trouble.fix());
  }
  put(kMagic);
  put(Bytes().record(Opcode::kHeader, Bytes().text(profile).text(library).data).data);
}

Writer::~Writer() {
  if (file_ == nullptr) return;
  try {
    flush();
  } catch (const TraceError&) {  // flushed chunks remain
  }
  std::fclose(file_);
}

void Writer::put(std::string_view bytes) {
  if (file_ == nullptr) return;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
    throw TraceError(part_, position_, std::string("write failed: ") + std::strerror(errno),
                     "free space on the disk, or record elsewhere");
  }
  position_ += bytes.size();
  data_crc_ = crc32(bytes, data_crc_);
}

std::uint16_t Writer::add_schema(std::string_view name, std::string_view encoding,
                                 std::string_view data) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back(
      Bytes()
          .record(Opcode::kSchema, Bytes().u16(id).text(name).text(encoding).text(data).data)
          .data);
  schema_announced_.push_back(false);
  if (listener_ != nullptr) listener_->schema(id, {name, encoding, data});
  return id;
}

std::uint16_t Writer::add_channel(std::uint16_t schema, std::string_view topic,
                                  std::string_view encoding) {
  const auto id = static_cast<std::uint16_t>(channels_.size());
  const Bytes content = Bytes().u16(id).u16(schema).text(topic).text(encoding).map({});
  channels_.push_back({.record = Bytes().record(Opcode::kChannel, content.data).data,
                       .sequence = 0,
                       .entries = {},
                       .announced = false,
                       .schema = schema});
  if (listener_ != nullptr) listener_->channel(id, {schema, topic, encoding});
  return id;
}

void Writer::add_message(std::uint16_t channel, std::uint64_t time_ns, std::string_view data) {
  OpenChannel& to = channels_.at(channel);
  if (listener_ != nullptr) listener_->message(channel, time_ns, data);
  if (file_ == nullptr) return;
  if (data.size() > kMostRecord - kMessageRoom) {
    throw TraceError(part_, position_, "a message of " + std::to_string(data.size()) + " bytes",
                     "64 MB is the most: record smaller pictures");
  }
  if (!chunk_.empty() && chunk_.size() + data.size() > kMostRecord - kMessageRoom) end_chunk();
  if (!to.announced) {
    const std::size_t schema = to.schema - 1u;
    if (!schema_announced_.at(schema)) chunk_ += schemas_[schema];
    schema_announced_[schema] = true;
    chunk_ += to.record;
    to.announced = true;
  }
  const bool first = std::all_of(channels_.begin(), channels_.end(),
                                 [](const OpenChannel& c) { return c.entries.empty(); });
  chunk_start_ns_ = first ? time_ns : std::min(chunk_start_ns_, time_ns);
  chunk_end_ns_ = first ? time_ns : std::max(chunk_end_ns_, time_ns);
  to.entries.push_back({time_ns, chunk_.size()});
  const Bytes content = Bytes().u16(channel).u32(to.sequence++).u64(time_ns).u64(time_ns).raw(data);
  chunk_ += Bytes().record(Opcode::kMessage, content.data).data;
  start_ns_ = messages_ == 0 ? time_ns : std::min(start_ns_, time_ns);
  end_ns_ = std::max(end_ns_, time_ns);
  ++messages_;
}

void Writer::add_metadata(std::string_view name, const StringMap& entries) {
  flush();
  const std::string record =
      Bytes().record(Opcode::kMetadata, Bytes().text(name).map(entries).data).data;
  metadata_index_.record(Opcode::kMetadataIndex,
                         Bytes().u64(position_).u64(record.size()).text(name).data);
  ++metadata_;
  put(record);
}

void Writer::add_attachment(std::string_view name, std::string_view media_type,
                            std::string_view data) {
  flush();
  Bytes content;
  content.u64(0).u64(0).text(name).text(media_type).u64(data.size()).raw(data);
  content.u32(crc32(content.data));
  const std::string record = Bytes().record(Opcode::kAttachment, content.data).data;
  attachment_index_.record(Opcode::kAttachmentIndex, Bytes()
                                                         .u64(position_)
                                                         .u64(record.size())
                                                         .u64(0)
                                                         .u64(0)
                                                         .u64(data.size())
                                                         .text(name)
                                                         .text(media_type)
                                                         .data);
  ++attachments_;
  put(record);
}

void Writer::flush() {
  if (file_ == nullptr) return;
  if (!chunk_.empty()) end_chunk();
  if (std::fflush(file_) != 0) {
    throw TraceError(part_, position_, std::string("write failed: ") + std::strerror(errno),
                     "free space on the disk, or record elsewhere");
  }
}

void Writer::end_chunk() {
  Bytes content;
  content.u64(chunk_start_ns_).u64(chunk_end_ns_).u64(chunk_.size()).u32(crc32(chunk_));
  const std::string frame = compression_ == Compression::kZstd ? packed(chunk_) : "";
  const std::string_view compression = frame.empty() ? "" : kZstdName,
                         stored = frame.empty() ? chunk_ : frame;
  content.text(compression).u64(stored.size()).raw(stored);
  const std::uint64_t chunk_offset = position_;
  put(Bytes().record(Opcode::kChunk, content.data).data);
  const std::uint64_t chunk_length = position_ - chunk_offset;
  const std::uint64_t index_offset = position_;
  const Bytes offsets = write_message_indexes();
  Bytes index;
  index.u64(chunk_start_ns_).u64(chunk_end_ns_).u64(chunk_offset).u64(chunk_length);
  index.text(offsets.data).u64(position_ - index_offset).text(compression);
  index.u64(stored.size()).u64(chunk_.size());
  chunk_index_.record(Opcode::kChunkIndex, index.data);
  ++chunks_;
  chunk_.clear();
}

Bytes Writer::write_message_indexes() {
  Bytes offsets;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    std::vector<Entry>& entries = channels_[i].entries;
    if (entries.empty()) continue;
    const auto id = static_cast<std::uint16_t>(i);
    offsets.u16(id).u64(position_);
    Bytes list;
    for (const Entry& entry : entries) list.u64(entry.time_ns).u64(entry.offset);
    entries.clear();
    put(Bytes().record(Opcode::kMessageIndex, Bytes().u16(id).text(list.data).data).data);
  }
  return offsets;
}

void Writer::group(Bytes& summary, Bytes& offsets, Opcode opcode, std::string_view records) const {
  if (records.empty()) return;
  const std::uint64_t start = position_ + summary.data.size();
  offsets.record(Opcode::kSummaryOffset,
                 Bytes().u8(static_cast<std::uint8_t>(opcode)).u64(start).u64(records.size()).data);
  summary.raw(records);
}

void Writer::write_summary() {
  Bytes summary, offsets, schemas, channels, counts;
  for (const std::string& record : schemas_) schemas.raw(record);
  for (std::size_t id = 0; id < channels_.size(); ++id) {
    channels.raw(channels_[id].record);
    counts.u16(static_cast<std::uint16_t>(id)).u64(channels_[id].sequence);
  }
  Bytes statistics;
  statistics.u64(messages_).u16(static_cast<std::uint16_t>(schemas_.size()));
  statistics.u32(static_cast<std::uint32_t>(channels_.size())).u32(attachments_).u32(metadata_);
  statistics.u32(chunks_).u64(start_ns_).u64(end_ns_).text(counts.data);

  group(summary, offsets, Opcode::kSchema, schemas.data);
  group(summary, offsets, Opcode::kChannel, channels.data);
  group(summary, offsets, Opcode::kStatistics,
        Bytes().record(Opcode::kStatistics, statistics.data).data);
  group(summary, offsets, Opcode::kChunkIndex, chunk_index_.data);
  group(summary, offsets, Opcode::kAttachmentIndex, attachment_index_.data);
  group(summary, offsets, Opcode::kMetadataIndex, metadata_index_.data);

  const std::uint64_t summary_start = position_;
  const std::uint64_t offset_start = position_ + summary.data.size();
  summary.raw(offsets.data);
  // The CRC covers summary and footer up to itself.
  summary.u8(static_cast<std::uint8_t>(Opcode::kFooter)).u64(kFooterSize);
  summary.u64(summary_start).u64(offset_start);
  summary.u32(crc32(summary.data));
  put(summary.data);
}

void Writer::close() {
  if (file_ == nullptr) return;
  flush();
  put(Bytes().record(Opcode::kDataEnd, Bytes().u32(data_crc_).data).data);
  write_summary();
  put(kMagic);
  flush();
  whole_ = true;
  const bool named = files::take_name(::fileno(file_), part_, path_);
  const std::string why = named ? "" : std::strerror(errno);
  std::fclose(std::exchange(file_, nullptr));
  if (named) return;
  throw TraceError(path_, "cannot take its name: " + why,
                   "the whole trace is in " + part_.string());
}

void Writer::discard() {
  if (whole_ || part_.empty()) return;
  if (file_ != nullptr) std::fclose(file_);
  file_ = nullptr;
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
  part_.clear();
}

}  // namespace verp::record::mcap
