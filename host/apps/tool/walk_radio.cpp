#include "host/apps/tool/walk_radio.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <utility>

#include "host/apps/cli/exit_status.hpp"
#include "host/trace/record/ros_radio.hpp"
#include "host/trace/record/trace_error.hpp"
#include "host/twin/bus/modem_device.hpp"

namespace verp::tool {
namespace {

/// A device on the robot's bus has the modem's id.
bool has_its_id(const Params& params) {
  for (int j = 0; j < params.servo_count(); ++j) {
    if (params.joint[j].servo_id == bus::modem::kId) return true;
  }
  const auto& feet = params.feet.device_id;
  return params.imu.device_id == bus::modem::kId ||
         std::find(std::begin(feet), std::end(feet), bus::modem::kId) != std::end(feet);
}

void check_modem(const session::WalkPlan& plan) {
  if (plan.link.empty()) return;
  if (plan.params.bus_protocol != BusProtocol::kDynamixel2) {
    const bool can = plan.params.bus_protocol == BusProtocol::kCia402;
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp walk --radio: {} speaks {}, and the modem is a "
                                     "device on a Dynamixel bus; choose one with --bus",
                                     plan.name, can ? "CAN" : "to Feetech servos"));
  }
  if (has_its_id(plan.params)) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp walk --radio: a device of {} has id {}, which is "
                                     "the modem's; give it another in {}",
                                     plan.name, bus::modem::kId, plan.entity.file));
  }
}

}  // namespace

void check_radio(const Walk& walk) {
  if (!walk.scenario.radio) return;
  const std::vector<session::WalkPlan>& plans = walk.run.plans;
  if (plans.size() == 1) {
    throw cli::ToolError(
        cli::kBadInput,
        "verp walk --radio: one robot has nobody to talk to; add another one: --robot "
        "NAME=MODEL for each");
  }
  for (const session::WalkPlan& each : plans) check_modem(each);
  // Robots with controllers elsewhere come last.
  if (!plans.back().link.empty()) return;
  throw cli::ToolError(
      cli::kBadInput,
      "verp walk --radio: no robot here has a program that could talk; drive one from "
      "outside (--robot NAME=ext:LINK), or see verp demo and host/apps/libverp");
}

struct WalkRadio::Air {
  /// A robot's antenna and trace.
  struct Station final : bus::Aerial {
    Station(Air& all, int number) : air(all), index(number) {}
    std::uint8_t number() const override { return static_cast<std::uint8_t>(index); }
    std::uint8_t most_bytes() const override {
      return static_cast<std::uint8_t>(
          std::min<std::size_t>(air.radio.conditions().most_bytes, bus::modem::kMostData));
    }
    dxl::Error say(std::uint8_t to, const std::string& data) override {
      return air.say(*this, to == bus::modem::kEverybody ? radio::kEverybody : to, data);
    }
    void listen() override { air.listen(*this); }

    Air& air;
    const int index;
    std::string name;
    session::Robot* robot = nullptr;
    bus::ModemDevice* modem = nullptr;  ///< null: local controller
    record::TraceWriter* trace = nullptr;
    std::uint64_t period_us = 0;
    std::uint32_t tick = 0;
  };

  explicit Air(const scenario::Scenario& scenario)
      : radio(scenario.radio->conditions, scenario.radio->seed) {
    for (const scenario::Robot& robot : scenario.robots)
      stations.emplace_back(*this, radio.add()).name = robot.name;
  }

  Station& station(const session::WalkPlan& plan) {
    return stations.at(static_cast<std::size_t>(plan.number));
  }

  dxl::Error say(Station& from, int to, const std::string& data) {
    advance();
    const auto number = static_cast<std::int32_t>(radio.sent());
    const radio::Sent sent = radio.send(from.index, to, data, session->now_us());
    constexpr const char* kEvents[] = {"said", "too long", "too many", "nobody"};
    const bool went = sent == radio::Sent::kOnItsWay;
    note(from, {.event = kEvents[static_cast<int>(sent)],
                .number = went ? number : -1,
                .from = from.index,
                .to = to,
                .data = data});
    if (went) return dxl::Error::kNone;
    return sent == radio::Sent::kTooMany ? dxl::Error::kResultFail : dxl::Error::kDataRange;
  }

