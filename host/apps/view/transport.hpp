#pragma once
#include <QToolBar>

class QComboBox;
class QLabel;
class QSlider;
class QAction;

namespace verp::view {

class Player;

class Transport final : public QToolBar {
 public:
  explicit Transport(QWidget* parent = nullptr);

  void set_player(Player* player);
  void refresh();

  QAction* play;
  QAction* back;
  QAction* tick;
  QAction* reset;
  void change_speed(int by);

 private:
  Player* player_ = nullptr;
  QSlider* slider_;
  QComboBox* speed_;
  QLabel* time_;
};

}  // namespace verp::view
