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

struct Conversion {
  std::string text;
  std::size_t left = 0;  ///< bytes from the first that is no letter on
};

Conversion convert(std::string bytes, const char* from, const char* to) {
  Conversion out{std::string(3 * bytes.size() + 4, '\0'), bytes.size()};  // a byte is three at most
  char* in = bytes.data();
  char* end = out.text.data();
  std::size_t room = out.text.size();
  const iconv_t way = ::iconv_open(to, from);
  if (way != reinterpret_cast<iconv_t>(-1)) {
    ::iconv(way, &in, &out.left, &end, &room);
    ::iconv_close(way);
  }
  out.text.resize(out.text.size() - room);
  return out;
}

std::string converted(const std::string& path, std::string bytes, const char* from) {
  Conversion utf8 = convert(std::move(bytes), from, "UTF-8");
  if (utf8.left > 0) {
    refuse_encoding(path, line_at_byte(utf8.text, utf8.text.size()),
                    std::string("what follows here is no ") + from);
  }
  return std::move(utf8.text);
}

const char* narrow_encoding(const std::string& name) {
  for (const char* const each : {"iso-8859-1", "iso8859-1", "iso_8859-1", "latin1", "latin-1"})
    if (name == each) return "ISO-8859-1";
  return name == "windows-1252" || name == "cp1252" ? "CP1252" : nullptr;
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
  const std::size_t left = convert(text, "UTF-8", "UTF-16LE").left;  // all letters have a UTF-16
  if (left == 0) return;
  throw LoadError(path, line_at_byte(text, text.size() - left), "a letter here is no UTF-8",
                  "save it as UTF-8, or name its encoding: <?xml version=\"1.0\" "
                  "encoding=\"ISO-8859-1\"?>");
}

}  // namespace verp::model
