#pragma once
#include <QWidget>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/apps/view/run/film.hpp"

class QCustomPlot;
class QCPGraph;
class QCPItemStraightLine;
class QLabel;

namespace verp::view {

/// Wheel and drag zoom and move; a click shows the instant in 3D.
class PlotPanel final : public QWidget {
 public:
  explicit PlotPanel(QWidget* parent = nullptr);

  void set_film(std::shared_ptr<const Film> film);
  void set_shown(int signal, bool shown);
  std::vector<int> shown() const;
  void clear();
  void refresh(double shown_s, bool follows);
  void fit();
  void restyle();

  std::function<void(double t_s)> sought;

  QCustomPlot& plot() { return *plot_; }
  int points_of(int signal) const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Curve {
    int signal;
    QCPGraph* graph;
  };
  void pull(Curve& curve);
  void lay_out();

  std::shared_ptr<const Film> film_;
  std::vector<Signal> signals_;
  std::vector<Curve> curves_;
  QCustomPlot* plot_;
  QCPItemStraightLine* cursor_;
  QLabel* empty_;
  bool moved_ = false;  ///< by the user: no following until fit()
  QPointF pressed_;
};

}  // namespace verp::view
