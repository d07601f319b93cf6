#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/protocol/controller_table.hpp"

/// Registers by name, for people: of the servos this project knows, of its own sensors and of the
/// controller.
namespace verp::bus {

using NamedRegister = dxl::controller::Register;

/// "XM430-W350", "controller", ...; "model N" if it is not known.
std::string model_name(std::uint16_t model);
/// Bits of Hardware Error Status, as words.
std::string hardware_errors(unsigned bits);

/// In the order of their addresses; empty if the model is not known.
std::span<const NamedRegister> registers_of(std::uint16_t model);

/// nullptr: that model has no such register.
const NamedRegister* find_register(std::uint16_t model, std::string_view name);

/// The controller's registers as a Markdown page: firmware/app/registers.md.
std::string controller_document();

}  // namespace verp::bus
