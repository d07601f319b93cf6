#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <sstream>

#include "host/author/action/robotis.hpp"
#include "host/author/action/words.hpp"
#include "host/os/files/whole.hpp"

namespace verp::action {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMostTime_s = 60, kMostMove_m = 1, kMostTurn_deg = 360, kMostLoops = 255;
constexpr const char* kConditionNames[kConditions] = {
    "none",       "upright",   "lies_front", "lies_back", "lies_left",
    "lies_right", "left_foot", "right_foot", "both_feet", "no_foot"};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) { document_.file = file; }

  void read(Words words) {
    if (words.done()) return;
    if (words.take("action")) {
      if (!document_.name.empty()) words.fail("a second action in one file", "give it its own");
      document_.line = words.line();
      document_.name = words.word("the action's name");
      if (document_.name.size() >= kNameLength) {
        words.fail("the name '" + document_.name + "' is too long",
                   "give at most " + std::to_string(kNameLength - 1) + " letters");
      }
    } else if (document_.name.empty()) {
      words.fail("'" + words.peek() + "' before the action's name", "begin with: action NAME");
    } else if (words.take("note")) {
      while (!words.done()) {
        document_.note += (document_.note.empty() ? "" : " ") + words.word("a note");
      }
    } else if (words.take("robotis")) {
      page(words);
    } else if (words.take("mirror")) {
      document_.mirror = target(words, "the action to mirror");
    } else if (words.take("link")) {
      document_.link = target(words, "the action that follows");
    } else if (words.take("frame")) {
      begin_frame(words);
    } else if (document_.frames.empty()) {
      words.fail("'" + words.peek() + "' before the first frame", "begin one: frame SECONDS");
    } else {
      in_frame(words, document_.frames.back());
    }
    words.end();
  }

  Document finish() {
    const std::string file = document_.file.string();
    if (document_.name.empty()) {
      throw model::LoadError(file, 1, "no action is in it", "begin with: action NAME");
    }
    if (document_.mirror && !document_.frames.empty()) {
      throw model::LoadError(file, document_.mirror->line,
                             "a mirrored action has frames of its own", "leave them out");
    }
    if (!document_.mirror && !document_.page && document_.frames.empty()) {
      throw model::LoadError(file, document_.line, "the action has no frame",
                             "give one: frame SECONDS, then JOINT DEGREES");
    }
    return std::move(document_);
  }

 private:
  static Target target(Words& words, const char* what) { return {words.word(what), words.line()}; }

  /// "page N", then lines of "OFFSET HEX"; other bytes are a blank page's.
  void page(Words& words) {
    if (words.take("page")) {
      const double number = words.number("the page", 0, kPages - 1);
      const Page blank = blank_page();
      document_.page = PageText{static_cast<int>(number), {blank.begin(), blank.end()}};
      return;
    }
    if (!document_.page) words.fail("bytes before their page", "begin with: robotis page NUMBER");
    auto at = static_cast<std::size_t>(words.number("the offset", 0, kPageBytes - 1));
    const std::string hex = words.word("bytes in hexadecimal");
    for (std::size_t i = 0; i < hex.size(); i += 2, ++at) {
      unsigned value = 0;
      const char* pair = hex.data() + i;
      const bool good = i + 2 <= hex.size() && at < kPageBytes &&
                        std::from_chars(pair, pair + 2, value, 16).ptr == pair + 2;
      if (!good) words.fail("'" + hex + "' is not bytes of a page", "give two digits each");
      document_.page->bytes[at] = static_cast<std::uint8_t>(value);
    }
  }

  void begin_frame(Words& words) {
    FrameText frame;
    frame.line = words.line();
    if (!Words::number_in(words.peek())) frame.label = words.word("the frame's time, s");
    frame.time_s = words.number("the frame's time, s", 1e-3 * kLeastFrame_ms, kMostTime_s);
    if (words.take("hold")) frame.hold_s = words.number("the hold, s", 0, kMostTime_s);
    for (const FrameText& other : document_.frames) {
      if (!frame.label.empty() && other.label == frame.label) {
        words.fail("a second frame '" + frame.label + "'", "give it a name of its own");
      }
    }
    document_.frames.push_back(frame);
  }

  void in_frame(Words& words, FrameText& frame) {
    if (words.take("smooth")) {
      frame.smooth = true;
    } else if (words.take("cubic")) {
      frame.smooth = false;
    } else if (words.take("balance")) {
      frame.balance = words.take("on") || !take_or_fail(words, "off", "on or off");
    } else if (words.take("stance")) {
      frame.stance = stance(words);
    } else if (words.take("over")) {
      over(words, frame);
    } else if (words.take("body")) {
      frame.body = offset(words);
    } else if (words.take("left_foot")) {
      frame.foot[0] = offset(words);
    } else if (words.take("right_foot")) {
      frame.foot[1] = offset(words);
    } else if (words.take("stiff")) {
      Stiffness stiff{{}, 100, words.line()};
      stiff.percent = static_cast<int>(words.number("the stiffness, %", 0, 100));
      while (!words.done()) stiff.joints.push_back(words.word("a joint"));
      frame.stiffness.push_back(stiff);
    } else if (words.take("exit")) {
      frame.exit = target(words, "a frame, an action or stand");
    } else if (words.take("repeat")) {
      Repeat repeat;
      repeat.times = static_cast<int>(words.number("how often", 1, kMostLoops));
      take_or_fail(words, "from", "from and the frame to begin with");
      repeat.from = target(words, "the frame to begin with");
      frame.repeat = repeat;
    } else if (words.take("wait")) {
      wait(words, frame);
    } else {
      while (!words.done()) add_goal(words, frame);
    }
  }

  static bool take_or_fail(Words& words, const char* word, const char* choice) {
    if (!words.take(word)) {
      words.fail(words.done() ? "a word is missing" : "'" + words.peek() + "' is not understood",
                 std::string("give ") + choice);
    }
    return true;
  }

  static Stance stance(Words& words) {
    if (words.take("left")) return Stance::kLeft;
    if (words.take("right")) return Stance::kRight;
    if (words.take("both")) return Stance::kBoth;
    take_or_fail(words, "none", "left, right, both or none");
    return Stance::kNone;
  }

  static void over(Words& words, FrameText& frame) {
    frame.over_line = words.line();
    const Stance foot = stance(words);
    if (foot == Stance::kNone) words.fail("over no foot", "give left, right or both");
    const double share = words.done() ? 1.0 : words.number("the foot's share", 0, 1);
    frame.over_left = foot == Stance::kLeft ? share : foot == Stance::kRight ? 1 - share : 0.5;
  }

  static Offset offset(Words& words) {
    constexpr const char* kMoves[] = {"x", "y", "z"};
    constexpr const char* kTurns[] = {"roll", "pitch", "yaw"};
    Offset offset;
    while (!words.done()) {
      bool known = false;
      for (std::size_t i = 0; i < 3; ++i) {
        if (words.take(kMoves[i])) {
          known = true;
          offset.move_m[i] = words.number("metres", -kMostMove_m, kMostMove_m);
        } else if (words.take(kTurns[i])) {
          known = true;
          offset.turn_rad[i] = kDegree * words.number("degrees", -kMostTurn_deg, kMostTurn_deg);
        }
      }
      if (!known && !words.take("stand")) {
        words.fail("'" + words.peek() + "' is no direction",
                   "give x, y, z with metres, or roll, pitch, yaw with degrees, or stand");
      }
    }
    return offset;
  }

  static void wait(Words& words, FrameText& frame) {
    Wait wait;
    const std::string name = words.word("a condition");
    for (int i = 1; i < kConditions; ++i) {
      if (name == kConditionNames[i]) wait.condition = static_cast<Condition>(i);
    }
    if (wait.condition == Condition::kNone) {
      std::string all;
      for (int i = 1; i < kConditions; ++i)
        all += (i > 1 ? ", " : "") + std::string(kConditionNames[i]);
      words.fail("'" + name + "' is no condition", "give one of: " + all);
    }
    wait.at_most_s = words.number("at most how long, s", 0, kMostTime_s);
    if (words.take("else")) wait.otherwise = target(words, "a frame, an action or stand");
    frame.wait = wait;
  }

  static void add_goal(Words& words, FrameText& frame) {
    const JointGoal added = goal(words);
    for (const JointGoal& other : frame.goals) {
      if (other.joint != added.joint) continue;
      words.fail("a second angle of joint '" + added.joint + "' in this frame", "give it one");
    }
    frame.goals.push_back(added);
  }

  static JointGoal goal(Words& words) {
    JointGoal goal;
    goal.line = words.line();
    words.take("joint");
    goal.joint = words.word("a joint");
    std::string value = words.word("the joint's angle, degrees, or stand");
    goal.from_stand = value.starts_with("stand");
    if (goal.from_stand) value = value.size() == 5 ? "0" : value.substr(5);
    const std::optional<double> angle_deg = Words::number_in(value);
    if (!angle_deg || std::abs(*angle_deg) > kMostTurn_deg) {
      words.fail("'" + value + "' is no angle of joint '" + goal.joint + "'",
                 "give degrees, stand, or stand+DEGREES");
    }
    goal.angle_rad = kDegree * *angle_deg;
    return goal;
  }

  Document document_;
};

}  // namespace

const char* name_of(Condition condition) {
  return kConditionNames[static_cast<int>(condition)];
}

Document parse_document(const std::filesystem::path& file, const std::string& text) {
  Reader reader(file);
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto control = std::find_if(line.begin(), line.end(), [](unsigned char letter) {
      return (letter < ' ' && letter != '\t' && letter != '\r') || letter == 0x7F;
    });
    if (control != line.end()) {
      throw model::LoadError(file.string(), number,
                             fmt::format("holds byte 0x{:02x}, which is in no text",
                                         static_cast<unsigned char>(*control)),
                             "give an action file");
    }
    reader.read(Words(file, number, line));
  }
  return reader.finish();
}

Document read_document(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMostBytes = 1 << 20;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  const std::optional<std::string> text = error ? std::nullopt : files::read(file);
  if (std::filesystem::is_directory(file, error)) {
    throw model::LoadError(file.string(), 0, "is a folder", "give an action file in it");
  }
  if (!text) {
    throw model::LoadError(file.string(), 0, "cannot be read", "give the path of an action file");
  }
  if (size > kMostBytes) {
    throw model::LoadError(file.string(), 0, "is larger than any action", "give an action file");
  }
  return parse_document(file, *text);
}

}  // namespace verp::action
