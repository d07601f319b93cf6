#pragma once
#include <QColor>
#include <QString>

class QApplication;
class QCustomPlot;

/// The report's colours.
namespace verp::view {

struct Theme {
  bool dark = false;
  QColor window, panel, text, faint, line, accent, good, warn, bad;
  QColor series(int index) const;
};

const Theme& theme();
void apply_theme(QApplication& application, bool dark);
void apply_theme(QCustomPlot& plot);

}  // namespace verp::view
