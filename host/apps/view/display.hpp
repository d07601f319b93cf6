#pragma once
#include <functional>
#include <string>

namespace verp::view {

/// Why no window can open, or empty. Call before QApplication, which would end the program.
std::string no_display();

/// Why OpenGL 3.3 is missing, or empty. Call after QApplication and before any window, in which Qt
/// would crash.
std::string no_driver();

/// Losing the display then calls `save`, prints one line and `save`'s, and exits with 3. Call
/// before the window is made, without `save`, and after, with it.
void survive_the_display(std::function<std::string()> save);
void leave_the_display();

}  // namespace verp::view
