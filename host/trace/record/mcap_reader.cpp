#include "host/trace/record/mcap_reader.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

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

/// A stream that knows its size.
class Source {
 public:
  explicit Source(std::unique_ptr<std::istream> in) : in_(std::move(in)) {
    in_->seekg(0, std::ios::end);
    const std::streamoff end = in_->tellg();
    if (end > 0) size_ = static_cast<std::uint64_t>(end);
  }

  std::uint64_t size() const { return size_; }
  std::uint64_t at() const { return at_; }
  void seek(std::uint64_t at) {
    in_->clear();
    in_->seekg(static_cast<std::streamoff>(at));
    at_ = at;
  }
  /// Fewer bytes at the end.
  void take(std::uint64_t size, std::string& to) {
    to.resize(std::min(size, size_ - std::min(at_, size_)));
    in_->read(to.data(), static_cast<std::streamsize>(to.size()));
    to.resize(static_cast<std::size_t>(in_->gcount()));
    at_ += to.size();
  }

 private:
  std::unique_ptr<std::istream> in_;
  std::uint64_t size_ = 0, at_ = 0;
};

}  // namespace

class Reader::Parser {
 public:
  Parser(std::unique_ptr<std::istream> in, Damage damage)
      : in_(std::move(in)), goes_on_(damage == Damage::kLeftOut) {}

  const File& file() const { return file_; }
  File take() && { return std::move(file_); }
  const File& run(const OnMessage& on_message) {
    // A damaged chunk may declare channels that only the summary repeats.
    if (goes_on_ && !declared_) pass({});
    declared_ = goes_on_;
    return pass(on_message);
  }
  void run_part(std::uint64_t part, const OnMessage& on_message) {
    on_message_ = &on_message;
    const std::uint64_t messages = file_.messages;
    std::optional<Flaw> flaw = std::exchange(file_.flaw, std::nullopt);
    std::optional<Flaw> end = std::exchange(file_.end, std::nullopt);
    in_.seek(part);
    top_level_record();
    file_.messages = messages;
    // A truncated chunk is one again.
    if (!file_.flaw || flaw) file_.flaw = std::move(flaw);
    if (!file_.end || end) file_.end = std::move(end);
  }

 private:
  const File& pass(const OnMessage& on_message) {
    const File before = std::exchange(file_, File());
    kept_bytes_ = 0;
    if (declared_) keep_declarations(before);
    crc_ = 0;
    data_ended_ = footer_seen_ = false;
    on_message_ = &on_message;
    std::string magic;
    in_.seek(in_.size() - std::min<std::uint64_t>(in_.size(), kMagic.size()));
    in_.take(kMagic.size(), magic);
    ended_ = in_.size() >= 2 * kMagic.size() && magic == kMagic;
    in_.seek(0);
    in_.take(kMagic.size(), magic);
    crc_ = crc32(magic);
    if (magic != kMagic) {
      const bool cut = kMagic.starts_with(magic);
      fail(0, cut ? "the file ends inside its first 8 bytes" : "not an MCAP file (wrong magic)",
           cut);
    }
    while (!file_.end && !footer_seen_) top_level_record();
    if (!file_.end) check_ending();
    return file_;
  }

  /// Nothing is read after it.
  void fail(std::uint64_t offset, std::string what, bool truncated = false) {
    if (file_.end) return;
    file_.end = Flaw{offset, std::move(what), truncated, false};
    if (!file_.flaw) file_.flaw = file_.end;
  }
  /// A record whose content is damaged; reading goes on behind it if its length can be believed.
  void leave_out(std::uint64_t offset, const std::string& what) {
    if (!goes_on_ || !begins_record(in_.at())) return fail(offset, what);
    if (!file_.flaw) file_.flaw = Flaw{offset, what, false, false};
    ++file_.left_out.records;
    file_.left_out.bytes += in_.at() - offset;
  }
  bool begins_record(std::uint64_t at) {
    std::string head;
    in_.take(kRecordHead, head);
    in_.seek(at);
    Cursor in(head);
    const auto opcode = static_cast<Opcode>(in.number<std::uint8_t>());
    const std::uint64_t length = in.u64();
    return in.good() && opcode >= Opcode::kChunk && opcode <= Opcode::kDataEnd &&
           length <= in_.size() - at - kRecordHead;
  }
  void overrun(std::uint64_t offset) {
    fail(offset, "edited or damaged: a record's fields overrun it");
  }

  /// False: what the File holds became too much.
  bool may_keep(std::size_t bytes, std::uint64_t offset) {
    kept_bytes_ += bytes + sizeof(std::string);
    if (kept_bytes_ > kMostRecord)
      fail(offset, too_much("its channels, metadata and attachments take", kept_bytes_));
    return kept_bytes_ <= kMostRecord;
  }
  /// A copy that lives as long as the File; empty: too much.
  std::string_view keep(std::string_view text, std::uint64_t offset) {
    return may_keep(text.size(), offset) ? std::string_view(file_.texts.emplace_back(text)) : "";
  }

