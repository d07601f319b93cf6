#include "host/boards/flash/plan.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "host/boards/flash/flash_error.hpp"
#include "host/os/files/shell_line.hpp"
#include "host/os/files/temporary_directory.hpp"

namespace verp::flash::test {
namespace {

class PlanRunner {
 public:
  void run(const Step& step) {
    const std::string words = files::shell_line(step.command);
    if (step.kind == Step::Kind::kRead) read_.push_back(step.file.string());
    if (step.kind == Step::Kind::kCompose) composed_.push_back(words);
    if (step.kind != Step::Kind::kWrite) return;
    EXPECT_TRUE(checked_) << "wrote before the chip was checked";
    wrote_.push_back(words);
    for (const std::string& file : read_) {
      if (words.find(file) != std::string::npos) restored_.push_back(file);
    }
  }
  void run(const std::vector<Step>& steps) {
    checked_ = !steps.empty() && steps.front().kind == Step::Kind::kCheckChip;
    for (const Step& step : steps) run(step);
  }
  const std::vector<std::string>& wrote() const { return wrote_; }
  const std::vector<std::string>& composed() const { return composed_; }
  const std::vector<std::string>& restored() const { return restored_; }

 private:
  bool checked_ = false;
  std::vector<std::string> read_, composed_, wrote_, restored_;
};

class Plan : public ::testing::Test {
 protected:
  Plan() { std::ofstream(file_) << "some bytes"; }

  Job job(const Recipe& recipe, Tool tool, unsigned choice) const {
    Job made{recipe, read_memory_map(recipe.board), tool, "", {}, folder_.path()};
    if (tool == Tool::kStm32flash) made.port = "/dev/ttyUSB0";
    const std::array<Piece, 3> all = {Piece{"code", file_, made.map.code},
                                      Piece{"robot", file_, made.map.params},
                                      Piece{"actions", file_, made.map.actions}};
    for (unsigned i = 0; i < all.size(); ++i) {
      if ((choice >> i & 1U) != 0) made.pieces.push_back(all[i]);
    }
    return made;
  }
  template <class Check>
  void for_each_job(const Check& check) const {
    for (const Recipe& recipe : recipes()) {
      for (const Tool tool : recipe.tools) {
        for (unsigned choice = 1; choice < 8; ++choice) {
          SCOPED_TRACE(std::string(recipe.board) + ", " + name_of(tool) + ", pieces " +
                       std::to_string(choice));
          check(job(recipe, tool, choice));
        }
      }
    }
  }

  files::TemporaryDirectory folder_;
  std::filesystem::path file_ = folder_.path() / "piece.bin";
};

std::string address(std::uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%08x", value);
  return text;
}

TEST_F(Plan, WritesEachPieceAndReadsWhatSharesItsSectorsFirst) {
  for_each_job([](const Job& job) {
    PlanRunner runner;
    runner.run(plan(job));
    bool shared = false;
    for (const Piece& piece : job.pieces) {
      const Span sectors = sectors_around(*job.recipe.chip, piece.region);
      const bool alone = piece.what == "code" || !job.map.params.overlaps(sectors) ||
                         !job.map.actions.overlaps(sectors);
      const std::string begin = address(alone ? piece.region.begin : sectors.begin);
      EXPECT_TRUE(std::any_of(
          runner.wrote().begin(), runner.wrote().end(),
          [&](const std::string& words) { return words.find(begin) != std::string::npos; }))
          << piece.what << " at " << begin;
      shared |= !alone;
    }
    EXPECT_EQ(runner.restored().size(), shared ? 1u : 0u);
    EXPECT_EQ(runner.composed().empty(), !shared);
  });
}

TEST_F(Plan, EveryWriteIsVerified) {
  for_each_job([](const Job& job) {
    const std::vector<Step> steps = plan(job);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i].kind != Step::Kind::kWrite) continue;
      const std::string words = files::shell_line(steps[i].command);
      if (job.tool == Tool::kDfuUtil) {
        ASSERT_LT(i + 2, steps.size());
        EXPECT_EQ(steps[i + 1].kind, Step::Kind::kReadBack);
        EXPECT_EQ(steps[i + 2].kind, Step::Kind::kCompare);
      } else {
        EXPECT_TRUE(words.find(" -v ") != words.npos || words.find(" verify ") != words.npos);
      }
    }
  });
}

TEST(Recipe, MemoryMapsLieInTheirChipsSectors) {
  for (const Recipe& recipe : recipes()) {
    if (recipe.chip == nullptr) continue;
    SCOPED_TRACE(recipe.board);
    const MemoryMap map = read_memory_map(recipe.board);
    EXPECT_EQ(map.code.begin, kFlashBegin);
    EXPECT_EQ(sectors_around(*recipe.chip, map.code).bytes, map.code.bytes)
        << "erasing the code would take something else along";
    EXPECT_GT(map.params.bytes, 0u);
    EXPECT_FALSE(map.params.overlaps(map.actions));
    EXPECT_EQ(sectors_around(*recipe.chip, map.params).begin, map.params.begin);
    EXPECT_LE(map.actions.end(), sectors_around(*recipe.chip, map.actions).end());
  }
}

TEST(Recipe, SectorsAreThoseOfTheManual) {
  const Chip& chip = *find_recipe("olimex_h405").chip;
  EXPECT_EQ(dfu_layout(chip), "04*016Kg,01*064Kg,07*128Kg");
  EXPECT_EQ(sectors_around(chip, {0x08004000, 1}).begin, 0x08004000u);
  EXPECT_EQ(sectors_around(chip, {0x08003FFF, 2}).bytes, 32u << 10);
  EXPECT_EQ(sectors_around(chip, {0x080E0000, 1}).end(), 0x08100000u);
}

