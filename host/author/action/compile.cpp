#include "host/author/action/compile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "common/base/crc32.hpp"
#include "host/author/action/frames.hpp"

namespace verp::action {
namespace {

class Maker {
 public:
  Maker(const Params& params, std::vector<Document> documents)
      : params_(params), poser_(params), documents_(std::move(documents)) {
    // A page without steps has nothing to play.
    std::erase_if(documents_,
                  [](const Document& each) { return each.frames.empty() && !each.mirror; });
    std::sort(documents_.begin(), documents_.end(),
              [](const Document& a, const Document& b) { return a.name < b.name; });
  }

  CompiledActions make() {
    check_names();
    drafts_.resize(documents_.size());
    for (std::size_t i = 0; i < documents_.size(); ++i) {
      if (!documents_[i].mirror) drafts_[i] = draft(params_, poser_, documents_[i]);
    }
    for (std::size_t i = 0; i < documents_.size(); ++i) {
      if (documents_[i].mirror) reflect(i);
    }
    number_frames();
    for (std::size_t i = 0; i < documents_.size(); ++i) link(i);
    refuse_endless();
    for (std::size_t i = 0; i < documents_.size(); ++i) set_speeds(i);
    return finish();
  }

 private:
  [[noreturn]] static void fail(const Document& document, int line, const std::string& what,
                                const std::string& fix) {
    throw model::LoadError(document.file.string(), line, what, fix);
  }

  void check_names() {
    if (documents_.size() > kMaxActions) {
      fail(documents_.back(), documents_.back().line,
           fmt::format("more than {} actions", kMaxActions), "move some into another folder");
    }
    for (std::size_t i = 0; i < documents_.size(); ++i) {
      const Document& document = documents_[i];
      if (i > 0 && documents_[i - 1].name == document.name) {
        fail(
            document, document.line,
            fmt::format("action '{}' is in {} too", document.name, documents_[i - 1].file.string()),
            "give it another name");
      }
    }
  }

  std::size_t find(const Document& document, const Target& target) const {
    std::string names;
    for (std::size_t i = 0; i < documents_.size(); ++i) {
      if (documents_[i].name == target.name) return i;
      names += (i > 0 ? ", " : "") + documents_[i].name;
    }
    fail(document, target.line, fmt::format("there is no action '{}'", target.name),
         "there are: " + names);
  }

  void reflect(std::size_t index) {
    const Document& document = documents_[index];
    const std::size_t from = find(document, *document.mirror);
    if (documents_[from].mirror) {
      fail(document, document.mirror->line,
           fmt::format("'{}' is a mirror image itself", documents_[from].name),
           "mirror the action that it is made of");
    }
    drafts_[index] = mirrored(params_, drafts_[from], document);
  }

  void number_frames() {
    std::size_t count = 0;
    for (const Draft& draft : drafts_) {
      first_.push_back(count);
      count += draft.frames.size();
    }
    if (count > kMaxFrames) {
      fail(documents_.back(), 0, fmt::format("more than {} key frames", kMaxFrames),
           "move some actions into another folder");
    }
  }

  /// The document with the action's frames: itself or the mirrored one.
  const Document& source(std::size_t index) const {
    const Document& document = documents_[index];
    return document.mirror ? documents_[find(document, *document.mirror)] : document;
  }

  std::uint16_t resolve(std::size_t index, const Target& target, bool local) const {
    const Document& document = source(index);
    for (std::size_t i = 0; i < document.frames.size(); ++i) {
      if (document.frames[i].label == target.name) {
        return static_cast<std::uint16_t>(first_[index] + i);
      }
    }
    if (local) {
      fail(document, target.line, fmt::format("there is no frame '{}'", target.name),
           "give the name of a frame of this action");
    }
    if (target.name == "stand") return kToStand;
    return static_cast<std::uint16_t>(first_[find(document, target)]);
  }

  void link(std::size_t index) {
    const Document& document = source(index);
    std::optional<Target> exit;
    for (std::size_t i = 0; i < document.frames.size(); ++i) {
      const FrameText& text = document.frames[i];
      Frame& frame = drafts_[index].frames[i];
      const bool last = i + 1 == document.frames.size();
      frame.next = !last           ? static_cast<std::uint16_t>(first_[index] + i + 1)
                   : document.link ? resolve(index, *document.link, false)
                                   : kToStand;
      if (text.exit) exit = text.exit;
      if (exit) frame.exit = resolve(index, *exit, false);
      // A frame on the exit path goes to its next frame.
      const std::size_t at = first_[index] + i;
      if (frame.exit <= at && frame.exit >= first_[index]) frame.exit = frame.next;
      if (text.wait && text.wait->otherwise) {
        frame.otherwise = resolve(index, *text.wait->otherwise, false);
      } else {
        frame.otherwise = frame.next;
      }
      if (text.repeat) repeat(index, i, *text.repeat);
    }
  }

  void repeat(std::size_t index, std::size_t at, const Repeat& repeat) {
    const Document& document = source(index);
    Frame& frame = drafts_[index].frames[at];
    frame.loop_to = resolve(index, repeat.from, true);
    frame.loops = static_cast<std::uint8_t>(repeat.times);
    const std::size_t from = frame.loop_to - first_[index];
    if (from > at) {
      fail(document, repeat.from.line, fmt::format("'{}' comes later", repeat.from.name),
           "repeat from this frame or one before");
    }
    for (std::size_t i = from; i < at; ++i) {
      if (document.frames[i].repeat) {
        fail(document, repeat.from.line, "a repeat within a repeat", "write the inner frames out");
      }
    }
  }