  void listen(Station& at) {
    advance();
    for (radio::ReceivedMessage& each : radio.take(at.index)) {
      note(at, {.event = "heard",
                .number = static_cast<std::int32_t>(each.number),
                .from = each.from,
                .to = at.index,
                .data = each.data});
      if (at.modem != nullptr)
        at.modem->hear(static_cast<std::uint8_t>(each.from), std::move(each.data));
    }
  }

  void advance() {
    places.clear();
    for (const Station& each : stations) {
      const sim::Vec3 at = each.robot->twin().body().link_pose(0).translation();
      places.push_back({at.x(), at.y(), at.z()});
    }
    radio.advance(session->now_us(), places);
    for (const radio::Outcome& each : radio.take_outcomes())
      ++fates[static_cast<std::size_t>(each.fate)];
  }

  /// A full disk ends the trace, not the walk; the robot's next tick reports it.
  void note(const Station& of, record::ros::Radio what) {
    const Station& keeper = of.trace == nullptr && first != nullptr ? *first : of;
    if (keeper.trace == nullptr || broken) return;
    what.tick = keeper.tick;
    try {
      keeper.trace->append("/radio", record::ros::kRadio,
                           std::uint64_t{1000} * keeper.tick * keeper.period_us,
                           record::ros::radio(what));
    } catch (const record::TraceError&) {
      broken = true;
    }
  }

  session::Session* session = nullptr;
  radio::Radio radio;
  std::deque<Station> stations;
  std::vector<radio::Place> places;
  std::array<std::uint64_t, radio::kFates> fates{};
  const Station* first = nullptr;
  bool broken = false;
};

WalkRadio::WalkRadio(const scenario::Scenario& scenario) : air_(std::make_unique<Air>(scenario)) {}

WalkRadio::~WalkRadio() = default;

void WalkRadio::join(std::size_t, const session::WalkPlan& plan, session::Hooks& hooks) {
  Air::Station& station = air_->station(plan);
  if (air_->first == nullptr) air_->first = &station;
  station.period_us = plan.params.period_us;
  if (plan.link.empty()) station.trace = hooks.trace;
}

void WalkRadio::begin(session::Session& session) {
  air_->session = &session;
  for (std::size_t i = 0; i < session.size(); ++i) {
    session::Robot& robot = session.robot(i);
    Air::Station& station = air_->station(robot.plan());
    station.robot = &robot;
    if (robot.plan().link.empty()) continue;
    auto modem = std::make_unique<bus::ModemDevice>(robot.plan().params.baud, station);
    station.modem = modem.get();
    robot.bus().add(std::move(modem));
  }
}

void WalkRadio::tick(std::size_t, session::Robot& robot) {
  Air::Station& station = air_->station(robot.plan());
  if (station.modem != nullptr) return;
  station.tick = robot.tick();
  station.listen();
}

std::string WalkRadio::text() const {
  std::string fates, names;
  for (std::size_t i = 0; i < air_->fates.size(); ++i)
    fates += fmt::format("{}{} {}", i == 0 ? "" : ", ", air_->fates[i], radio::kFateNames[i]);
  for (const Air::Station& each : air_->stations)
    names += fmt::format("{}{} is {}", each.index == 0 ? "" : ", ", each.index, each.name);
  return fmt::format("  {:<18}{} messages, {} refused; {} ({})\n", "radio", air_->radio.sent(),
                     air_->radio.refused(), fates, names);
}

cli::Json WalkRadio::json() const {
  cli::Json out = {{"sent", air_->radio.sent()}, {"refused", air_->radio.refused()}};
  for (std::size_t i = 0; i < air_->fates.size(); ++i) out[radio::kFateNames[i]] = air_->fates[i];
  for (const Air::Station& each : air_->stations) out["robots"].push_back(each.name);
  return out;
}

}  // namespace verp::tool
