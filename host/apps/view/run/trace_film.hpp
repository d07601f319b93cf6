#pragma once
#include <filesystem>
#include <vector>

#include "host/apps/view/run/film.hpp"
#include "host/show/scene/from_trace.hpp"

namespace verp::view {

class TraceFilm final : public Film {
 public:
  /// Throws record::TraceError.
  explicit TraceFilm(const std::filesystem::path& file);

  const scene::TracePlayer& player() const { return player_; }
  const scene::Entity& entity() const override { return player_.entity(); }
  const model::World* world() const override { return player_.world(); }
  double period_s() const override { return player_.trace().period_s(); }
  bool empty() const override { return player_.size() == 0; }
  double begin_s() const override { return player_.begin_s(); }
  double end_s() const override { return player_.end_s(); }
  Picture at(double t_s) const override;
  void points(int signal, double after_s, std::vector<Point>& out) const override;

 private:
  struct Row {
    double t_s;
    std::vector<float> values;
  };
  const std::vector<Row>& rows() const;

  scene::TracePlayer player_;
  mutable std::vector<Row> rows_;  ///< computed for the first curve
};

}  // namespace verp::view