  void keep_declarations(const File& of) {
    for (const auto& [id, each] : of.schemas)
      file_.schemas[id] = {keep(each.name, 0), keep(each.encoding, 0), keep(each.data, 0)};
    for (const auto& [id, each] : of.channels)
      file_.channels[id] = {each.schema, keep(each.topic, 0), keep(each.encoding, 0)};
  }

  void top_level_record() {
    const std::uint64_t start = in_.at();
    const std::uint64_t left = in_.size() - start;
    if (left == 0 && !ended_) return fail(start, "the file ends here, without its summary", true);
    in_.take(kRecordHead, head_);
    Cursor head(head_);
    const auto opcode = static_cast<Opcode>(head.number<std::uint8_t>());
    const std::uint64_t length = head.u64();
    if (head.good() && length <= left - kRecordHead) {
      if (length > kMostRecord) return fail(start, too_much("a record takes", length));
      in_.take(length, content_);
      if (content_.size() != length) return fail(start, "the file cannot be read");
      record(opcode, content_, start);
      if (opcode == Opcode::kDataEnd) return;
      crc_ = crc32(content_, crc32(head_, crc_));
      return;
    }
    if (ended_) return fail(start, "a record is longer than the file");
    if (head.good() && opcode == Opcode::kChunk) {
      const std::optional<Flaw> before = file_.flaw;
      in_.take(kMostRecord, content_);
      truncated_chunk(content_, start);
      file_.flaw = before;
      file_.end.reset();
    }
    const bool first = !file_.flaw;
    fail(start, "the file ends inside a record", true);
    file_.end->in_chunk = opcode == Opcode::kChunk;
    if (first) file_.flaw = file_.end;
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
        return inner_record(opcode, content, start, start);
      case Opcode::kChunk:
        return chunk(in, start);
      case Opcode::kAttachment:
        return attachment(content, start);
      case Opcode::kMetadata: {
        const std::string name(in.text());
        if (!may_keep(content.size(), start)) return;
        file_.metadata[name] = in.map();
        break;
      }
      case Opcode::kDataEnd:
        data_ended(in.u32(), start);
        break;
      case Opcode::kFooter:
        return footer(in, content, start);
      default:
        if (opcode > Opcode::kDataEnd || opcode == Opcode{0}) fail(start, "unknown record type");
        return;  // indexes and statistics repeat the data section; CRCs cover them
    }
    if (!in.good() || !in.at_end()) overrun(start);
  }

  void data_ended(std::uint32_t crc, std::uint64_t start) {
    const bool gap = file_.left_out.records > 0;
    if (crc != crc_ && !gap) {
      return fail(start, "edited or damaged: the CRC of all bytes before this one does not match");
    }
    file_.data_whole = !gap;
    data_ended_ = true;
    crc_ = 0;
    summary_start_ = in_.at();
  }

  void inner_record(Opcode opcode, std::string_view content, std::uint64_t start,
                    std::uint64_t part) {
    Cursor in(content);
    const std::uint16_t id = in.u16();
    if (opcode == Opcode::kSchema) {
      const Schema schema{in.text(), in.text(), in.text()};
      declare(file_.schemas, id, schema, content, start);
    } else if (opcode == Opcode::kChannel) {
      const Channel channel{in.u16(), in.text(), in.text()};
      in.map();
      if (!file_.schemas.contains(channel.schema))
        return fail(start, "channel " + std::to_string(id) + " has a schema that nothing declares");
      declare(file_.channels, id, channel, content, start);
    } else if (opcode == Opcode::kMessage) {
      message(in,
              {.channel = id,
               .sequence = in.u32(),
               .time_ns = in.u64(),
               .data = {},
               .offset = start,
               .part = part},
              content);
    } else {
      return fail(start, "edited or damaged: a chunk holds a record that does not belong there");
    }
    if (!in.good() || !in.at_end()) overrun(start);
  }

  void message(Cursor& in, Message message, std::string_view content) {
    in.u64();
    message.data = in.take(content.size() - in.at());
    if (!in.good()) return;
    if (!file_.channels.contains(message.channel)) {
      if (file_.left_out.records > 0) {
        ++file_.left_out.messages;
        return;
      }
      return fail(message.offset, "a message of channel " + std::to_string(message.channel) +
                                      ", which nothing declares");
    }
    ++file_.messages;
    if (*on_message_) (*on_message_)(file_, message);
  }

  /// A declaration may come again, as in the summary, but no other one of that number.
  template <class Declared>
  void declare(std::map<std::uint16_t, Declared>& all, std::uint16_t id, const Declared& declared,
               std::string_view content, std::uint64_t start) {
    const auto found = all.find(id);
    if (found == all.end()) {
      // The same fields of a copy.
      Cursor in(keep(content, start));
      if (file_.end) return;
      in.u16();
      all[id] = read<Declared>(in);
    } else if (!(found->second == declared)) {
      fail(start, "number " + std::to_string(id) + " is declared twice, each time otherwise");
    }
  }
  template <class Declared>
  static Declared read(Cursor& in) {
    if constexpr (std::is_same_v<Declared, Schema>)
      return {in.text(), in.text(), in.text()};
    else
      return {in.u16(), in.text(), in.text()};
  }

  void chunk(Cursor& in, std::uint64_t start) {
    in.u64();
    in.u64();
    const std::uint64_t size = in.u64();
    const std::uint32_t crc = in.u32();
    const std::string_view compression = in.text();
    std::string_view records = in.take(in.u64());
    if (!in.good() || !in.at_end()) {
      return leave_out(start, "edited or damaged: a chunk's fields overrun it");
    }
    if (!compression.empty() && compression != kZstdName) {
      return leave_out(start, "a chunk is compressed by " + std::string(compression) +
                                  ", and zstd alone is known here");
    }
    if (size > kMostRecord) return leave_out(start, too_much("a chunk takes", size));
    if (!compression.empty()) {
      auto unpacked = mcap::unpacked(compression, records, size);
      if (!unpacked) {
        return leave_out(start, "edited or damaged: a compressed chunk is not the " +
                                    std::to_string(size) + " bytes that it says");
      }
      unpacked_ = std::move(*unpacked);
      records = unpacked_;
    }
    if (size != records.size() || crc != crc32(records)) {
      return leave_out(start, "edited or damaged: a chunk's CRC does not match");
    }
    Cursor inner(records);
    while (!inner.at_end() && !file_.end) {
      const std::uint64_t offset =
          compression.empty() ? in_.at() - records.size() + inner.at() : start;
      const auto opcode = static_cast<Opcode>(inner.number<std::uint8_t>());
      const std::string_view content = inner.take(inner.u64());
      if (!inner.good())
        return fail(offset, "edited or damaged: a record is longer than its chunk");
      inner_record(opcode, content, offset, start);
    }
  }

  /// Keeps its whole records. A compressed chunk cannot be unpacked without its end.
  void truncated_chunk(std::string_view begun, std::uint64_t start) {
    Cursor in(begun);
    in.take(8 + 8 + 8 + 4);
    if (!in.text().empty()) return;
    in.u64();
    while (in.good() && !in.at_end() && !file_.end) {
      const std::uint64_t offset = start + kRecordHead + in.at();
      const auto opcode = static_cast<Opcode>(in.number<std::uint8_t>());
      const std::string_view content = in.take(in.u64());
      if (in.good()) inner_record(opcode, content, offset, start);
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
      return leave_out(start, "edited or damaged: an attachment's CRC does not match");
    }
    found.media_type = keep(found.media_type, start);
    found.data = keep(found.data, start);
    file_.attachments[name] = found;
  }

  void footer(Cursor& in, std::string_view content, std::uint64_t start) {
    const std::uint64_t summary_start = in.u64();
    in.u64();
    const std::uint32_t crc = in.u32();
    if (!in.good() || !in.at_end() || !data_ended_ || summary_start != summary_start_) {
      return fail(start, "edited or damaged: the footer does not point at the summary");
    }
    if (crc != crc32(content.substr(0, content.size() - 4), crc32(head_, crc_))) {
      return fail(start, "edited or damaged: the CRC of the summary does not match");
    }
    footer_seen_ = true;
  }

  void check_ending() {
    const std::uint64_t at = in_.at();
    std::string rest;
    in_.take(kMagic.size() + 1, rest);
    if (rest == kMagic) return;
    const bool cut = kMagic.starts_with(rest);
    fail(at, cut ? "the file ends inside its last 8 bytes" : "bytes follow the footer", cut);
  }

  static std::string too_much(const std::string& what, std::uint64_t bytes) {
    return what + " " + std::to_string(bytes) + " bytes, and the most is " +
           std::to_string(kMostRecord);
  }

  Source in_;
  File file_;
  const OnMessage* on_message_ = nullptr;
  std::string head_, content_, unpacked_;
  std::uint64_t kept_bytes_ = 0, summary_start_ = 0;
  std::uint32_t crc_ = 0;  ///< of the data section, then of the summary
  bool ended_ = false, data_ended_ = false, footer_seen_ = false;
  const bool goes_on_;     ///< behind damaged chunks
  bool declared_ = false;  ///< the File has all declarations of an earlier pass
};

Reader::Reader(std::unique_ptr<std::istream> in, Damage damage)
    : parser_(new Parser(std::move(in), damage)) {}
Reader::~Reader() = default;
Reader::Reader(Reader&&) noexcept = default;

const File& Reader::read(const OnMessage& on_message) {
  return parser_->run(on_message);
}

void Reader::read_part(std::uint64_t part, const OnMessage& on_message) {
  parser_->run_part(part, on_message);
}

const File& Reader::file() const {
  return parser_->file();
}

File Reader::take() && {
  return std::move(*parser_).take();
}

const Channel* File::find_channel(std::string_view topic, std::uint16_t& id) const {
  for (const auto& [key, channel] : channels) {
    if (channel.topic != topic) continue;
    id = key;
    return &channel;
  }
  return nullptr;
}

}  // namespace verp::record::mcap
