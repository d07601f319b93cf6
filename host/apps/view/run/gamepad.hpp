#pragma once
#include <string>

namespace verp::view {

/// From -1 to 1; 0 near the middle.
struct Sticks {
  double ahead = 0, left = 0, turn = 0;
  bool operator==(const Sticks&) const = default;
};

/// Kernel joystick (/dev/input/js0). Left stick: walk; right stick: turn; first button: stand;
/// second: emergency stop. Unplugging releases all sticks.
class Gamepad {
 public:
  /// Opens the device once it exists.
  explicit Gamepad(std::string device) : device_(std::move(device)) {}
  ~Gamepad();
  Gamepad(const Gamepad&) = delete;
  Gamepad& operator=(const Gamepad&) = delete;

  struct News {
    bool moved = false;
    bool stand = false, stop = false;
    bool came = false, went = false;
  };
  News poll();
  const Sticks& sticks() const { return sticks_; }
  bool present() const { return present_; }
  const std::string& device() const { return device_; }

 private:
  void open();
  void close(News& news);
  void take(int type, int number, int value, News& news);

  const std::string device_;
  int descriptor_ = -1;
  int wait_ = 0;  ///< polls until the next attempt
  bool present_ = false;
  Sticks sticks_;
};

}  // namespace verp::view
