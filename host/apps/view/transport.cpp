#include "host/apps/view/transport.hpp"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QSlider>
#include <QStyle>
#include <algorithm>
#include <cmath>

#include "host/apps/view/run/player.hpp"

namespace verp::view {
namespace {

constexpr int kSliderSteps = 100000;
constexpr double kSpeeds[] = {0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 0};
constexpr int kRealTime = 3;

}  // namespace

Transport::Transport(QWidget* parent)
    : QToolBar("Time", parent),
      slider_(new QSlider(Qt::Horizontal, this)),
      speed_(new QComboBox(this)),
      time_(new QLabel(this)) {
  setObjectName("timeline");
  setMovable(false);
  const auto add = [this](QStyle::StandardPixmap icon, const char* text, const char* tip,
                          const QList<QKeySequence>& keys) {
    QAction* action = addAction(style()->standardIcon(icon), text);
    action->setToolTip(QString("%1 (%2)").arg(tip, keys.first().toString()));
    action->setShortcuts(keys);
    return action;
  };
  reset = add(QStyle::SP_MediaSkipBackward, "Reset", "From the beginning", {Qt::CTRL | Qt::Key_R});
  back = add(QStyle::SP_MediaSeekBackward, "Tick back", "One tick back", {Qt::Key_Comma});
  play = add(QStyle::SP_MediaPlay, "Play", "Play or pause", {Qt::Key_P});
  tick = add(QStyle::SP_MediaSeekForward, "One tick", "One tick on", {Qt::Key_Period});
  for (const double speed : kSpeeds) {
    speed_->addItem(speed > 0 ? QString("%1×").arg(speed) : QString("unpaced"), speed);
  }
  speed_->setObjectName("speed");
  speed_->setCurrentIndex(kRealTime);
  speed_->setToolTip("Speed ([ and ])");
  speed_->setFocusPolicy(Qt::NoFocus);
  slider_->setObjectName("scrub");
  slider_->setRange(0, kSliderSteps);
  slider_->setFocusPolicy(Qt::ClickFocus);
  time_->setMinimumWidth(150);
  time_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  time_->setObjectName("time");
  addWidget(speed_);
  addWidget(slider_);
  addWidget(time_);
  connect(speed_, &QComboBox::currentIndexChanged, this, [this] {
    if (player_ != nullptr) player_->set_speed(speed_->currentData().toDouble());
  });
  connect(slider_, &QSlider::valueChanged, this, [this](int value) {
    if (player_ == nullptr) return;
    const auto film = player_->film();
    player_->seek(film->begin_s() + (film->end_s() - film->begin_s()) * value / kSliderSteps);
  });
  connect(play, &QAction::triggered, this, [this] {
    if (player_ != nullptr) player_->playing() ? player_->pause() : player_->play();
  });
  connect(tick, &QAction::triggered, this, [this] {
    if (player_ != nullptr) player_->step(1);
  });
  connect(back, &QAction::triggered, this, [this] {
    if (player_ != nullptr) player_->step(-1);
  });
  connect(reset, &QAction::triggered, this, [this] {
    if (player_ != nullptr) player_->reset();
  });
  set_player(nullptr);
}

void Transport::set_player(Player* player) {
  player_ = player;
  if (player != nullptr) player->set_speed(speed_->currentData().toDouble());
  for (QAction* action : {play, back, tick, reset}) action->setEnabled(player != nullptr);
  slider_->setEnabled(player != nullptr);
  refresh();
}

void Transport::refresh() {
  const bool playing = player_ != nullptr && player_->playing();
  play->setIcon(style()->standardIcon(playing ? QStyle::SP_MediaPause : QStyle::SP_MediaPlay));
  play->setText(playing ? "Pause" : "Play");
  if (player_ == nullptr) return time_->setText("");
  const auto film = player_->film();
  const double begin_s = film->begin_s(), all_s = film->end_s() - begin_s;
  const QSignalBlocker quiet(slider_);
  if (!slider_->isSliderDown()) {
    slider_->setValue(all_s > 0
                          ? int(std::lround(kSliderSteps * (player_->shown_s() - begin_s) / all_s))
                          : kSliderSteps);
  }
  time_->setText(
      QString("%1 of %2 s").arg(player_->shown_s(), 0, 'f', 2).arg(film->end_s(), 0, 'f', 2));
}

void Transport::change_speed(int by) {
  speed_->setCurrentIndex(std::clamp(speed_->currentIndex() + by, 0, speed_->count() - 1));
}

}  // namespace verp::view
