#include "host/apps/view/run/film.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace verp::view {
namespace {

constexpr double kPictures_s = 120;  // the user can rewind this far; about 5 kB a tick
constexpr double kValues_s = 1800;   // for plots; about 0.5 kB a tick

}  // namespace

LiveFilm::LiveFilm(std::shared_ptr<const scene::Entity> entity, double period_s, bool beside)
    : entity_(std::move(entity)), period_s_(period_s), beside_(beside) {}

void LiveFilm::add(scene::Snapshot now) {
  std::vector<float> values =
      values_of(now.robots.front(), *entity_, beside_ ? &now.robots.at(1) : nullptr);
  const double t_s = now.t_s;
  auto picture = std::make_shared<const scene::Snapshot>(std::move(now));
  const std::lock_guard lock(mutex_);
  instants_.push_back({std::move(picture), t_s, std::move(values)});
  ++pictures_;
  if (static_cast<double>(pictures_) * period_s_ > kPictures_s) {
    instants_[instants_.size() - pictures_].picture.reset();
    --pictures_;
  }
  if (static_cast<double>(instants_.size()) * period_s_ > kValues_s) instants_.pop_front();
}

bool LiveFilm::empty() const {
  const std::lock_guard lock(mutex_);
  return instants_.empty();
}

double LiveFilm::begin_s() const {
  const std::lock_guard lock(mutex_);
  return instants_.empty() ? 0 : instants_[instants_.size() - pictures_].t_s;
}

double LiveFilm::end_s() const {
  const std::lock_guard lock(mutex_);
  return instants_.empty() ? 0 : instants_.back().t_s;
}

/// The last instant with a picture at or before t_s.
std::size_t LiveFilm::index_at(double t_s) const {
  const auto first = instants_.end() - static_cast<std::ptrdiff_t>(pictures_);
  const auto later = std::upper_bound(
      first, instants_.end(), t_s + 1e-9,
      [](double limit_s, const Instant& instant) { return limit_s < instant.t_s; });
  return static_cast<std::size_t>(std::max(later - 1, first) - instants_.begin());
}

Picture LiveFilm::at(double t_s) const {
  const std::lock_guard lock(mutex_);
  return instants_.empty() ? nullptr : instants_[index_at(t_s)].picture;
}

Picture LiveFilm::last() const {
  const std::lock_guard lock(mutex_);
  return instants_.empty() ? nullptr : instants_.back().picture;
}

void LiveFilm::points(int signal, double after_s, std::vector<Point>& out) const {
  const std::lock_guard lock(mutex_);
  const auto first = std::upper_bound(
      instants_.begin(), instants_.end(), after_s,
      [](double limit_s, const Instant& instant) { return limit_s < instant.t_s; });
  for (auto i = first; i != instants_.end(); ++i) {
    out.push_back({i->t_s, i->values[static_cast<std::size_t>(signal)]});
  }
}

}  // namespace verp::view
