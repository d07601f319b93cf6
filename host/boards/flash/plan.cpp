#include "host/boards/flash/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "host/boards/flash/flash_error.hpp"
#include "host/boards/flash/images.hpp"

namespace verp::flash {
namespace {

using Words = std::vector<std::string>;

/// DBGMCU_IDCODE of all ST Cortex-M3 to M7 (RM0090 38.6.1).
constexpr const char* kReadDeviceId =
    "echo [format {Device ID: 0x%04x} [expr {[lindex [read_memory 0xe0042000 32 1] 0] & 0xfff}]]";

Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A network's or a test's port has no parity, but stm32flash insists on it; the boot loader's even
/// parity is set at the real line.
bool is_pseudo_terminal(const std::string& port) {
  std::error_code error;
  return std::filesystem::weakly_canonical(port, error).string().starts_with("/dev/pts/");
}

/// OpenOCD's commands are Tcl: braces make one word of any text but these characters. Throws
/// FlashError.
void require_tcl_word(const std::string& word, const std::string& remedy) {
  const bool odd = std::any_of(word.begin(), word.end(), [](unsigned char each) {
    return each < ' ' || each == 0x7F || each == '{' || each == '}' || each == '\\';
  });
  if (!odd) return;
  throw FlashError(FlashError::Kind::kUsage,
                   fmt::format("{}: OpenOCD takes no braces, backslashes or control characters; {}",
                               word, remedy));
}

/// Command lines of one tool; addresses are absolute.
class Commands {
 public:
  explicit Commands(const Job& job) : job_(job) {}

  Words check_chip() const {
    switch (job_.tool) {
      case Tool::kOpenocd:
        return with(base(), {"-c", std::string("init; ") + kReadDeviceId + "; shutdown"});
      case Tool::kStm32flash:  // a read, because Get ID also succeeds under readout protection
        return read({kFlashBegin, 256}, job_.folder / "first.bin");
      case Tool::kDfuUtil:
        return with(base(), {"-l"});
    }
    return {};
  }

  Words read(const Span& from, const std::filesystem::path& to) const {
    switch (job_.tool) {
      case Tool::kOpenocd:
        return with(base(), {"-c", fmt::format("init; reset halt; dump_image {{{}}} {:#010x} {}; "
                                               "shutdown",
                                               to.string(), from.begin, from.bytes)});
      case Tool::kStm32flash:
        return with(base(), {"-r", to.string(), "-S", place(from), job_.port});
      case Tool::kDfuUtil:
        return with(base(), {"-a", "0", "-s", place(from), "-U", to.string()});
    }
    return {};
  }

  Words write(const std::filesystem::path& file, const Span& to) const {
    switch (job_.tool) {
      case Tool::kOpenocd:
        return with(base(), {"-c", fmt::format("program {{{}}} {:#010x} verify reset exit",
                                               file.string(), to.begin)});
      case Tool::kStm32flash:
        return with(base(), {"-w", file.string(), "-v", "-S", place(to), job_.port});
      case Tool::kDfuUtil:
        return with(base(),
                    {"-a", "0", "-s", fmt::format("{:#010x}", to.begin), "-D", file.string()});
    }
    return {};
  }

 private:
  static std::string place(const Span& span) {
    return fmt::format("{:#010x}:{}", span.begin, span.bytes);
  }

  Words base() const {
    switch (job_.tool) {
      case Tool::kOpenocd: {
        Words words = {"openocd", "-f", job_.recipe.probe};
        if (!job_.port.empty()) {
          words = with(words, {"-c", fmt::format("adapter serial {{{}}}", job_.port)});
        }
        // No servers: no conflict with another copy or a debugger.
        return with(words, {"-f", job_.recipe.chip->openocd_target, "-c",
                            "gdb_port disabled; tcl_port disabled; telnet_port disabled"});
      }
      case Tool::kStm32flash:
        return is_pseudo_terminal(job_.port) ? Words{"stm32flash", "-b", "115200", "-m", "8n1"}
                                             : Words{"stm32flash", "-b", "115200"};
      case Tool::kDfuUtil: {
        Words words = {"dfu-util", "-d", "0483:df11"};
        return job_.port.empty() ? words : with(words, {"-S", job_.port});
      }
    }
    return {};
  }

