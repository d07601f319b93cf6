#include "host/robot/model/encoding.hpp"

#include <iconv.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "host/robot/model/load_error.hpp"

namespace verp::model {
namespace {

int line_at_byte(std::string_view text, std::size_t at) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size()));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

/// The name between the quotes after encoding= in the first line's declaration.
struct NamedEncoding {
  std::size_t at = 0, count = 0;
  std::string name;  ///< small letters; empty: none
};

NamedEncoding named_encoding(const std::string& text) {
  const std::size_t begin = text.find("<?xml"), end = text.find("?>");
  std::size_t at = text.find("encoding", begin);
  if (begin > 3 || end == text.npos || at > end) return {};
  at = std::min(text.find_first_of("'\"", at), end) + 1;
  const std::size_t count = std::min(text.find_first_of("'\"?", at), end) - std::min(at, end);
  NamedEncoding out{at, count, text.substr(at, count)};
  for (char& c : out.name) {
    const auto byte = static_cast<unsigned char>(c);
    c = byte > ' ' && byte <= '~' ? static_cast<char>(std::tolower(byte)) : '?';
  }
  return out;
}

/// By the mark at the begin, or the width of the first '<'. Null: one byte is a letter.
const char* wide_encoding(std::string_view bytes) {
  using namespace std::string_view_literals;
  for (const std::string_view begin :
       {"\xFF\xFE\0\0"sv, "\0\0\xFE\xFF"sv, "<\0\0\0"sv, "\0\0\0<"sv})
    if (bytes.starts_with(begin)) return "UTF-32";
  if (bytes.starts_with("\xFF\xFE"sv) || bytes.starts_with("<\0"sv)) return "UTF-16LE";
  if (bytes.starts_with("\xFE\xFF"sv) || bytes.starts_with("\0<"sv)) return "UTF-16BE";
  return nullptr;
}

[[noreturn]] void refuse_encoding(const std::string& path, int line, const std::string& why) {
  throw LoadError(path, line, why, "save it as UTF-8");
}

std::string converted(const std::string& path, std::string bytes, const char* from) {
  std::string out(3 * bytes.size() + 4, '\0');  // a byte is three at most
  char* in = bytes.data();
  char* to = out.data();
  std::size_t left = bytes.size(), room = out.size();
  const iconv_t way = ::iconv_open("UTF-8", from);
  bool whole = way != reinterpret_cast<iconv_t>(-1);
  if (whole) {
    whole = ::iconv(way, &in, &left, &to, &room) != static_cast<std::size_t>(-1);
    ::iconv_close(way);
  }
  out.resize(out.size() - room);
  if (!whole) {
    refuse_encoding(path, line_at_byte(out, out.size()),
                    std::string("what follows here is no ") + from);
  }
  return out;
}

const char* narrow_encoding(const std::string& name) {
  for (const char* const each : {"iso-8859-1", "iso8859-1", "iso_8859-1", "latin1", "latin-1"})
    if (name == each) return "ISO-8859-1";
  return name == "windows-1252" || name == "cp1252" ? "CP1252" : nullptr;
}

/// The length of the character that begins at `at`; 0: it is no UTF-8. By the table of RFC 3629.
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U;
  };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xC2   ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0U) != 0x80) return 0;
  const bool too_long = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool no_letter = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return too_long || no_letter ? 0 : length;
}

}  // namespace

std::string utf8_of(const std::string& path, std::string bytes) {
  const char* from = wide_encoding(bytes);
  if (from != nullptr && std::string_view(from) == "UTF-32")
    refuse_encoding(path, 1, "UTF-32 is not read here");
  if (from != nullptr) bytes = converted(path, std::move(bytes), from);
  const NamedEncoding named = named_encoding(bytes);
  const bool is_ascii = std::none_of(bytes.begin(), bytes.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0x80U) != 0;
  });
  if (from == nullptr) {
    if (is_ascii || named.name.empty()) return bytes;
    from = narrow_encoding(named.name);
    // Files that say UTF-16 and are UTF-8 come from programs that wrote them to a string.
    if (from == nullptr && (named.name.starts_with("utf") || named.name.ends_with("ascii")))
      return bytes;
    if (from == nullptr)
      refuse_encoding(path, line_at_byte(bytes, named.at),
                      "its encoding, '" + named.name + "', is not read here");
    bytes = converted(path, std::move(bytes), from);
  }
  if (named.count > 0) bytes.replace(named.at, named.count, "UTF-8");
  return bytes;
}

void require_utf8(const std::string& path, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0)
      throw LoadError(path, line_at_byte(text, at), "a letter here is no UTF-8",
                      "save it as UTF-8, or name its encoding: <?xml version=\"1.0\" "
                      "encoding=\"ISO-8859-1\"?>");
    at += length;
  }
}

}  // namespace verp::model
