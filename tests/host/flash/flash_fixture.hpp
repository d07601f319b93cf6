#pragma once
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "common/model/image.hpp"
#include "host/author/action/folder.hpp"
#include "host/author/action/kept.hpp"
#include "host/boards/flash/memory_map.hpp"
#include "host/robot/model/export.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"
#include "tests/host/flash/boot_loader_port.hpp"
#include "tests/host/tool/program.hpp"

/// In a firmware build, VERP_TEST_BOARD and VERP_FIRMWARE_DIR name the board and its real image.
namespace verp::flash::test {

namespace fs = std::filesystem;
using verp::test::BootLoaderPort;
using verp::test::RomBootLoader;
using Bytes = std::vector<std::uint8_t>;
using tool::test::Outcome;
using tool::test::slurp;

class Flash : public tool::test::Program {
 protected:
  Flash() {
    if (const char* name = std::getenv("VERP_TEST_BOARD")) board_ = name;
    recipe_ = &find_recipe(board_);
    map_ = read_memory_map(board_);
    const char* firmware = std::getenv("VERP_FIRMWARE_DIR");
    firmware_ = firmware != nullptr ? fs::path(firmware) : folder_;
    if (firmware == nullptr) {
      put(image(), made_up_code(7));
      put(image("loop_can_"), made_up_code(8));
    }
    ::setenv("VERP_FLASH_DIR", (folder_ / "work").c_str(), 1);
    ::setenv("VERP_FIRMWARE_DIR", firmware_.c_str(), 1);
  }
  ~Flash() override {
    ::unsetenv("VERP_FLASH_DIR");
    if (firmware_ == folder_) ::unsetenv("VERP_FIRMWARE_DIR");
  }

  /// "loop_": serial servos; "loop_can_": CAN drives.
  fs::path image(const std::string& kind = "loop_") const {
    return firmware_ / (kind + board_ + ".bin");
  }
  static void put(const fs::path& file, const Bytes& bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  static Bytes get(const fs::path& file) {
    const std::string text = slurp(file);
    return {text.begin(), text.end()};
  }
  static Bytes noise(std::size_t bytes, unsigned seed) {
    std::minstd_rand random(seed);
    Bytes data(bytes);
    for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(random() >> 8);
    return data;
  }
  Bytes made_up_code(unsigned seed) const {
    Bytes code = noise(50'000, seed);
    const std::uint32_t table[] = {map_.ram.begin + 4096, map_.code.begin + 0x201};
    std::memcpy(code.data(), table, sizeof table);
    return code;
  }
  static Bytes robot(const std::string& bus = "") {
    const ParamsImage image =
        model::make_image(model::load_robot(model::find_model("generic21"), bus));
    const auto* first = reinterpret_cast<const std::uint8_t*>(&image);
    return {first, first + sizeof image};
  }

  static Bytes actions(const std::string& name = "generic21") {
    const model::Entity entity = model::load_robot(model::find_model(name), "");
    const Params params = model::make_params(entity);
    return action::kept_image(
        action::make_library(params, action::read_folder(action::folder_of(entity.file))), params);
  }

  RomBootLoader::Chip chip() const {
    RomBootLoader::Chip made{.device_id = recipe_->chip->device_id};
    for (const SectorRun& run : recipe_->chip->sectors) {
      made.sector_bytes.insert(made.sector_bytes.end(), run.count, run.bytes);
    }
    return made;
  }
  static RomBootLoader used(const RomBootLoader::Chip& chip) {
    RomBootLoader loader(chip);
    loader.flash = noise(loader.flash.size(), 3);
    return loader;
  }
  static Bytes part(const RomBootLoader& chip, const Span& span) {
    const auto begin = chip.flash.begin() + (span.begin - kFlashBegin);
    return {begin, begin + span.bytes};
  }

  Outcome flash(const std::string& arguments) const {
    return verp("flash --board " + board_ + " " + arguments);
  }
  /// Exit 3, no stdout, one line on stderr with `needle`.
  static void expect_trouble(const Outcome& outcome, const std::string& needle) {
    EXPECT_EQ(outcome.status, 3) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(needle), std::string::npos) << outcome.err;
  }

  std::string board_ = "olimex_h405";
  const Recipe* recipe_;
  MemoryMap map_;
  fs::path firmware_;
};

}  // namespace verp::flash::test
