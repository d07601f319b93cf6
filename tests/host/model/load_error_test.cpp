#include "host/robot/model/load_error.hpp"

#include <gtest/gtest.h>

namespace verp::model {
namespace {

// A terminal obeys control bytes.
TEST(LoadError, IsOneLineOfPrintedBytes) {
  EXPECT_STREQ(LoadError("f.sdf", 3, "a\x1b[2Jb\x7F\nc", "mend\tit").what(),
               "f.sdf:3: a?[2Jb? c; mend it");
}

TEST(LoadError, CutsWhatIsEndlessAndKeepsThePlaceAndTheRemedy) {
  const std::string what = LoadError("f.sdf", 3, std::string(5000, 'x'), "mend it").what();
  EXPECT_EQ(what, "f.sdf:3: " + std::string(400, 'x') + "...; mend it");
}

}  // namespace
}  // namespace verp::model