TEST(Recipe, ToolFollowsFromThePortUnlessItIsNamed) {
  const Recipe& olimex = find_recipe("olimex_h405");
  EXPECT_EQ(choose_tool(olimex, "", ""), Tool::kOpenocd);
  EXPECT_EQ(choose_tool(olimex, "", "066DFF48"), Tool::kOpenocd);
  EXPECT_EQ(choose_tool(olimex, "", "/dev/ttyUSB0"), Tool::kStm32flash);
  EXPECT_EQ(choose_tool(olimex, "dfu-util", ""), Tool::kDfuUtil);
  EXPECT_THROW(choose_tool(olimex, "stm32flash", ""), FlashError);
  EXPECT_THROW(choose_tool(olimex, "avrdude", ""), FlashError);
  EXPECT_THROW(choose_tool(find_recipe("nucleo_f446re"), "dfu-util", ""), FlashError);
  EXPECT_THROW(find_recipe("nope"), FlashError);
}

TEST(Recipe, EveryBoardReplaysOnAnEmulatedOne) {
  for (const Recipe& recipe : recipes()) {
    const Recipe& stand_in = find_recipe(recipe.replay_board);
    EXPECT_EQ(std::string(stand_in.replay_board), stand_in.board) << recipe.board;
  }
}

MemoryMap map_of(const std::string& script) {
  const files::TemporaryDirectory folder;
  std::ofstream(folder.path() / "memory.ld") << script;
  return parse_memory_map(folder.path() / "memory.ld");
}
constexpr const char* kMemory =
    "MEMORY\n{\n FLASH (rx) : ORIGIN = 0x08000000, LENGTH = n /* verp_params_begin = 1; */\n"
    " RAM (rwx) : ORIGIN = 0x20000000, LENGTH = 128K\n}\n";

TEST(MemoryMap, TakesNumbersNamesAndTheFlashedSideOfAChoice) {
  const MemoryMap map = map_of(std::string("n = DEFINED(test) ? 1M : 192K;\n") + kMemory +
                               "verp_params_begin = 0x08040000;\nverp_params_bytes = 65536;\n");
  EXPECT_EQ(map.code.bytes, 192u << 10);
  EXPECT_EQ(map.ram.end(), 0x20020000u);
  EXPECT_EQ(map.params.begin, 0x08040000u) << "comments do not count";
  EXPECT_EQ(map.params.bytes, 65536u);
  EXPECT_EQ(map.actions.bytes, 0u);
}

TEST(MemoryMap, RefusesWhatItDoesNotUnderstand) {
  EXPECT_THROW(map_of(""), FlashError);
  EXPECT_THROW(map_of(kMemory), FlashError) << "n is not defined";
  EXPECT_THROW(map_of(std::string("n = 1K + 1K;\n") + kMemory), FlashError);
  EXPECT_THROW(map_of(std::string("n = 99999999999;\n") + kMemory), FlashError);
  EXPECT_THROW(parse_memory_map("/nowhere/memory.ld"), FlashError);
}

TEST(ShellLine, ShellTakesItApartIntoTheSameWords) {
  const files::TemporaryDirectory folder;
  const std::vector<std::string> words = {"a b", "it's", "", "$HOME", "x;y", "{z}", "-q", "ü\n"};
  const std::string line =
      "printf '%s\\0' " + files::shell_line(words) + " > " + (folder.path() / "out").string();
  ASSERT_EQ(std::system(line.c_str()), 0);
  std::ifstream in(folder.path() / "out");
  const std::string out{std::istreambuf_iterator<char>(in), {}};
  std::string expected;
  for (const std::string& word : words) expected += word + '\0';
  EXPECT_EQ(out, expected);
}

// A port or path must stay one word of OpenOCD's language.
TEST_F(Plan, NoPortOrPathIsTakenForACommandOfOpenocd) {
  const Recipe& recipe = find_recipe("olimex_h405");
  const auto words_of = [](const Job& made) {
    std::string words;
    for (const Step& step : plan(made)) {
      for (const std::string& word : step.command) words += word + "\n";
    }
    return words;
  };
  for (const char* odd : {"A; shutdown", "[exit]", "$env(HOME)", "two words", "\"", "#"}) {
    Job made = job(recipe, Tool::kOpenocd, 1);
    made.port = odd;
    EXPECT_NE(words_of(made).find("adapter serial {" + std::string(odd) + "}\n"),
              std::string::npos);
    made.pieces[0].file = folder_.path() / odd;
    std::ofstream(made.pieces[0].file) << "some bytes";
    EXPECT_NE(words_of(made).find("{" + made.pieces[0].file.string() + "}"), std::string::npos);
  }
  for (const char* odd : {"A}; shutdown; {", "A\\", "A\nshutdown", "{"}) {
    Job made = job(recipe, Tool::kOpenocd, 1);
    made.port = odd;
    EXPECT_THROW(plan(made), FlashError) << odd;
    made.port = "";
    made.pieces[0].file = folder_.path() / odd;
    EXPECT_THROW(plan(made), FlashError) << odd;
    Job elsewhere = job(recipe, Tool::kOpenocd, 1);
    elsewhere.folder = odd;
    EXPECT_THROW(plan(elsewhere), FlashError) << odd;
  }
}

}  // namespace
}  // namespace verp::flash::test
