#include "host/apps/view/run/trace_film.hpp"

namespace verp::view {
namespace {

constexpr std::size_t kMostRows = 20000;  // no screen shows more

}  // namespace

TraceFilm::TraceFilm(const std::filesystem::path& file) : player_(file) {}

Picture TraceFilm::at(double t_s) const {
  if (empty()) return nullptr;
  return std::make_shared<const scene::Snapshot>(player_.at(player_.index_at(t_s)));
}

const std::vector<TraceFilm::Row>& TraceFilm::rows() const {
  if (!rows_.empty()) return rows_;
  const std::size_t stride = player_.size() / kMostRows + 1;
  rows_.reserve(player_.size() / stride + 1);
  for (std::size_t i = 0; i < player_.size(); i += stride) {
    const scene::Snapshot now = player_.at(i);
    rows_.push_back({now.t_s, values_of(now.robots.front(), entity())});
  }
  return rows_;
}

void TraceFilm::points(int signal, double after_s, std::vector<Point>& out) const {
  for (const Row& row : rows()) {
    if (row.t_s > after_s) out.push_back({row.t_s, row.values[static_cast<std::size_t>(signal)]});
  }
}

}  // namespace verp::view
