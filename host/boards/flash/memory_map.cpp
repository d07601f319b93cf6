#include "host/boards/flash/memory_map.hpp"

#include <fmt/format.h>

#include <charconv>
#include <regex>

#include "host/boards/flash/flash_error.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/whole.hpp"

namespace verp::flash {
namespace {

std::string read_script(const std::filesystem::path& file) {
  std::optional<std::string> script = files::read(file);
  if (!script) {
    throw FlashError(FlashError::Kind::kUsage,
                     file.string() +
                         ": cannot be read; verp flash needs the source tree it was "
                         "built from");
  }
  std::string& text = *script;
  for (std::size_t begin; (begin = text.find("/*")) != text.npos;) {
    const std::size_t end = text.find("*/", begin);
    text.erase(begin, end == text.npos ? end : end + 2 - begin);
  }
  return text;
}

class Script {
 public:
  explicit Script(const std::filesystem::path& file) : file_(file), text_(read_script(file)) {}

  /// Value of `name = ...;`, or `otherwise` if it is missing.
  std::uint32_t symbol(const std::string& name, std::uint32_t otherwise) const {
    std::smatch match;
    if (!std::regex_search(text_, match, std::regex("\\b" + name + "\\s*=\\s*([^;]*);"))) {
      return otherwise;
    }
    return value(match[1]);
  }

  Span memory(const std::string& name) const {
    std::smatch match;
    const std::regex line("\\b" + name +
                          "\\s*\\([rwx]+\\)\\s*:\\s*ORIGIN\\s*=\\s*([^,]*),\\s*LENGTH\\s*=\\s*"
                          "(\\S+)");
    if (!std::regex_search(text_, match, line)) not_understood("no " + name);
    return {value(match[1]), value(match[2])};
  }

 private:
  [[noreturn]] void not_understood(const std::string& what) const {
    throw FlashError(
        FlashError::Kind::kUsage,
        fmt::format("{}: {} that verp flash understands; see host/boards/flash/memory_map.hpp",
                    file_.string(), what));
  }

  std::uint32_t value(std::string text) const {
    static const std::regex choice("DEFINED\\s*\\(\\w+\\)\\s*\\?[^:]*:\\s*(.*)");
    std::smatch match;
    if (std::regex_match(text, match, choice)) text = match[1].str();
    while (!text.empty() && text.back() == ' ') text.pop_back();
    if (!text.empty() && (std::isalpha(static_cast<unsigned char>(text[0])) != 0)) {
      const std::uint32_t none = ~0U;
      const std::uint32_t found = symbol(text, none);
      if (found == none) not_understood("no value of '" + text + "'");
      return found;
    }
    const bool hex = text.starts_with("0x");
    std::uint32_t number = 0;
    const char* last = text.data() + text.size();
    const auto [end, error] =
        std::from_chars(text.data() + (hex ? 2 : 0), last, number, hex ? 16 : 10);
    if (error == std::errc() && end == last) return number;
    if (error == std::errc() && end + 1 == last && *end == 'K') return number << 10;
    if (error == std::errc() && end + 1 == last && *end == 'M') return number << 20;
    not_understood("no number in '" + text + "'");
  }

  std::filesystem::path file_;
  std::string text_;
};

}  // namespace

MemoryMap parse_memory_map(const std::filesystem::path& file) {
  const Script script(file);
  MemoryMap map{.code = script.memory("FLASH"), .ram = script.memory("RAM")};
  map.params = {script.symbol("verp_params_begin", 0), script.symbol("verp_params_bytes", 0)};
  map.actions = {script.symbol("verp_actions_begin", 0), script.symbol("verp_actions_bytes", 0)};
  return map;
}

MemoryMap read_memory_map(const std::string& board) {
  return parse_memory_map(files::source_dir() / "boards" / board / "memory.ld");
}

}  // namespace verp::flash
