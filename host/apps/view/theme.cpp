#include "host/apps/view/theme.hpp"

#include <qcustomplot.h>

#include <QApplication>
#include <QPalette>
#include <QStyleFactory>

#include "host/study/report/palette.hpp"

namespace verp::view {
namespace {

Theme made(bool dark) {
  Theme made;
  made.dark = dark;
  made.window = dark ? "#1f2328" : "#eef0f2";
  made.panel = dark ? "#282d33" : "#ffffff";
  made.text = dark ? "#e4e7ea" : "#22262b";
  made.faint = dark ? "#98a1ab" : "#5c6670";
  made.line = dark ? "#3a4149" : "#d5d8dc";
  made.accent = dark ? "#6ea8e6" : "#2563a8";
  made.good = dark ? "#68c292" : "#2f8557";
  made.warn = dark ? "#e0bd4f" : "#9a7700";
  made.bad = dark ? "#f0806a" : "#b3261e";
  return made;
}

Theme in_force = made(false);

const char* const kSheet = R"(
QToolBar { border: 0; border-bottom: 1px solid %line; padding: 3px; spacing: 3px; background: %window; }
QToolBar#timeline { border-bottom: 0; border-top: 1px solid %line; }
QToolButton { padding: 4px 7px; border-radius: 4px; border: 1px solid transparent; }
QToolButton:hover { background: %panel; border-color: %line; }
QToolButton:checked { background: %panel; border-color: %accent; }
QDockWidget { font-weight: 600; }
QDockWidget::title { background: %window; padding: 5px 8px; border-bottom: 1px solid %line; }
QStatusBar { border-top: 1px solid %line; }
QStatusBar::item { border: 0; }
QTreeView, QTableView, QListView { border: 0; }
QHeaderView::section { background: %panel; color: %faint; border: 0; border-bottom: 1px solid %line; padding: 4px 6px; }
QTabBar::tab { padding: 5px 12px; }
QMainWindow::separator { background: %line; width: 1px; height: 1px; }
QLabel#hint { color: %faint; }
QLabel#overlay { color: %text; background: %veil; border-radius: 5px; padding: 5px 9px; }
QPushButton#stop { color: white; background: %bad; border: 0; border-radius: 4px; padding: 5px 12px; font-weight: 600; }
QPushButton#stop:checked { background: #22262b; }
)";

QString sheet(const Theme& theme) {
  QString text = kSheet;
  QColor veil = theme.panel;
  veil.setAlpha(215);
  text.replace("%line", theme.line.name()).replace("%window", theme.window.name());
  text.replace("%panel", theme.panel.name()).replace("%accent", theme.accent.name());
  text.replace("%faint", theme.faint.name()).replace("%text", theme.text.name());
  text.replace("%veil", veil.name(QColor::HexArgb)).replace("%bad", theme.bad.name());
  return text;
}

void apply(QCPAxis& axis, const Theme& theme) {
  axis.setBasePen(QPen(theme.line));
  axis.setTickPen(QPen(theme.line));
  axis.setSubTickPen(Qt::NoPen);
  axis.setTickLabelColor(theme.faint);
  axis.setLabelColor(theme.faint);
  axis.grid()->setPen(QPen(theme.line, 1, Qt::DotLine));
  axis.grid()->setZeroLinePen(QPen(theme.line));
}

}  // namespace

QColor Theme::series(int index) const {
  const report::Colour& colour = report::kSeries[index % report::kSeriesCount];
  return dark ? colour.dark : colour.light;
}

const Theme& theme() {
  return in_force;
}

void apply_theme(QApplication& application, bool dark) {
  in_force = made(dark);
  const Theme& t = in_force;
  application.setStyle(QStyleFactory::create("Fusion"));
  QPalette colours;
  colours.setColor(QPalette::Window, t.window);
  colours.setColor(QPalette::WindowText, t.text);
  colours.setColor(QPalette::Base, t.panel);
  colours.setColor(QPalette::AlternateBase, t.window);
  colours.setColor(QPalette::Text, t.text);
  colours.setColor(QPalette::Button, t.window);
  colours.setColor(QPalette::ButtonText, t.text);
  colours.setColor(QPalette::Highlight, t.accent);
  colours.setColor(QPalette::HighlightedText, t.panel);
  colours.setColor(QPalette::ToolTipBase, t.panel);
  colours.setColor(QPalette::ToolTipText, t.text);
  colours.setColor(QPalette::PlaceholderText, t.faint);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    colours.setColor(QPalette::Disabled, role, t.dark ? "#626b75" : "#a4abb3");
  }
  application.setPalette(colours);
  application.setStyleSheet(sheet(t));
}

void apply_theme(QCustomPlot& plot) {
  const Theme& t = in_force;
  plot.setBackground(t.panel);
  for (QCPAxis* axis : {plot.xAxis, plot.yAxis, plot.xAxis2, plot.yAxis2}) apply(*axis, t);
  plot.legend->setBrush(QBrush(t.panel));
  plot.legend->setTextColor(t.text);
  plot.legend->setBorderPen(QPen(t.line));
}

}  // namespace verp::view
