#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "common/model/params.hpp"
#include "common/record/tick_record.hpp"
#include "firmware/app/contracts.hpp"
#include "host/model/entity.hpp"

/// A robot in the twin under an operator who goes by the tick alone: the same run, whoever is the
/// controller.
namespace verp::test {

struct TwinRun {
  std::vector<TickRecord> records;
  double distance_m = 0;  ///< from start to end, over ground
  bool fallen = false;
};

/// Stands up in six seconds, walks until three seconds before the end, stands still. Walks 4 cm
/// steps ahead, or, with `wandering`, another way every three seconds.
class ScriptedOperator {
 public:
  ScriptedOperator(const Params& params, std::uint32_t ticks, bool wandering)
      : period_us_(params.period_us), ticks_(ticks), wandering_(wandering) {}
  app::OperatorOrder order(std::uint32_t tick) const;

 private:
  std::uint32_t period_us_;
  std::uint32_t ticks_;
  bool wandering_;
};

struct Robot {
  model::Entity entity;
  Params params;
};
/// With its bus of that name; empty: its first.
Robot load_robot(const std::string& name, const std::string& bus = {});

/// Software in the loop: controller, bus and physics in this process.
TwinRun run_here(const Robot& robot, std::uint32_t ticks, bool wandering);
/// The controller in firmware on an emulated board.
TwinRun run_on_board(const std::string& board, const Robot& robot, std::uint32_t ticks,
                     bool wandering);

}  // namespace verp::test
