#pragma once
#include <string>

namespace verp::view {

/// Demands of a gamepad's sticks, from -1 to 1; 0 near the middle.
struct Sticks {
  double ahead = 0, left = 0, turn = 0;
  bool operator==(const Sticks&) const = default;
};

/// A gamepad at the kernel's joystick interface (/dev/input/js0). The left stick walks, the right
/// one turns, the first button stands, the second is the emergency stop. It may come and go;
/// unplugging it releases all sticks.
class Gamepad {
 public:
  /// Opens it now, or later when it is there.
  explicit Gamepad(std::string device) : device_(std::move(device)) {}
  ~Gamepad();
  Gamepad(const Gamepad&) = delete;
  Gamepad& operator=(const Gamepad&) = delete;

  /// Changes since the last poll.
  struct News {
    bool moved = false;  ///< sticks() has changed
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
  int wait_ = 0;  ///< polls until the next attempt to open it
  bool present_ = false;
  Sticks sticks_;
};

}  // namespace verp::view
