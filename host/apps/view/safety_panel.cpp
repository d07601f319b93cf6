#include "host/apps/view/safety_panel.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QListWidget>
#include <QVBoxLayout>

#include "common/safety/machine.hpp"
#include "host/apps/view/theme.hpp"
#include "host/run/session/fault_names.hpp"

namespace verp::view {
namespace {

constexpr int kMostLines = 500;

QLabel* heading(const char* text) {
  auto* label = new QLabel(text);
  label->setStyleSheet("font-weight: 600;");
  return label;
}

void light(QLabel& lamp, bool on, const QColor& colour) {
  const Theme& t = theme();
  lamp.setStyleSheet(
      on ? QString("background: %1; color: white; border-radius: 3px; padding: 2px 6px;"
                   "font-weight: 600;")
               .arg(colour.name())
         : QString("color: %1; padding: 2px 6px;").arg(t.faint.name()));
}

bool stops(std::uint32_t bit) {
  return (bit & 0xFFFF) != 0;
}

}  // namespace

SafetyPanel::SafetyPanel(QWidget* parent) : QWidget(parent), log_(new QListWidget(this)) {
  setObjectName("safety");
  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(4);
  layout->addWidget(heading("Mode"));
  auto* modes = new QGridLayout;
  for (int i = 0; i < safety::kModes; ++i) {
    modes_.push_back(new QLabel(safety::kModeNames[i]));
    modes_.back()->setObjectName(QString("mode_%1").arg(safety::kModeNames[i]));
    modes->addWidget(modes_.back(), i / 4, i % 4);
  }
  layout->addLayout(modes);
  layout->addWidget(heading("Faults that stop the robot"));
  auto* faults = new QGridLayout;
  auto* notes = new QGridLayout;
  for (const session::FaultName& fault : session::all_fault_names()) {
    auto* lamp = new QLabel(fault.name);
    lamp->setObjectName(QString("fault_%1").arg(fault.name));
    QGridLayout* grid = stops(fault.bit) ? faults : notes;
    grid->addWidget(lamp, grid->count() / 2, grid->count() % 2);
    faults_.push_back(lamp);
  }
  layout->addLayout(faults);
  layout->addWidget(heading("Notes of what was limited"));
  layout->addLayout(notes);
  layout->addWidget(heading("What happened"));
  log_->setObjectName("safety_log");
  layout->addWidget(log_, 1);
  clear();
}

void SafetyPanel::clear() {
  mode_ = -1;
  bits_ = 0;
  t_s_ = 0;
  log_->clear();
  for (QLabel* lamp : modes_) light(*lamp, false, {});
  for (QLabel* lamp : faults_) light(*lamp, false, {});
}

void SafetyPanel::log(double t_s, const QString& text) {
  log_->addItem(QString("%1 s  %2").arg(t_s, 8, 'f', 3).arg(text));
  if (log_->count() > kMostLines) delete log_->takeItem(0);
  log_->scrollToBottom();
}

void SafetyPanel::show_robot(double t_s, const scene::RobotView& robot) {
  const bool ahead = t_s >= t_s_;
  t_s_ = t_s;
  if (robot.mode != mode_ && robot.mode < safety::kModes) {
    if (ahead && mode_ >= 0) {
      log(t_s, QString("%1 → %2").arg(safety::kModeNames[mode_], safety::kModeNames[robot.mode]));
    }
    mode_ = robot.mode;
    const bool bad = mode_ >= int(safety::Mode::kHolding) && mode_ != int(safety::Mode::kSitting);
    for (int i = 0; i < safety::kModes; ++i) {
      light(*modes_[std::size_t(i)], i == mode_, bad ? theme().bad : theme().accent);
    }
  }
  if (robot.faults == bits_) return;
  std::size_t lamp = 0;
  for (const session::FaultName& fault : session::all_fault_names()) {
    const bool on = (robot.faults & fault.bit) != 0, was = (bits_ & fault.bit) != 0;
    light(*faults_[lamp++], on, stops(fault.bit) ? theme().bad : theme().warn);
    if (on != was && ahead) log(t_s, QString(on ? "%1" : "%1: over").arg(fault.name));
  }
  bits_ = robot.faults;
}

}  // namespace verp::view
