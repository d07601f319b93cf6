#pragma once
#include <cstdint>

#include "host/author/action/document.hpp"
#include "host/author/action/let_go.hpp"
#include "host/robot/model/entity.hpp"
#include "host/study/survey/workers.hpp"

namespace verp::tune {

struct LieDownOptions {
  int generations = 10, children = 12;  ///< of the search, near the shipped robots' ways
  std::uint64_t judges = 10;            ///< robots: the file's, and random ones new to the search
};

struct LieDown {
  action::Document document;  ///< last judged
  bool found = false;         ///< all judges came down and lay without a fall
  action::LetGo worst;        ///< of the judges; without any, of the best way's robots
  int tries = 0;              ///< robots let go in the twin
  bool interrupted = false;
};

/// An action lie_down for a robot with legs. Robots are let go in the twin: the first judge is as
/// in `verp check`, the others are drawn at random. Any number of threads gives the same result.
LieDown make_lie_down(const model::Entity& entity, const LieDownOptions& options,
                      const survey::Watch& watch);

}  // namespace verp::tune
