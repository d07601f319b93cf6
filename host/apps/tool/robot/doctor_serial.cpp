#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "common/protocol/feetech_table.hpp"
#include "common/protocol/servo_models.hpp"
#include "firmware/app/feetech_servos.hpp"
#include "host/apps/cli/console.hpp"
#include "host/apps/tool/robot/doctor_bus.hpp"
#include "host/apps/tool/robot/doctor_checks.hpp"
#include "host/apps/tool/robot/doctor_line.hpp"
#include "host/twin/bus/link_fit.hpp"
#include "host/twin/bus/register_names.hpp"
#include "host/twin/bus/servo_setup.hpp"

namespace verp::tool {
namespace {

namespace at = dxl::address;

constexpr std::uint32_t kQuiet_us = 60'000;     // three periods of the slowest master
constexpr std::uint32_t kAppears_us = 500'000;  // until the other end of a link appears
constexpr int kPositionReads = 10;
constexpr std::uint32_t kOldRates[] = {1'000'000, 57'600, 115'200};

/// Ids by their trouble, and the lowest supply.
struct Troubles {
  std::set<int> present, damaged, slow, quiet;
  int lowest_id = 0;
  double lowest_v = 0, wanted_v = 0;
};

/// The registers that the doctor reads, in one protocol.
struct DoctorWords {
  std::span<const std::uint32_t> rates;
  std::uint16_t delay, level, error, voltage, position;
  std::uint8_t all_answers;  ///< of `level`
  std::uint16_t voltage_bytes, position_bytes;
  const char *delay_name, *level_name, *servos;
};
namespace ft = feetech::address;
constexpr DoctorWords kDynamixelWords = {dxl::kBaudRates,
                                         at::kReturnDelay,
                                         at::kStatusReturnLevel,
                                         at::kHardwareError,
                                         at::kPresentVoltage,
                                         at::kPresentPosition,
                                         2,
                                         2,
                                         4,
                                         "return_delay_time",
                                         "status_return_level",
                                         "Dynamixel"};
constexpr DoctorWords kFeetechWords = {feetech::kBaudRates,
                                       ft::kReturnDelay,
                                       ft::kStatusLevel,
                                       ft::kStatus,
                                       ft::kPresentVoltage,
                                       ft::kPresentPosition,
                                       1,
                                       1,
                                       2,
                                       "return_delay",
                                       "status_level",
                                       "Feetech"};

class SerialDoctor {
 public:
  SerialDoctor(const BusCase& bus, Findings& found) : bus_(bus), found_(found) {}

  void examine();

 private:
  /// False: another master talks there.
  bool may_ask(const LineAnswer& before);
  bool feetech() const { return bus_.protocol == BusProtocol::kFeetech; }
  /// Feetech servos collide in a Ping to all, and their requests look like answers: each of the
  /// robot's is asked, without a robot each id.
  std::set<int> ask_each(bus::Client& client) const;
  /// Bytes come when it is asked, sound or not.
  bool speaks(link::Link& link, int id) const;
  /// Without a robot: ids that a Ping to all misses, because two servos share one.
  std::set<int> speaking(link::Link& link) const;
  void examine_servos(link::Link& link, std::set<int> ids);
  /// False: answers come damaged.
  bool examine_servo(link::Link& link, bus::Client& client, const bus::Identity& servo);
  void read_registers(bus::Client& client, const bus::Identity& servo, double low_v);
  void judge_model(const bus::Identity& servo);
  void judge_troubles();
  void judge_damaged();
  void judge_link(bus::Client& client);
  void judge_other_rates(std::set<int>& present);
  void judge_silence();
  bool answers_old() const;
  std::string list(const std::set<int>& ids) const {
    return fmt::format("{}", fmt::join(ids, " "));
  }
  /// Sets one register of all `ids` right.
  std::string mend(const std::set<int>& ids, const char* name, int value) const;

