#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/protocol/controller_table.hpp"

namespace verp::bus {

using NamedRegister = dxl::controller::Register;

/// "XM430-W350", "controller" or "model N". Model numbers are a
/// protocol's own; one that Dynamixel lacks is looked for among Feetech's.
std::string model_name(std::uint16_t model, BusProtocol protocol = BusProtocol::kDynamixel2);
std::string hardware_errors(unsigned bits);

/// Sorted by address; empty: unknown model.
std::span<const NamedRegister> registers_of(std::uint16_t model,
                                            BusProtocol protocol = BusProtocol::kDynamixel2);

/// nullptr: the model has no such register.
const NamedRegister* find_register(std::uint16_t model, std::string_view name,
                                   BusProtocol protocol = BusProtocol::kDynamixel2);

/// The Markdown page firmware/app/registers.md.
std::string controller_document();

}  // namespace verp::bus
