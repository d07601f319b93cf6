#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "host/author/edit/document.hpp"

/// Changes of a robot's text, each the smallest that does it: all else stays as it is, byte for
/// byte. None is applied here; throws model::LoadError for what cannot be done.
namespace verp::edit {

/// A number, word or attribute (`PATH@NAME`). What the path lacks at its end is made: a joint's
/// <dynamics> for joint:l_knee/axis/dynamics/damping.
Edit set(const Document& document, const std::string& path, const std::string& value);

/// The part and what hangs on it: with a joint its link and all joints of that, their servos,
/// frames, limbs and angles in poses.
Edit remove(const Document& document, int element);

/// Everywhere where it is mentioned, too.
Edit rename(const Document& document, int element, const std::string& name);

/// A new element as the last of `parent`, or behind `after`, one of its children. Lines of `block`
/// are indented by two spaces a level; the file's own indentation comes in front.
Edit insert(const Document& document, int parent, const std::string& block, int after = -1);

/// The part and what hangs on it once more, beside it, named `name`. Servos get free ids.
Edit duplicate(const Document& document, int element, const std::string& name);

/// The same on the other side: left in a name is right there, l_ is r_; y is -y; what turns turns
/// as a mirror's image does, in axes that point as before.
Edit mirror(const Document& document, int element);

/// Where what comes behind an element belongs: behind the comments on its line, if it is the last.
std::size_t behind(const Document& document, int element);

/// Several changes as one.
Edit together(const Document& document, const std::string& what,
              const std::function<void(Document&)>& changes);

/// `element` and all that exists for it alone, in the order of the text, none within another.
std::vector<int> what_hangs_on(const Document& document, int element);

/// "l_knee" is "r_knee", "LeftFoot" is "RightFoot"; empty: the name has no side.
std::string other_side(const std::string& name);

}  // namespace verp::edit
