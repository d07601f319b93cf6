#pragma once
#include <gtest/gtest.h>

#include <string>

#include "host/apps/libverp/verp.h"

namespace verp::abi::test {

inline void expect_error(int got, int wanted, const std::string& call, const std::string& why) {
  EXPECT_EQ(got, wanted) << verp_last_error();
  const std::string text = verp_last_error();
  EXPECT_EQ(text.rfind(call + ": ", 0), 0U) << text;
  EXPECT_NE(text.find(why), std::string::npos) << text;
}

}  // namespace verp::abi::test
