#pragma once
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/model/image.hpp"
#include "common/model/params.hpp"
#include "firmware/app/contracts.hpp"

namespace verp::app {

/// For an image without its own operator: this header, Params, the actions, and one OperatorOrder a
/// tick. Both ends must be of one build.
struct CanLoopJob {
  static constexpr std::uint32_t kMagic = 0x4A4E4143;  // "CANJ"

  std::uint32_t magic = kMagic;
  std::uint32_t core_version = kCoreVersion;
  std::uint32_t params_size = sizeof(Params);
  std::uint32_t ticks = 0;
  std::uint32_t actions_size = 0;
  VERP_FIELDS(magic, core_version, params_size, ticks, actions_size)

  bool fits() const {
    return magic == kMagic && core_version == kCoreVersion && params_size == sizeof(Params);
  }
};
VERP_PACKED(CanLoopJob);

}  // namespace verp::app
