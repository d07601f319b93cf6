#include "host/trace/record/mcap_reader.hpp"

#include <cstring>

#include "host/trace/record/compression.hpp"

namespace verp::record::mcap {
namespace {

/// Little-endian; beyond the end, values are zero and good() is false.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : bytes_(bytes) {}

  template <class Integer>
  Integer number() {
    Integer value{};
    const std::string_view raw = take(sizeof(value));
    if (good_) std::memcpy(&value, raw.data(), sizeof(value));
    return value;
  }
  std::uint16_t u16() { return number<std::uint16_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::uint64_t u64() { return number<std::uint64_t>(); }
  std::string_view text() { return take(u32()); }
  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size() - at_) {
      good_ = false;
      at_ = bytes_.size();
      return {};
    }
    const std::string_view view = bytes_.substr(at_, size);
    at_ += size;
    return view;
  }
  StringMap map() {
    Cursor inner(text());
    StringMap entries;
    while (inner.good() && !inner.at_end()) {
      const std::string key(inner.text());
      entries[key] = std::string(inner.text());
    }
    good_ = good_ && inner.good();
    return entries;
  }
  bool good() const { return good_; }
  bool at_end() const { return at_ == bytes_.size(); }
  std::uint64_t at() const { return at_; }

 private:
  std::string_view bytes_;
  std::uint64_t at_ = 0;
  bool good_ = true;
};

class Parser {
 public:
  explicit Parser(std::string_view bytes) : bytes_(bytes) {}

  File run() {
    if (bytes_.substr(0, kMagic.size()) != kMagic) {
      const bool cut = kMagic.starts_with(bytes_);
      fail(0, cut ? "the file ends inside its first 8 bytes" : "not an MCAP file (wrong magic)",
           cut);
      return std::move(file_);
    }
    ended_ = bytes_.size() >= 2 * kMagic.size() && bytes_.ends_with(kMagic);
    at_ = kMagic.size();
    while (!file_.flaw && !footer_seen_) top_level_record();
    if (!file_.flaw) check_ending();
    return std::move(file_);
  }

 private:
  void fail(std::uint64_t offset, std::string what, bool truncated = false) {
    if (!file_.flaw) file_.flaw = Flaw{offset, std::move(what), truncated, 0};
  }

  void top_level_record() {
    const std::uint64_t start = at_;
    const std::uint64_t left = bytes_.size() - at_;
    if (left == 0 && !ended_) return fail(start, "the file ends here, without its summary", true);
    Cursor head(bytes_.substr(at_));
    const auto opcode = static_cast<Opcode>(head.number<std::uint8_t>());
    const std::uint64_t length = head.u64();
    if (!head.good() || length > left - kRecordHead) {
      if (ended_) return fail(start, "a record is longer than the file");
      const std::string_view begun = head.good() ? bytes_.substr(at_ + kRecordHead) : "";
      fail(start, "the file ends inside a record", true);
      if (opcode == Opcode::kChunk) file_.flaw->lost_messages = count_lost(begun);
      return;
    }
    const std::string_view content = bytes_.substr(at_ + kRecordHead, length);
    at_ += kRecordHead + length;
    record(opcode, content, start);
  }

  void record(Opcode opcode, std::string_view content, std::uint64_t start) {
    Cursor in(content);
    switch (opcode) {
      case Opcode::kHeader:
        file_.profile = in.text();
        file_.library = in.text();
        break;
      case Opcode::kSchema:
      case Opcode::kChannel:
      case Opcode::kMessage:
        return inner_record(opcode, content, start);
      case Opcode::kChunk:
        return chunk(in, start);
      case Opcode::kAttachment:
        return attachment(content, start);
      case Opcode::kMetadata: {
        const std::string name(in.text());
        file_.metadata[name] = in.map();
        break;
      }
      case Opcode::kDataEnd:
        if (in.u32() != crc32(bytes_.substr(0, start))) {
          return fail(start,
                      "edited or damaged: the CRC of all bytes before this one does not match");
        }
        data_end_seen_ = true;
        summary_start_ = at_;
        break;
      case Opcode::kFooter:
        return footer(in, content, start);
      default:
        if (opcode > Opcode::kDataEnd || opcode == Opcode{0}) fail(start, "unknown record type");
        return;  // indexes and statistics repeat the data section; CRCs cover them
    }
    if (!in.good() || !in.at_end()) fail(start, "edited or damaged: a record's fields overrun it");
  }

