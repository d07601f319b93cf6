#pragma once
#include <gtest/gtest.h>

#include <string>

#include "tests/support/stm32/rig.hpp"

namespace verp::hal::stm32::test {

class EachFamily : public ::testing::TestWithParam<Family> {};
inline std::string name_of(const ::testing::TestParamInfo<Family>& info) {
  return info.param == Family::kF405 ? "F405" : info.param == Family::kF446 ? "F446" : "F746";
}
inline const auto kFamilies = ::testing::Values(Family::kF405, Family::kF446, Family::kF746);

}  // namespace verp::hal::stm32::test
