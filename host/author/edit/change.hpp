#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "host/author/edit/document.hpp"

/// The smallest edits of a robot's text: all else stays byte for byte. None is applied here. Throws
/// model::LoadError for what cannot be done.
namespace verp::edit {

/// Sets a number, word or attribute (`PATH@NAME`). Creates what the path lacks at its end: a
/// joint's <dynamics> for joint:l_knee/axis/dynamics/damping.
Edit set(const Document& document, const std::string& path, const std::string& value);

/// Removes the part and its dependents: with a joint its link and all joints of that, their servos,
/// frames, limbs and angles in poses.
Edit remove(const Document& document, int element);

/// Renames the part and every mention of it.
Edit rename(const Document& document, int element, const std::string& name);

/// Inserts `block` as the last child of `parent`, or behind its child `after`. Lines of `block` are
/// indented by two spaces a level; the file's own indentation is added.
Edit insert(const Document& document, int parent, const std::string& block, int after = -1);

/// Copies the part and its dependents beside it. Servos get free ids.
Edit duplicate(const Document& document, int element, const std::string& name);

/// Copies the part to the other side: left becomes right, l_ becomes r_, y becomes -y. Rotations
/// are mirrored; joint axes point as before.
Edit mirror(const Document& document, int element);

/// Insertion point after an element; behind the comments on its line if it is the last.
std::size_t behind(const Document& document, int element);

Edit together(const Document& document, const std::string& what,
              const std::function<void(Document&)>& changes);

/// `element` and what exists for it alone, in text order, not nested.
std::vector<int> what_hangs_on(const Document& document, int element);

/// "r_knee" for "l_knee", "RightFoot" for "LeftFoot"; empty: the name has no side.
std::string other_side(const std::string& name);

}  // namespace verp::edit
