#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "host/author/edit/document.hpp"

/// Smallest edits of a robot's text; all else stays byte for byte. They are not applied here.
/// Throws model::LoadError.
namespace verp::edit {

/// Sets a number, word or attribute (`PATH@NAME`). Creates what the path lacks at its end: a
/// joint's <dynamics> for joint:l_knee/axis/dynamics/damping.
Edit set(const Document& document, const std::string& path, const std::string& value);

/// Removes the part and its dependents: a joint's link and all joints of that, servos, frames,
/// limbs, and angles in poses.
Edit remove(const Document& document, int element);

Edit rename(const Document& document, int element, const std::string& name);

/// Inserts `block` as the last child of `parent`, or behind child `after`. `block` has two spaces a
/// level; the file's own indentation is added.
Edit insert(const Document& document, int parent, const std::string& block, int after = -1);

/// Copies the part with dependents beside the part. Servos get free ids.
Edit duplicate(const Document& document, int element, const std::string& name);

/// Copies to the other side: left becomes right, l_ becomes r_, y becomes -y. Rotations are
/// mirrored; joint axes point as before.
Edit mirror(const Document& document, int element);

/// The place behind an element; behind the comments on its line if the element is the last.
std::size_t behind(const Document& document, int element);

Edit together(const Document& document, const std::string& what,
              const std::function<void(Document&)>& changes);

/// The element and what exists for it alone, in text order, not nested.
std::vector<int> what_hangs_on(const Document& document, int element);

/// "r_knee" for "l_knee", "RightFoot" for "LeftFoot"; or empty.
std::string other_side(const std::string& name);

}  // namespace verp::edit
