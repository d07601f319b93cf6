#include "host/apps/view/plot_panel.hpp"

#include <qcustomplot.h>

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/apps/view/theme.hpp"

namespace verp::view {
namespace {

constexpr double kWindow_s = 10;  // shown of a live run
constexpr double kClick_px = 4;

QToolButton* button(QWidget* parent, const char* text, const char* tip) {
  auto* made = new QToolButton(parent);
  made->setText(text);
  made->setToolTip(tip);
  return made;
}

}  // namespace

PlotPanel::PlotPanel(QWidget* parent)
    : QWidget(parent), plot_(new QCustomPlot(this)), cursor_(new QCPItemStraightLine(plot_)) {
  setObjectName("plots");
  cursor_->point1->setCoords(0, 0);
  cursor_->point2->setCoords(0, 1);
  plot_->setObjectName("plot");
  plot_->setMinimumHeight(110);
  plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  plot_->axisRect()->setRangeDrag(Qt::Horizontal);
  plot_->axisRect()->setRangeZoom(Qt::Horizontal);
  plot_->xAxis->setLabel("simulated time, s");
  plot_->legend->setVisible(true);
  plot_->axisRect()->insetLayout()->setInsetAlignment(0, Qt::AlignLeft | Qt::AlignTop);
  plot_->installEventFilter(this);
  empty_ = new QLabel("Tick signals on the left to plot them", plot_);
  empty_->setObjectName("hint");
  auto* fit = button(this, "Fit", "Follow the run again, and show all of each curve (Home)");
  auto* clear = button(this, "Clear", "Plot nothing");
  auto* buttons = new QVBoxLayout;
  buttons->addWidget(fit);
  buttons->addWidget(clear);
  buttons->addStretch();
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 6, 0);
  layout->addWidget(plot_, 1);
  layout->addLayout(buttons);
  connect(fit, &QToolButton::clicked, this, [this] { this->fit(); });
  connect(clear, &QToolButton::clicked, this, [this] { this->clear(); });
  restyle();
  lay_out();
}

void PlotPanel::set_film(std::shared_ptr<const Film> film) {
  film_ = std::move(film);
  signals_ = film_->all_signals();
  for (Curve& curve : curves_) curve.graph->data()->clear();
  moved_ = false;
}

void PlotPanel::set_shown(int signal, bool shown) {
  const auto found = std::find_if(curves_.begin(), curves_.end(),
                                  [&](const Curve& curve) { return curve.signal == signal; });
  if (shown == (found != curves_.end())) return;
  if (shown) {
    curves_.push_back({signal, plot_->addGraph()});
    pull(curves_.back());
  } else {
    plot_->removeGraph(found->graph);
    curves_.erase(found);
  }
  lay_out();
}

std::vector<int> PlotPanel::shown() const {
  std::vector<int> all;
  for (const Curve& curve : curves_) all.push_back(curve.signal);
  return all;
}

void PlotPanel::clear() {
  while (!curves_.empty()) set_shown(curves_.back().signal, false);
}

int PlotPanel::points_of(int signal) const {
  for (const Curve& curve : curves_) {
    if (curve.signal == signal) return curve.graph->data()->size();
  }
  return 0;
}

/// The first curve's unit is left; all others are right.
void PlotPanel::lay_out() {
  QStringList left, right;
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const Signal& signal = signals_[std::size_t(curves_[i].signal)];
    const Signal& first = signals_[std::size_t(curves_.front().signal)];
    const bool same = signal.unit == first.unit;
    QCPGraph& graph = *curves_[i].graph;
    graph.setValueAxis(same ? plot_->yAxis : plot_->yAxis2);
    graph.setPen(QPen(theme().series(int(i)), 1.4));
    graph.setName(QString::fromStdString(signal.label()) +
                  (signal.unit.empty() ? "" : ", " + QString::fromStdString(signal.unit)));
    const QString unit = QString::fromStdString(signal.unit);
    QStringList& units = same ? left : right;
    if (!units.contains(unit)) units << unit;
  }
  plot_->yAxis->setLabel(left.join(", "));
  plot_->yAxis2->setLabel(right.join(", "));
  plot_->yAxis2->setVisible(!right.isEmpty());
  plot_->legend->setVisible(!curves_.empty());
  empty_->setVisible(curves_.empty());
  plot_->replot(QCustomPlot::rpQueuedReplot);
}

void PlotPanel::pull(Curve& curve) {
  if (!film_) return;
  const auto drawn = curve.graph->data();
  const double after_s = drawn->isEmpty() ? -std::numeric_limits<double>::infinity()
                                          : std::prev(drawn->constEnd())->key;
  std::vector<Point> points;
  film_->points(curve.signal, after_s, points);
  for (const Point& point : points) curve.graph->addData(point.t_s, point.value);
}

void PlotPanel::refresh(double shown_s, bool follows) {
  if (!film_ || film_->empty()) return;
  for (Curve& curve : curves_) pull(curve);
  cursor_->point1->setCoords(shown_s, 0);
  cursor_->point2->setCoords(shown_s, 1);
  if (!moved_) {
    const double end_s = film_->end_s();
    const double begin_s =
        follows ? std::max(end_s - kWindow_s, film_->begin_s()) : film_->begin_s();
    plot_->xAxis->setRange(begin_s, std::max(end_s, begin_s + 1));
  }
  for (QCPAxis* axis : {plot_->yAxis, plot_->yAxis2}) {
    axis->rescale(true);
    axis->scaleRange(1.15);
  }
  if (isVisible()) plot_->replot(QCustomPlot::rpQueuedReplot);
}

void PlotPanel::fit() {
  moved_ = false;
}

void PlotPanel::restyle() {
  apply_theme(*plot_);
  cursor_->setPen(QPen(theme().accent, 1, Qt::DashLine));
  lay_out();
}

bool PlotPanel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize) {
    empty_->adjustSize();
    empty_->move((plot_->width() - empty_->width()) / 2, plot_->height() / 2 - 24);
  }
  if (event->type() == QEvent::Wheel) moved_ = true;
  if (event->type() == QEvent::MouseButtonPress) {
    pressed_ = static_cast<QMouseEvent*>(event)->position();
  }
  if (event->type() == QEvent::MouseButtonRelease) {
    const QPointF at = static_cast<QMouseEvent*>(event)->position();
    if (QLineF(pressed_, at).length() > kClick_px) {
      moved_ = true;
    } else if (sought && plot_->axisRect()->rect().contains(at.toPoint())) {
      sought(plot_->xAxis->pixelToCoord(at.x()));
    }
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace verp::view
