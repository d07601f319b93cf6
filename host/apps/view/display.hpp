#pragma once
#include <functional>
#include <string>

namespace verp::view {

/// The reason in one line why no window can open here, else empty. Call it before QApplication,
/// which would end the program.
std::string no_display();

/// The reason in one line why OpenGL 3.3 is missing on this display, else empty. Call it after
/// QApplication and before any window, because Qt would crash in one.
std::string no_driver();

/// From now on, losing the display calls `save`, prints one line and `save`'s line if there is one,
/// and exits with status 3. Call it once before the window is made, without `save`, and once after,
/// with it.
void survive_the_display(std::function<std::string()> save);
/// The program ends normally: print nothing.
void leave_the_display();

}  // namespace verp::view
