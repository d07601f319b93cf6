#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/action/library.hpp"
#include "common/control/state.hpp"
#include "common/model/params.hpp"
#include "firmware/app/tick_log.hpp"
#include "host/trace/record/replay.hpp"

namespace verp::shadow {

/// This PC's State before the differing tick, and its assumed Inputs.
struct Suspicion {
  State before;
  Inputs inputs;
  std::uint64_t digest = 0;  ///< the controller's
};

/// The last tick that the controller holds, and those before it.
struct Testimony {
  app::HeldTick held;
  std::vector<TickRecord> ticks;  ///< oldest first
};

/// Ticks of an ImageKind::kTicks image up to the held one.
std::vector<TickRecord> ticks_of(const std::uint8_t* image, std::size_t size,
                                 const app::HeldTick& held);

enum class Verdict {
  kDifference,  ///< other results; the divergence names tick, stage and field
  kMisheard,    ///< equal results for the controller's Inputs
  kTooLate,     ///< dropped by the controller
};

struct Judgement {
  Verdict verdict = Verdict::kMisheard;
  record::Divergence divergence;  ///< for kMisheard: stage "inputs"
};

/// Left is the controller, right this PC.
Judgement judge(const Params& params, const action::Library& actions, const Suspicion& suspicion,
                const Testimony& testimony);

/// A shadow steps a second copy of a running controller here and compares digests. Subclasses get
/// the ticks.
class Check {
 public:
  enum class State {
    kAsking,     ///< for the initial State
    kFollowing,  ///< steps with the controller's Inputs
    kReading,    ///< reads records after a differing digest
    kDiffers,    ///< final: see divergence()
    kRefused,    ///< final: see refusal()
  };

  Check(const Check&) = delete;
  Check& operator=(const Check&) = delete;

  State state() const { return state_; }
  bool over() const { return state_ == State::kDiffers || state_ == State::kRefused; }
  bool differs() const { return state_ == State::kDiffers; }
  bool suspects() const { return state_ == State::kReading; }
  std::uint64_t compared() const { return compared_; }
  /// Differing digests whose records came too late.
  std::uint64_t unsettled() const { return unsettled_; }
  /// Times that ticks were incomplete and the State was requested again.
  std::uint64_t gaps() const { return gaps_; }
  std::uint64_t boots() const { return boots_; }
  std::uint32_t tick() const { return shadow_.admit.tick; }
  std::uint64_t digest() const { return shadow_.digest.chain; }
  /// Time of the last tick or answer; 0: never.
  std::uint64_t heard_us() const { return heard_us_; }
  const record::Divergence& divergence() const { return divergence_; }
  const std::string& refusal() const { return refusal_; }
  const std::string& gap() const { return gap_; }

 protected:
  Check(const Params& params, const action::Library& own) : params_(params), own_(own) {}
  ~Check() = default;

  /// Both must have the same actions: the controller plays one by itself after a fall.
  bool take_actions(int count);
  /// False, without change, if the digest differs.
  bool step_on(const Inputs& inputs, std::uint64_t digest);
  /// `misheard`: why the State is requested again if only this PC's Inputs were wrong.
  void conclude(const Suspicion& suspicion, const char* misheard);
  virtual void lose(const std::string& why);
  void refuse(const std::string& why);

  const Params& params_;
  const action::Library own_;
  action::Library actions_;  ///< the controller's
  State state_ = State::kAsking;
  verp::State shadow_;
  Testimony testimony_;
  std::uint64_t boots_ = 0, heard_us_ = 0, compared_ = 0, unsettled_ = 0;

 private:
  static constexpr int kMostMisheard = 3;  ///< with fewer than kClean good ticks between
  static constexpr int kClean = 1000;

  record::Divergence divergence_;
  std::string refusal_, gap_;
  std::uint64_t gaps_ = 0;
  int misheard_ = 0;
  int clean_ = 0;  ///< since the last gap
};

}  // namespace verp::shadow
