#include "host/apps/tool/robot/bus_on_serial.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "common/protocol/device_end.hpp"
#include "common/protocol/feetech.hpp"
#include "common/protocol/feetech_table.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/suggest.hpp"
#include "host/apps/tool/robot/bus_bench.hpp"
#include "host/apps/tool/robot/register_value.hpp"
#include "host/apps/tool/robot/start_words.hpp"
#include "host/twin/bus/client.hpp"
#include "host/twin/bus/register_names.hpp"

namespace verp::tool {
namespace {

BusProtocol protocol_of(const BusOptions& options) {
  return options.protocol == "feetech" ? BusProtocol::kFeetech : BusProtocol::kDynamixel2;
}

bus::Client open(const BusOptions& options) {
  if (!options.object.empty()) {
    throw cli::ToolError(cli::kBadInput,
                         "--object is of CAN's nodes (--link can:...); devices on other links "
                         "have --register or --address");
  }
  return {link::parse_endpoint(options.link), static_cast<std::uint32_t>(options.timeout_ms * 1000),
          protocol_of(options)};
}

/// A Feetech register with a sign has a magnitude on the wire, two's complement here.
bool has_magnitude(const bus::Client& client, const bus::NamedRegister& reg) {
  return client.protocol() == BusProtocol::kFeetech && reg.count == 1 &&
         reg.type == dxl::controller::Type::kI16 && reg.address <= 0xFF;
}

std::vector<std::uint8_t> bytes_of(std::uint16_t value) {
  return {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8)};
}

std::vector<std::uint8_t> read_register(bus::Client& client, std::uint8_t id,
                                        const bus::NamedRegister& reg) {
  const auto bytes = client.read(id, reg.address, static_cast<std::uint16_t>(reg.bytes()));
  if (!has_magnitude(client, reg)) return bytes;
  const auto sign = feetech::sign_bit(static_cast<std::uint8_t>(reg.address));
  return bytes_of(
      static_cast<std::uint16_t>(feetech::from_magnitude(feetech::get_u16(bytes.data()), sign)));
}

/// A Feetech servo's answer does not say that it refused a value.
void require_range(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes) {
  const bool has_sign = dxl::controller::is_signed(reg.type);
  const auto size = static_cast<unsigned>(bytes.size());
  const std::int64_t value = dxl::register_value(bytes.data(), size, has_sign);
  const auto most =
      has_sign ? std::int64_t{static_cast<std::int32_t>(reg.maximum)} : std::int64_t{reg.maximum};
  if (value >= reg.minimum && value <= most) return;
  throw cli::ToolError(cli::kBadInput, fmt::format("{}: {} is out of range; give {} to {}",
                                                   reg.name, value, reg.minimum, most));
}

std::vector<std::uint8_t> on_wire(const bus::Client& client, const bus::NamedRegister& reg,
                                  const std::vector<std::uint8_t>& bytes) {
  const bool ranged = client.protocol() == BusProtocol::kFeetech && reg.maximum != 0;
  if (ranged) require_range(reg, bytes);
  if (!has_magnitude(client, reg)) return bytes;
  const auto sign = feetech::sign_bit(static_cast<std::uint8_t>(reg.address));
  const auto value = static_cast<std::int16_t>(feetech::get_u16(bytes.data()));
  return bytes_of(feetech::to_magnitude(value, sign));
}

void tell_tries(const bus::Client& client, const BusOptions& options, cli::Json* json) {
  if (client.tries() <= 1) return;
  if (json != nullptr) {
    (*json)["tries"] = client.tries();
  } else {
    cli::complain(
        fmt::format("{}: an answer took {} tries: the link is late or loses bytes; raise "
                    "--timeout, or see `verp bus bench`",
                    options.link, client.tries()));
  }
}

[[noreturn]] void nobody(const std::string& what) {
  throw cli::ToolError(cli::kNoDevice,
                       what + "; `verp bus doctor` finds out why, or raise --timeout");
}

bus::Identity identify(bus::Client& client, const BusOptions& options) {
  const auto identity = client.ping(static_cast<std::uint8_t>(options.id));
  if (!identity) {
    nobody(fmt::format("{}: device {} does not answer, asked {} times", options.link, options.id,
                       bus::Client::kAttempts));
  }
  return *identity;
}

cli::Json to_json(const bus::Identity& each, const BusOptions& options) {
  return {{"id", each.id},
          {"model", each.model},
          {"name", bus::model_name(each.model, protocol_of(options))},
          {"firmware", each.firmware}};
}

void print(const std::vector<bus::Identity>& found, const BusOptions& options) {
  if (options.json) {
    cli::Json devices = cli::Json::array();
    for (const bus::Identity& each : found) devices.push_back(to_json(each, options));
    return cli::print_json({{"link", options.link}, {"devices", devices}});
  }
  for (const bus::Identity& each : found) {
    cli::answer(fmt::format("{:3}  {:<12}  firmware {}\n", each.id,
                            bus::model_name(each.model, protocol_of(options)), each.firmware));
  }
}

bus::NamedRegister by_name(const bus::Identity& identity, BusProtocol protocol,
                           const std::string& name) {
  const bus::NamedRegister* found = bus::find_register(identity.model, name, protocol);
  if (found != nullptr) return *found;
  std::vector<std::string> names;
  for (const bus::NamedRegister& each : bus::registers_of(identity.model, protocol)) {
    names.emplace_back(each.name);
  }
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("{} has no register '{}'{}; give --address and --size",
                  bus::model_name(identity.model), name, cli::did_you_mean(name, names)));
}

