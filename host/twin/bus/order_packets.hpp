#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/app/contracts.hpp"

/// An operator's orders as a controller gets them: writes to registers of device 200.
namespace verp::bus {

void append_write(std::vector<std::uint8_t>& bytes, std::uint16_t address,
                  const std::vector<std::uint8_t>& data);

/// The standing order, and the parameter write if there is one; returns how many packets.
std::size_t append_order(std::vector<std::uint8_t>& bytes, const app::OperatorOrder& order);

}  // namespace verp::bus
