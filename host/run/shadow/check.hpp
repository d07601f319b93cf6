#pragma once
#include <cstdint>
#include <string>

#include "common/action/library.hpp"
#include "common/control/state.hpp"
#include "common/model/params.hpp"
#include "host/run/shadow/comparison.hpp"

namespace verp::shadow {

/// A controller once more, beside one that runs: how far the two were compared, and what came of
/// it, however the other one's ticks reach this PC.
class Check {
 public:
  enum class State {
    kAsking,     ///< for the State to begin with
    kFollowing,  ///< steps on with what the controller had
    kReading,    ///< what differs
    kDiffers,    ///< the end: divergence() says where
    kRefused,    ///< the end: refusal() says why
  };

  Check(const Check&) = delete;
  Check& operator=(const Check&) = delete;

  State state() const { return state_; }
  bool over() const { return state_ == State::kDiffers || state_ == State::kRefused; }
  bool differs() const { return state_ == State::kDiffers; }
  /// A digest was another one, and what the controller had is being read.
  bool suspects() const { return state_ == State::kReading; }
  /// Ticks whose digest was this PC's.
  std::uint64_t compared() const { return compared_; }
  /// Digests that were others, and that the controller's ticks came too late to look into.
  std::uint64_t unsettled() const { return unsettled_; }
  /// How often ticks did not come whole, and the State was asked for anew.
  std::uint64_t gaps() const { return gaps_; }
  /// Controllers that began anew.
  std::uint64_t boots() const { return boots_; }
  /// The last tick compared.
  std::uint32_t tick() const { return shadow_.admit.tick; }
  std::uint64_t digest() const { return shadow_.digest.chain; }
  /// When the last tick was heard, or an answer came; 0: never.
  std::uint64_t heard_us() const { return heard_us_; }
  const record::Divergence& divergence() const { return divergence_; }
  const std::string& refusal() const { return refusal_; }
  /// Why the last gap was one, in words.
  const std::string& gap() const { return gap_; }

 protected:
  /// `own`: this robot's actions, as this PC has them.
  Check(const Params& params, const action::Library& own) : params_(params), own_(own) {}
  ~Check() = default;

  /// The controller has so many actions. It plays one by itself when it falls, so they must be
  /// these.
  bool take_actions(int count);
  /// Goes on by a tick with these Inputs; false, and nothing happened: its digest is another one.
  bool step_on(const Inputs& inputs, std::uint64_t digest);
  /// On what the controller had by its testimony. `misheard`: why the State is asked for anew if
  /// this PC only took something else for that.
  void conclude(const Suspicion& suspicion, const char* misheard);
  /// Asks for the State anew.
  virtual void lose(const std::string& why);
  void refuse(const std::string& why);

  const Params& params_;
  const action::Library own_;
  action::Library actions_;  ///< that the controller has
  State state_ = State::kAsking;
  verp::State shadow_;
  Testimony testimony_;
  std::uint64_t boots_ = 0, heard_us_ = 0, compared_ = 0, unsettled_ = 0;

 private:
  static constexpr int kMostMisheard = 3;  ///< with fewer than kClean good ticks between them
  static constexpr int kClean = 1000;

  record::Divergence divergence_;
  std::string refusal_, gap_;
  std::uint64_t gaps_ = 0;
  int misheard_ = 0;
  int clean_ = 0;  ///< ticks compared since the last gap
};

}  // namespace verp::shadow