bus::NamedRegister by_address(const BusOptions& options) {
  using dxl::controller::Type;
  const Type type = options.size == 1 ? Type::kU8 : options.size == 2 ? Type::kU16 : Type::kU32;
  return {.address = static_cast<std::uint16_t>(options.address),
          .name = "--address",
          .type = type,
          .access = dxl::controller::Access::kWrite};
}

std::vector<bus::NamedRegister> wanted(bus::Client& client, const BusOptions& options) {
  if (options.address >= 0) return {by_address(options)};
  const bus::Identity identity = identify(client, options);
  std::vector<bus::NamedRegister> all;
  for (const std::string& name : options.names)
    all.push_back(by_name(identity, client.protocol(), name));
  if (!all.empty()) return all;
  const auto known = bus::registers_of(identity.model, client.protocol());
  if (known.empty()) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: its registers have no names here; give --address "
                                     "and --size",
                                     bus::model_name(identity.model, client.protocol())));
  }
  return {known.begin(), known.end()};
}

void tell_start(bus::Client& client, const bus::Identity& identity) {
  if (identity.model != dxl::controller::kModel) return;
  const bus::NamedRegister* at = bus::find_register(identity.model, "brown_out");
  const std::string complaint =
      brown_out_complaint(read_register(client, identity.id, *at).front());
  if (!complaint.empty()) cli::complain(complaint);
}

}  // namespace

int scan_serial(const BusOptions& options) {
  bus::Client client = open(options);
  std::vector<bus::Identity> found;
  if (options.each) {
    for (int id = 0; id <= dxl::kMaxId; ++id) {
      const auto one = client.ping(static_cast<std::uint8_t>(id), 1);
      if (one) found.push_back(*one);
    }
  } else {
    found = client.scan();
    if (found.empty()) found = client.scan();  // a busy device misses it
  }
  if (client.crc_errors() > 0) {
    cli::complain(
        fmt::format("{}: {} damaged packets: devices may be missing or share an id; "
                    "`--each` asks one id at a time",
                    options.link, client.crc_errors()));
  }
  if (found.empty()) nobody(options.link + ": no device answers");
  print(found, options);
  return cli::kGood;
}

int ping_serial(const BusOptions& options) {
  bus::Client client = open(options);
  const bus::Identity identity = identify(client, options);
  if (options.json) {
    cli::Json json = to_json(identity, options);
    tell_tries(client, options, &json);
    cli::print_json(json);
  } else {
    print({identity}, options);
    tell_tries(client, options, nullptr);
  }
  tell_start(client, identity);
  return cli::kGood;
}

int read_serial(const BusOptions& options) {
  bus::Client client = open(options);
  const auto id = static_cast<std::uint8_t>(options.id);
  cli::Json values = cli::Json::object();
  for (const bus::NamedRegister& each : wanted(client, options)) {
    const auto bytes = read_register(client, id, each);
    if (options.json) {
      values[options.address >= 0 ? std::to_string(each.address) : each.name] =
          json_value(each, bytes);
    } else if (options.address >= 0) {
      cli::answer(show_value(each, bytes) + "\n");
    } else {
      cli::answer(fmt::format("{:4}  {:<24} {}\n", each.address, each.name,
                              with_unit(show_value(each, bytes), each.unit)));
    }
  }
  cli::Json json = {{"id", id}, {"registers", values}};
  tell_tries(client, options, options.json ? &json : nullptr);
  if (options.json) cli::print_json(json);
  return cli::kGood;
}

int write_serial(const BusOptions& options) {
  if (options.address < 0 && options.names.size() != 1) {
    throw cli::ToolError(cli::kBadInput,
                         "verp bus write: name one register, by --register or --address");
  }
  bus::Client client = open(options);
  const bus::NamedRegister reg = wanted(client, options).front();
  if (!reg.writable()) {
    throw cli::ToolError(cli::kBadInput, fmt::format("{} is read-only", reg.name));
  }
  const auto id = static_cast<std::uint8_t>(options.id);
  const std::vector<std::uint8_t> bytes = parse_values(reg, options.values);
  client.write(id, reg.address, on_wire(client, reg, bytes));
  cli::Json json = {{"id", id}, {"address", reg.address}, {"bytes", bytes.size()}};
  tell_tries(client, options, options.json ? &json : nullptr);
  if (options.json) cli::print_json(json);
  return cli::kGood;
}

int bench_serial(const BusOptions& options) {
  bus::Client client = open(options);
  identify(client, options);
  const auto id = static_cast<std::uint8_t>(options.id);
  const auto address = static_cast<std::uint16_t>(options.bench_address);
  const auto size = static_cast<std::uint16_t>(options.size);
  client.read(id, address, size);  // throws without an answer
  cli::catch_interrupts();
  const BusBench result = run_bus_bench(client, id, address, size, options.seconds);
  cli::print_answer(options.json, to_json(result), to_text(result));
  const link::Endpoint endpoint = link::parse_endpoint(options.link);
  if (endpoint.kind == link::Endpoint::Kind::kSerial) advise_latency(endpoint.place);
  if (cli::interrupted()) return cli::kRunFailed;
  if (result.good == 0) nobody(options.link + ": no read was answered");
  return cli::kGood;
}

}  // namespace verp::tool
