#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/app/contracts.hpp"

namespace verp::bus {

void append_write(std::vector<std::uint8_t>& bytes, std::uint16_t address,
                  const std::vector<std::uint8_t>& data);

/// Appends writes to device 200: the standing order and any parameter write; returns the number of
/// packets.
std::size_t append_order(std::vector<std::uint8_t>& bytes, const app::OperatorOrder& order);

}  // namespace verp::bus
