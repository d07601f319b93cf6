#pragma once
#include <functional>
#include <string>

namespace verp::view {

/// Why no window can open here, as one line; empty: nothing speaks against it. Before QApplication,
/// which would end the program.
std::string no_display();

/// Why nothing can be drawn on this display, as one line; empty: OpenGL 3.3 is there. After
/// QApplication and before any window, in which Qt would crash.
std::string no_driver();

/// From now on a display that goes away, or was none, ends the program with one line and exit
/// status 3, after `save`, which may add a line. Once before the window is made, without
/// `save`, and once with it.
void survive_the_display(std::function<std::string()> save);
/// The program ends as it should: nothing is to be told.
void leave_the_display();

}  // namespace verp::view