  Frame& frame(std::size_t global) {
    std::size_t i = drafts_.size() - 1;
    while (first_[i] > global) --i;
    return drafts_[i].frames[global - first_[i]];
  }

  /// Repeats end by their count; other links must not loop.
  void refuse_endless() {
    for (std::size_t i = 0; i < documents_.size(); ++i) {
      std::map<std::uint16_t, int> seen;  // 1: on this path, 2: ends
      if (ends(static_cast<std::uint16_t>(first_[i]), seen)) continue;
      const Document& document = source(i);
      const int line = document.link ? document.link->line : document.line;
      fail(document, line,
           fmt::format("action '{}' never ends: its links come back", document.name),
           "let the last one end, or use repeat");
    }
  }

  bool ends(std::uint16_t at, std::map<std::uint16_t, int>& seen) {
    if (at == kToStand || seen[at] == 2) return true;
    if (seen[at] == 1) return false;
    seen[at] = 1;
    const Frame& now = frame(at);
    const bool good = ends(now.next, seen) && ends(now.otherwise, seen) && ends(now.exit, seen);
    seen[at] = 2;
    return good;
  }

  /// A joint passes key frames while it keeps its direction; it rests where it turns back, holds or
  /// waits.
  void set_speeds(std::size_t index) {
    Draft& own = drafts_[index];
    for (std::size_t i = 0; i < own.frames.size(); ++i) {
      Frame& now = own.frames[i];
      if (now.pause_ms > 0 || now.condition != Condition::kNone || now.loops > 0 ||
          now.next == kToStand) {
        continue;
      }
      const Frame& next = frame(now.next);
      for (int j = 0; j < params_.joint_count; ++j) {
        if ((now.joints >> j & next.joints & 1U) == 0) continue;
        const auto goal = [&](const Frame& of) { return 1e-4 * of.goal_tenth_mrad[j]; };
        const double before =
            i > 0 ? goal(own.frames[i - 1]) : poser_.stand_rad()[static_cast<std::size_t>(j)];
        const double in = (goal(now) - before) / (1e-3 * now.time_ms);
        const double out = (goal(next) - goal(now)) / (1e-3 * next.time_ms);
        if (in * out <= 0) continue;
        // The harmonic mean is below twice the slower side: no overshoot.
        const double speed = 2 * in * out / (in + out);
        now.speed_mrad_s[j] =
            static_cast<std::int16_t>(std::clamp(std::lround(1e3 * speed), -32767L, 32767L));
      }
    }
  }

  CompiledActions finish() {
    CompiledActions made;
    LibraryHeader header;
    std::memcpy(header.magic, kLibraryMagic, sizeof kLibraryMagic);
    header.library_version = kLibraryVersion;
    header.actions = static_cast<std::uint16_t>(documents_.size());
    std::vector<std::uint8_t> rest;
    const auto put = [&](const auto& value) {
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
      rest.insert(rest.end(), bytes, bytes + sizeof value);
    };
    for (std::size_t i = 0; i < documents_.size(); ++i) {
      Action action;
      std::memcpy(action.name, documents_[i].name.c_str(), documents_[i].name.size());
      action.first = static_cast<std::uint16_t>(first_[i]);
      action.frames = static_cast<std::uint16_t>(drafts_[i].frames.size());
      header.frames = static_cast<std::uint16_t>(header.frames + action.frames);
      put(action);
    }
    for (const Draft& draft : drafts_) {
      for (const Frame& each : draft.frames) put(each);
      made.line.insert(made.line.end(), draft.line.begin(), draft.line.end());
    }
    header.size = static_cast<std::uint32_t>(sizeof header + rest.size());
    header.crc32 = crc32(rest.data(), rest.size());
    made.words.resize(header.size / 4);
    std::memcpy(made.words.data(), &header, sizeof header);
    std::copy(rest.begin(), rest.end(),
              reinterpret_cast<std::uint8_t*>(made.words.data()) + sizeof header);
    made.documents = std::move(documents_);
    return made;
  }

  const Params& params_;
  Poser poser_;
  std::vector<Document> documents_;
  std::vector<Draft> drafts_;
  std::vector<std::size_t> first_;  ///< first frame of each action
};

}  // namespace

int CompiledActions::number(const std::string& name) const {
  for (std::size_t i = 0; i < documents.size(); ++i) {
    if (documents[i].name == name) return static_cast<int>(i) + 1;
  }
  return 0;
}

int CompiledActions::require(const std::string& name, const std::string& place) const {
  const int found = number(name);
  if (found > 0) return found;
  std::string names;
  for (const Document& each : documents) names += (names.empty() ? "" : ", ") + each.name;
  throw model::LoadError(
      place, 0, "there is no action '" + name + "'",
      names.empty() ? "write one: host/guide/actions.md has the words" : "there are: " + names);
}

CompiledActions make_library(const Params& params, std::vector<Document> documents) {
  return Maker(params, std::move(documents)).make();
}

}  // namespace verp::action