  const Job& job_;
};

/// True if writing destroys only what the pieces replace.
bool owns(const Job& job, const Span& sectors, const std::vector<Piece>& pieces) {
  const Span regions[] = {job.map.code, job.map.params, job.map.actions};
  const auto inside = std::count_if(std::begin(regions), std::end(regions), [&](const Span& each) {
    return each.bytes > 0 && each.overlaps(sectors);
  });
  return pieces.size() == 1 && inside == 1;
}

std::string names(const std::vector<Piece>& pieces) {
  std::string text;
  for (const Piece& piece : pieces) text += (text.empty() ? "" : " and ") + piece.what;
  return text;
}

void add_write(std::vector<Step>& steps, const Job& job, const std::string& what,
               const std::filesystem::path& file, std::uint32_t bytes, const Span& to) {
  const Commands commands(job);
  const bool verifies = job.tool != Tool::kDfuUtil;
  steps.push_back({Step::Kind::kWrite,
                   fmt::format("writing {}{}", verifies ? "and verifying " : "", what),
                   commands.write(file, to)});
  if (verifies) return;
  const auto back = job.folder / fmt::format("back_{:08x}.bin", to.begin);
  steps.push_back({Step::Kind::kReadBack, "reading back " + what,
                   commands.read({to.begin, bytes}, back), back, bytes});
  steps.push_back(
      {Step::Kind::kCompare, "verifying " + what, {"cmp", file.string(), back.string()}});
}

std::vector<Piece> neighbours(const Job& job, const Span& sectors,
                              const std::vector<Piece>& pieces) {
  std::vector<Piece> others;
  for (const Piece& each : {Piece{"params", job.folder / "kept_params.bin", job.map.params},
                            Piece{"actions", job.folder / kKeptActions, job.map.actions}}) {
    const bool replaced = std::any_of(pieces.begin(), pieces.end(), [&](const Piece& piece) {
      return piece.region.begin == each.region.begin;
    });
    if (each.region.bytes > 0 && each.region.overlaps(sectors) && !replaced) others.push_back(each);
  }
  return others;
}

void add_pieces(std::vector<Step>& steps, const Job& job, const Span& sectors,
                const std::vector<Piece>& pieces) {
  if (owns(job, sectors, pieces)) {
    return add_write(steps, job, pieces[0].what, pieces[0].file,
                     static_cast<std::uint32_t>(std::filesystem::file_size(pieces[0].file)),
                     pieces[0].region);
  }
  const auto sector = job.folder / fmt::format("sector_{:08x}.bin", sectors.begin);
  steps.push_back({Step::Kind::kRead, "reading what shares a sector with the " + names(pieces),
                   Commands(job).read(sectors, sector), sector, sectors.bytes});
  for (const Piece& piece : pieces) {
    steps.push_back({Step::Kind::kCompose,
                     "putting in the " + piece.what,
                     {"dd", "if=" + piece.file.string(), "of=" + sector.string(),
                      fmt::format("seek={}", piece.region.begin - sectors.begin),
                      "oflag=seek_bytes", "conv=notrunc", "status=none"}});
  }
  const std::size_t write = steps.size();
  add_write(steps, job, names(pieces), sector, sectors.bytes, sectors);
  steps[write].neighbours = neighbours(job, sectors, pieces);
  steps[write].file = sector;
  steps[write].sectors = sectors;
}

}  // namespace

Tool choose_tool(const Recipe& recipe, const std::string& asked, const std::string& port) {
  std::string ways;
  for (const Tool tool : recipe.tools)
    ways += (ways.empty() ? "" : ", ") + std::string(name_of(tool));
  const std::string wanted =
      asked.empty() ? port.starts_with('/') ? "stm32flash" : name_of(recipe.tools.front()) : asked;
  const auto found = std::find_if(recipe.tools.begin(), recipe.tools.end(),
                                  [&](Tool tool) { return wanted == name_of(tool); });
  if (found == recipe.tools.end()) {
    throw FlashError(
        FlashError::Kind::kUsage,
        fmt::format("{} is not flashed by {}; give --tool one of: {}", recipe.board, wanted, ways));
  }
  if (*found == Tool::kStm32flash && port.empty()) {
    throw FlashError(FlashError::Kind::kUsage,
                     fmt::format("stm32flash needs the serial port at the chip's {}; give it, for "
                                 "example --port /dev/ttyUSB0",
                                 recipe.serial_pins));
  }
  if (*found != Tool::kStm32flash && port.starts_with('/')) {
    throw FlashError(
        FlashError::Kind::kUsage,
        fmt::format("--port {}: {} takes the serial number of a {}, no path; leave it out where "
                    "only one is connected, or give --tool stm32flash",
                    port, name_of(*found),
                    *found == Tool::kOpenocd ? "debug probe" : "USB device"));
  }
  return *found;
}

std::vector<Step> plan(const Job& job) {
  if (job.tool == Tool::kOpenocd) {
    require_tcl_word(job.port, "give --port the debug probe's serial number");
    require_tcl_word(job.folder.string(), "set VERP_FLASH_DIR to another folder");
    for (const Piece& piece : job.pieces) {
      require_tcl_word(piece.file.string(), "give the file another name or place");
    }
  }
  std::vector<Step> steps = {
      {Step::Kind::kCheckChip, "checking the chip", Commands(job).check_chip()}};
  std::map<std::uint32_t, std::vector<Piece>> groups;  // by first sector
  for (const Piece& piece : job.pieces) {
    groups[sectors_around(*job.recipe.chip, piece.region).begin].push_back(piece);
  }
  for (const auto& [begin, pieces] : groups) {
    add_pieces(steps, job, sectors_around(*job.recipe.chip, pieces[0].region), pieces);
  }
  return steps;
}

}  // namespace verp::flash