  void inner_record(Opcode opcode, std::string_view content, std::uint64_t start) {
    Cursor in(content);
    const std::uint16_t id = in.u16();
    if (opcode == Opcode::kSchema) {
      Schema& schema = file_.schemas[id];
      schema.name = in.text();
      schema.encoding = in.text();
      schema.data = in.text();
    } else if (opcode == Opcode::kChannel) {
      Channel& channel = file_.channels[id];
      channel.schema = in.u16();
      channel.topic = in.text();
      channel.encoding = in.text();
      in.map();
    } else if (opcode == Opcode::kMessage) {
      Message message;
      message.channel = id;
      message.sequence = in.u32();
      message.time_ns = in.u64();
      in.u64();
      message.offset = start;
      message.data = in.take(content.size() - in.at());
      if (in.good()) file_.messages.push_back(message);
    } else {
      return fail(start, "edited or damaged: a chunk holds a record that does not belong there");
    }
    if (!in.good() || !in.at_end()) fail(start, "edited or damaged: a record's fields overrun it");
  }

  void chunk(Cursor& in, std::uint64_t start) {
    in.u64();
    in.u64();
    const std::uint64_t size = in.u64();
    const std::uint32_t crc = in.u32();
    const std::string_view compression = in.text();
    std::string_view records = in.take(in.u64());
    if (!in.good() || !in.at_end()) {
      return fail(start, "edited or damaged: a chunk's fields overrun it");
    }
    if (!compression.empty() && compression != kZstdName) {
      return fail(start, "a chunk is compressed by " + std::string(compression) +
                             ", and zstd alone is known here");
    }
    if (!compression.empty()) {
      auto unpacked = mcap::unpacked(compression, records, size);
      if (!unpacked) return fail(start, "edited or damaged: a compressed chunk cannot be unpacked");
      records = file_.unpacked.emplace_back(std::move(*unpacked));
    }
    if (size != records.size() || crc != crc32(records)) {
      return fail(start, "edited or damaged: a chunk's CRC does not match");
    }
    const std::uint64_t base =
        compression.empty() ? static_cast<std::uint64_t>(records.data() - bytes_.data()) : start;
    Cursor inner(records);
    while (!inner.at_end() && !file_.flaw) {
      const std::uint64_t offset = base + (compression.empty() ? inner.at() : 0);
      const auto opcode = static_cast<Opcode>(inner.number<std::uint8_t>());
      const std::string_view content = inner.take(inner.u64());
      if (!inner.good())
        return fail(offset, "edited or damaged: a record is longer than its chunk");
      inner_record(opcode, content, offset);
    }
  }

  void attachment(std::string_view content, std::uint64_t start) {
    Cursor in(content);
    in.u64();
    in.u64();
    const std::string name(in.text());
    Attachment found;
    found.offset = start;
    found.media_type = in.text();
    found.data = in.take(in.u64());
    const std::uint64_t covered = in.at();
    const std::uint32_t crc = in.u32();
    if (!in.good() || !in.at_end() || crc != crc32(content.substr(0, covered))) {
      return fail(start, "edited or damaged: an attachment's CRC does not match");
    }
    file_.attachments[name] = found;
  }

  void footer(Cursor& in, std::string_view content, std::uint64_t start) {
    const std::uint64_t summary_start = in.u64();
    in.u64();
    const std::uint32_t crc = in.u32();
    if (!in.good() || !in.at_end() || !data_end_seen_ || summary_start != summary_start_) {
      return fail(start, "edited or damaged: the footer does not point at the summary");
    }
    const std::uint64_t covered = start + kRecordHead + content.size() - 4 - summary_start;
    if (crc != crc32(bytes_.substr(summary_start, covered))) {
      return fail(start, "edited or damaged: the CRC of the summary does not match");
    }
    footer_seen_ = true;
  }

  void check_ending() {
    const std::string_view rest = bytes_.substr(at_);
    if (rest == kMagic) return;
    const bool cut = kMagic.starts_with(rest);
    fail(at_, cut ? "the file ends inside its last 8 bytes" : "bytes follow the footer", cut);
  }

  /// Number of messages in an incomplete chunk, including the one that is cut.
  static std::uint64_t count_lost(std::string_view begun) {
    Cursor in(begun);
    in.take(8 + 8 + 8 + 4);
    if (!in.text().empty()) return 0;  // compressed: unknown
    in.u64();
    std::uint64_t messages = 0;
    while (in.good() && !in.at_end()) {
      const auto opcode = static_cast<Opcode>(in.number<std::uint8_t>());
      in.take(in.u64());
      if (opcode == Opcode::kMessage) ++messages;
    }
    return messages;
  }

  std::string_view bytes_;
  std::uint64_t at_ = 0;
  std::uint64_t summary_start_ = 0;
  bool ended_ = false, data_end_seen_ = false, footer_seen_ = false;
  File file_;
};

}  // namespace

const Channel* File::find_channel(std::string_view topic, std::uint16_t& id) const {
  for (const auto& [key, channel] : channels) {
    if (channel.topic != topic) continue;
    id = key;
    return &channel;
  }
  return nullptr;
}

File parse(std::string_view bytes) {
  return Parser(bytes).run();
}

}  // namespace verp::record::mcap