  const BusCase& bus_;
  const DoctorWords& words_ = feetech() ? kFeetechWords : kDynamixelWords;
  Findings& found_;
  LineAnswer heard_;
  Troubles troubles_;
};

bool SerialDoctor::may_ask(const LineAnswer& before) {
  if (feetech() && before.bytes > 0) {
    found_.bad(
        "bus", "another master talks on this bus, or it is noise; nothing was sent",
        "end `verp run`, or the robot's controller; if there is none, check plugs and ground");
    return false;
  }
  if (before.master || !before.ids.empty()) {
    found_.bad("bus", "another master talks on this bus; nothing was sent",
               "end it: `verp run`, a controller on the robot, or Dynamixel Wizard");
    return false;
  }
  if (before.bytes > 0) {
    found_.bad("noise", fmt::format("{} bytes came before anything was asked", before.bytes),
               "swap A and B (D+ and D-), and join the grounds of adapter and servos");
  }
  return true;
}

void SerialDoctor::examine() {
  bool silent = false;
  {
    link::Link link(bus_.endpoint);
    if (!link.wait_connected(kAppears_us)) {
      return found_.bad("link", fmt::format("no program is at the other end of {}", bus_.link),
                        "start it (verp hil --link LINK), or correct the path");
    }
    if (!may_ask(listen(link, kQuiet_us))) return;
    if (!feetech()) heard_ = ping_all(link);
    if (heard_.echo) {
      found_.bad("echo", "the adapter returns the bytes that it sends",
                 "switch its receiver off while it sends (its jumper or switch), or use a U2D2");
    }
    const bool nothing = bus_.robot ? heard_.damaged == 0 : heard_.bytes == 0;
    silent = !feetech() && heard_.ids.empty() && nothing;
    if (!silent) examine_servos(link, heard_.ids);
  }
  std::set<int> present = troubles_.present;
  if (present.empty()) return judge_silence();
  if (!bus_.robot) return;
  const std::set<int> wanted = devices_of(bus_);
  if (!std::includes(present.begin(), present.end(), wanted.begin(), wanted.end())) {
    judge_other_rates(present);
    judge_missing(bus_, present, found_);
  }
  judge_strangers(bus_, present, found_);
}

std::set<int> SerialDoctor::ask_each(bus::Client& client) const {
  std::set<int> found;
  if (feetech() && bus_.robot) {
    for (const int id : devices_of(bus_)) {
      if (client.ping(static_cast<std::uint8_t>(id), 1)) found.insert(id);
    }
    return found;
  }
  for (const bus::Identity& each : client.scan()) found.insert(each.id);
  return found;
}

bool SerialDoctor::speaks(link::Link& link, int id) const {
  const auto ask = feetech() ? read_one_feetech : ping_one;
  return ask(link, id, bus_.timeout_us).bytes > 0;
}

std::set<int> SerialDoctor::speaking(link::Link& link) const {
  std::set<int> ids;
  if (!feetech() && heard_.garbage == 0) return ids;
  cli::complain("verp bus doctor: asking each id; MODEL makes it short");
  const int last = feetech() ? feetech::kMaxId : dxl::kMaxId;
  for (int id = 0; id <= last; ++id) {
    if (speaks(link, id)) ids.insert(id);
  }
  return ids;
}

void SerialDoctor::examine_servos(link::Link& link, std::set<int> ids) {
  bus::Client client(link, bus_.endpoint, bus_.timeout_us, bus_.protocol);
  ids.merge(bus_.robot ? devices_of(bus_) : speaking(link));
  for (const int id : ids) {
    const auto servo = client.ping(static_cast<std::uint8_t>(id), 2);
    const bool clear = servo ? examine_servo(link, client, *servo) : !speaks(link, id);
    if (servo || !clear) troubles_.present.insert(id);
    if (!clear) troubles_.damaged.insert(id);
  }
  if (troubles_.present.empty()) return;
  judge_troubles();
  if (!found_.any_bad()) judge_link(client);
}

bool SerialDoctor::examine_servo(link::Link& link, bus::Client& client,
                                 const bus::Identity& servo) {
  judge_model(servo);
  const dxl::ServoModel* model = dxl::find_servo_model(servo.model);
  const bool sensor = servo.model == dxl::kModelImu || servo.model == dxl::kModelFoot;
  if (feetech() ? sensor : model == nullptr) return true;  // or the controller
  const std::uint32_t before = client.crc_errors();
  int good = 0, asked = 0;
  while (asked < kPositionReads && (asked < 2 || good > 0)) {
    ++asked;
    if (client.read_once(servo.id, words_.position, words_.position_bytes)) ++good;
  }
  if (client.crc_errors() != before) return false;
  const auto read = feetech() ? read_one_feetech : read_one;
  if (good == 0 && read(link, servo.id, bus_.timeout_us).bytes > 0) return false;
  if (good == 0) troubles_.quiet.insert(servo.id);  // it answers pings only
  try {
    if (good > 0) read_registers(client, servo, feetech() ? 0 : 0.1 * model->low_dv);
  } catch (const bus::DeviceError& error) {
    found_.bad(fmt::format("id {}", servo.id), error.what(), "check its cable and its plug");
  }
  return true;
}

void SerialDoctor::read_registers(bus::Client& client, const bus::Identity& servo, double low_v) {
  const auto byte = [&](std::uint16_t address) { return client.read(servo.id, address, 1)[0]; };
  if (byte(words_.delay) != 0) troubles_.slow.insert(servo.id);
  if (byte(words_.level) != words_.all_answers) troubles_.quiet.insert(servo.id);
  const std::uint8_t status = byte(words_.error);
  if (const unsigned errors = feetech() ? app::hardware_error_of(status) : status; errors != 0) {
    found_.bad(fmt::format("id {}", servo.id),
               fmt::format("{} has a hardware error: {}", bus_.name_of(servo.id),
                           bus::hardware_errors(errors)),
               "cure it, then switch the servo off and on, which clears it");
  }
  std::vector<std::uint8_t> voltage = client.read(servo.id, words_.voltage, words_.voltage_bytes);
  voltage.resize(2);
  const double supply_v = 0.1 * dxl::get_u16(voltage.data());
  const double wanted_v =
      bus_.params ? static_cast<double>(bus_.params->tuning.safety.voltage_low_v) : low_v;
  if (supply_v >= wanted_v || (troubles_.lowest_id != 0 && supply_v >= troubles_.lowest_v)) return;
  troubles_.lowest_id = servo.id;
  troubles_.lowest_v = supply_v;
  troubles_.wanted_v = wanted_v;
}

void SerialDoctor::judge_model(const bus::Identity& servo) {
  if (!bus_.params) return;
  for (int j = 0; j < bus_.params->servo_count(); ++j) {
    const JointParams& joint = bus_.params->joint[j];
    const std::uint16_t wanted = bus_.params->servo[joint.servo_profile].model_number;
    if (joint.servo_id != servo.id || wanted == servo.model) continue;
    found_.bad(fmt::format("id {}", servo.id),
               fmt::format("{} is a {}, the robot's file says {}", bus_.name_of(servo.id),
                           bus::model_name(servo.model, bus_.protocol),
                           bus::model_name(wanted, bus_.protocol)),
               "take the right servo, or correct type=\"...\" of its <verp:servo>: verp check " +
                   bus_.model);
  }
}

std::string SerialDoctor::mend(const std::set<int>& ids, const char* name, int value) const {
  if (bus_.robot && ids.size() > 1) return bus_.set_up(-1, true);
  if (bus_.robot) return bus_.set_up(*ids.begin(), true);
  return fmt::format("for each: verp bus write{} --link {} --id {} --register {} {}",
                     feetech() ? " --protocol feetech" : "", bus_.link, *ids.begin(), name, value);
}

void SerialDoctor::judge_troubles() {
  judge_damaged();
  if (!troubles_.quiet.empty()) {
    found_.bad("status level", "not all requests are answered by ids " + list(troubles_.quiet),
               mend(troubles_.quiet, words_.level_name, words_.all_answers));
  }
  if (!troubles_.slow.empty()) {
    found_.advise("return delay",
                  "not 0, which wastes time of each tick: " + list(troubles_.slow) +
                      "; `verp run` sets it to 0",
                  mend(troubles_.slow, words_.delay_name, 0));
  }
  if (troubles_.lowest_id != 0) {
    found_.bad(
        "voltage",
        fmt::format("{} measures {:.1f} V; {:.1f} V or more are needed",
                    bus_.name_of(troubles_.lowest_id), troubles_.lowest_v, troubles_.wanted_v),
        "charge the battery, or raise the supply; then check plugs and cable cross-sections");
  }
}

void SerialDoctor::judge_damaged() {
  if (2 * troubles_.damaged.size() > troubles_.present.size() && troubles_.damaged.size() > 1) {
    return found_.bad("garbage",
                      fmt::format("{} of {} devices answer damaged packets",
                                  troubles_.damaged.size(), troubles_.present.size()),
                      "check ground, shield and the longest cable; try a lower baud rate");
  }
  for (const int id : troubles_.damaged) {
    found_.bad(
        fmt::format("id {}", id),
        "two servos have id " + std::to_string(id) + ", or its cable is bad: answers come damaged",
        "unplug one of them; connect each alone and give it its id: " + bus_.set_up(id, false));
  }
}

void SerialDoctor::judge_link(bus::Client& client) {
  found_.good("devices", fmt::format("{} answer", troubles_.present.size()));
  if (!bus_.params) return;
  try {
    const bus::LinkDelay delay = bus::measure_delay(client, *bus_.params, [] { return false; });
    const bus::LinkFit fit = bus::fit(*bus_.params, delay);
    const std::string text = fmt::format("an answer takes {:.2f} ms", 1e-3 * delay.median_us);
    if (fit.fits()) return found_.good("latency", text);
    found_.bad("latency",
               fmt::format("{}; a tick of {:g} ms has no room for it", text, 1e-3 * fit.period_us),
               bus::remedy(fit, *bus_.params, bus_.endpoint));
  } catch (const bus::DeviceError& error) {
    found_.bad("latency", error.what());
  }
}

void SerialDoctor::judge_other_rates(std::set<int>& present) {
  if (bus_.endpoint.kind != link::Endpoint::Kind::kSerial) return;
  cli::complain(fmt::format("verp bus doctor: trying the other baud rates, {} s",
                            feetech() && !bus_.robot ? 60 : 6));
  std::map<std::uint32_t, std::set<int>> elsewhere;
  bus::SetupLine line(bus_.endpoint, bus_.endpoint.baud, bus_.protocol);
  for (const std::uint32_t rate : words_.rates) {
    if (rate == bus_.endpoint.baud) continue;
    try {
      if (const std::set<int> ids = ask_each(line.at(rate)); !ids.empty()) elsewhere[rate] = ids;
    } catch (const link::LinkError&) {  // not a rate of the adapter
    }
  }
  for (const auto& [rate, ids] : elsewhere) {
    const bool link_is_wrong = !bus_.params || rate == bus_.params->baud;
    found_.bad("baud rate",
               fmt::format("at {} baud and not at {} these answer: ids {}", rate,
                           bus_.endpoint.baud, list(ids)),
               link_is_wrong ? fmt::format("give --link serial:{}@{}", bus_.endpoint.place, rate)
                             : "connect each alone: " + bus_.set_up(*ids.begin(), false));
    present.insert(ids.begin(), ids.end());
  }
}

bool SerialDoctor::answers_old() const {
  link::Endpoint endpoint = bus_.endpoint;
  std::vector<std::uint32_t> rates = {endpoint.baud};
  if (endpoint.kind == link::Endpoint::Kind::kSerial) {
    rates.insert(rates.end(), std::begin(kOldRates), std::end(kOldRates));
  }
  for (const std::uint32_t rate : rates) {
    endpoint.baud = rate;
    try {
      link::Link link(endpoint);
      if (link.wait_connected(kAppears_us) && !ping_all_old(link).old_ids.empty()) return true;
    } catch (const link::LinkError&) {  // not a rate of the adapter
    }
  }
  return false;
}

void SerialDoctor::judge_silence() {
  std::set<int> elsewhere;
  judge_other_rates(elsewhere);
  if (!elsewhere.empty()) return;
  if (!feetech() && answers_old()) {
    return found_.bad(
        "protocol", "servos answer in Protocol 1, and not in Protocol 2",
        "set Protocol Type (13) to 2 with Dynamixel Wizard; AX servos have Protocol 1 "
        "only; Feetech servos answer likewise: give --protocol feetech, or MODEL and --bus");
  }
  if (heard_.bytes > 0) {
    return found_.bad("garbage",
                      fmt::format("{} bytes came, and no packet at any baud rate", heard_.bytes),
                      fmt::format("see that these are {} servos, and that the grounds are joined",
                                  words_.servos));
  }
  const char* what = heard_.echo ? "only our own bytes come back" : "nothing answers";
  found_.bad("silence", fmt::format("{}, at any baud rate", what),
             "switch the servos' power on (each blinks once), swap A and B (D+ and D-), and check "
             "the plug at the adapter");
}

}  // namespace

void examine_serial_bus(const Machine& machine, const BusCase& bus, Findings& found) {
  const bool serial = bus.endpoint.kind == link::Endpoint::Kind::kSerial;
  if (serial && machine.exists(bus.endpoint.place) &&
      !check_device(machine, bus.endpoint.place, found)) {
    return;
  }
  try {
    SerialDoctor(bus, found).examine();
  } catch (const link::LinkError& error) {
    const std::string line = error.what(), missing = "no such device; ";
    const std::size_t at = line.find(missing);
    found.bad("link", at == line.npos
                          ? line
                          : line.substr(0, at) + missing +
                                "plug it in, or name another: " + line.substr(at + missing.size()));
  } catch (const bus::DeviceError& error) {
    found.bad("link", error.what());
  }
}

}  // namespace verp::tool
