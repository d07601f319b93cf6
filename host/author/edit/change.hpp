#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "host/author/edit/document.hpp"

/// Edits of a robot's text, each as small as possible: all else stays byte for byte. These
/// functions do not apply them. They throw model::LoadError for what cannot be done.
namespace verp::edit {

/// Sets a number, word or attribute (`PATH@NAME`). Creates missing elements at the path's end: a
/// joint's <dynamics> for joint:l_knee/axis/dynamics/damping.
Edit set(const Document& document, const std::string& path, const std::string& value);

/// Removes the part and its dependents: with a joint its link and all joints of that, their servos,
/// frames, limbs and angles in poses.
Edit remove(const Document& document, int element);

/// Also changes every mention of the name.
Edit rename(const Document& document, int element, const std::string& name);

/// Adds an element as the last of `parent`, or behind its child `after`. Lines of `block` are
/// indented by two spaces a level; the file's own indentation is added.
Edit insert(const Document& document, int parent, const std::string& block, int after = -1);

/// Copies the part and its dependents beside it, under the name `name`. Servos get free ids.
Edit duplicate(const Document& document, int element, const std::string& name);

/// Copies the part to the other side: left in a name becomes right, l_ becomes r_, and y becomes
/// -y. Rotations are mirrored; joint axes point as before.
Edit mirror(const Document& document, int element);

/// The insertion point after an element; behind the comments on its line if it is the last.
std::size_t behind(const Document& document, int element);

/// Several changes as one.
Edit together(const Document& document, const std::string& what,
              const std::function<void(Document&)>& changes);

/// `element` and all that exists for it alone, in text order, not nested.
std::vector<int> what_hangs_on(const Document& document, int element);

/// "r_knee" for "l_knee", "RightFoot" for "LeftFoot"; empty: the name has no side.
std::string other_side(const std::string& name);

}  // namespace verp::edit
