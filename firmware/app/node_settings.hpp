#pragma once
#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/canopen/pdo_record.hpp"

/// A node's settings in the order of writing, before it is started. A power loss loses them.
namespace verp::app {

struct Setting {
  canopen::Address at;
  std::uint32_t value = 0;
  std::uint8_t bytes = 0;
  bool stays = true;      ///< persists, so it is read back
  bool optional = false;  ///< a node may lack the object
};

/// `number` from 0; false: the node has fewer.
bool node_setting(const Params& params, int slot, int number, Setting& setting);

}  // namespace verp::app
