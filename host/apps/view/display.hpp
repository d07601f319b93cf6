#pragma once
#include <functional>
#include <string>

namespace verp::view {

/// Why no window can open, in one line, or empty. Call it before QApplication, which would end the
/// program.
std::string no_display();

/// Why OpenGL 3.3 is missing here, in one line, or empty. Call it after QApplication and before any
/// window, in which Qt would crash.
std::string no_driver();

/// From now on, losing the display calls `save`, prints one line and `save`'s line, and exits with
/// status 3. Call it before the window is made, without `save`, and again after, with it.
void survive_the_display(std::function<std::string()> save);
/// The program ends normally.
void leave_the_display();

}  // namespace verp::view
