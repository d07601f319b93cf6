#pragma once
#include <QColor>
#include <QString>

class QApplication;
class QCustomPlot;

/// Colours of the window: the report's, so that a curve looks the same in both.
namespace verp::view {

struct Theme {
  bool dark = false;
  QColor window, panel, text, faint, line, accent, good, warn, bad;
  QColor series(int index) const;
};

/// The one in force.
const Theme& theme();
void apply_theme(QApplication& application, bool dark);
void apply_theme(QCustomPlot& plot);

}  // namespace verp::view
