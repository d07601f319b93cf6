#pragma once
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "host/apps/view/run/signals.hpp"
#include "host/robot/model/world.hpp"
#include "host/show/scene/snapshot.hpp"

namespace verp::view {

using Picture = std::shared_ptr<const scene::Snapshot>;

struct Point {
  double t_s = 0, value = 0;
};

/// A live run or a trace.
class Film {
 public:
  virtual ~Film() = default;
  virtual const scene::Entity& entity() const = 0;
  virtual std::vector<Signal> all_signals() const { return signals_of(entity()); }
  /// Null: level floor, or live run.
  virtual const model::World* world() const { return nullptr; }
  virtual double period_s() const = 0;
  virtual bool empty() const = 0;
  virtual double begin_s() const = 0;
  virtual double end_s() const = 0;
  /// The picture at or just before t_s; null: empty film.
  virtual Picture at(double t_s) const = 0;
  virtual void points(int signal, double after_s, std::vector<Point>& out) const = 0;
};

/// A run's last minutes. One thread adds, any thread reads.
class LiveFilm final : public Film {
 public:
  /// `beside`: each snapshot has a second robot for comparison.
  LiveFilm(std::shared_ptr<const scene::Entity> entity, double period_s, bool beside = false);

  void add(scene::Snapshot now);

  const scene::Entity& entity() const override { return *entity_; }
  std::vector<Signal> all_signals() const override { return signals_of(*entity_, beside_); }
  double period_s() const override { return period_s_; }
  bool empty() const override;
  double begin_s() const override;
  double end_s() const override;
  Picture at(double t_s) const override;
  Picture last() const;
  void points(int signal, double after_s, std::vector<Point>& out) const override;

 private:
  struct Instant {
    Picture picture;  ///< null: too old
    double t_s;
    std::vector<float> values;
  };
  std::size_t index_at(double t_s) const;

  const std::shared_ptr<const scene::Entity> entity_;
  const double period_s_;
  const bool beside_;
  mutable std::mutex mutex_;
  std::deque<Instant> instants_;
  std::size_t pictures_ = 0;  ///< newest instants with a picture
};

}  // namespace verp::view
