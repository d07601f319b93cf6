#include "tests/host/flash/flash_fixture.hpp"

namespace verp::flash::test {
namespace {

class Killed : public Flash {
 protected:
  /// Kills `verp flash` while `program` runs (process id in the file `id`). Reports whether that
  /// ends within 20 s; a zombie counts as ended.
  Outcome killed(const std::string& environment, const std::string& program,
                 const std::string& arguments) const {
    const std::string script = "#!/bin/sh\necho $$ >id.part && mv id.part id\nexec sleep 600\n";
    put(folder_ / program, {script.begin(), script.end()});
    fs::permissions(folder_ / program, fs::perms::owner_all);
    return shell(environment + " " VERP_PROGRAM " flash " + arguments + R"sh( & verp=$!
      while [ ! -e id ] && kill -0 $verp; do sleep 0.02; done
      kill -KILL $verp; wait $verp
      for _ in $(seq 1000); do
        case $(sed -n 's/^State:[[:space:]]*//p' /proc/$(cat id)/status 2>/dev/null) in
        '' | Z*) echo ended; exit ;;
        esac
        sleep 0.02
      done
      kill $(cat id); echo outlived)sh");
  }
};

TEST_F(Killed, NoEmulatorOutlivesIt) {
  put(folder_ / "loop_mps2_an386.elf", {1});
  const Outcome outcome = killed("VERP_FIRMWARE_DIR=. VERP_QEMU=./emulator", "emulator",
                                 "--board mps2_an386 --emulate");
  EXPECT_TRUE(outcome.out.ends_with("\nended\n")) << outcome.out << outcome.err;
}

TEST_F(Killed, NoFlashToolOutlivesIt) {
  const Outcome outcome = killed("PATH=.:$PATH", "dfu-util", "--tool dfu-util --board " + board_);
  EXPECT_EQ(outcome.out, "ended\n") << outcome.err;
}

}  // namespace
}  // namespace verp::flash::test
