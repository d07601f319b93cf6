#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/block_window.hpp"
#include "host/os/link/link.hpp"
#include "host/run/shadow/check.hpp"

namespace verp::shadow {

/// Operator port (Dynamixel device 200): registers, and images through the block window, several
/// requests per exchange. Unanswered requests are repeated.
class TickPort {
 public:
  enum class Answer {
    kGood,
    kSilent,   ///< after all attempts
    kRefused,  ///< see error()
  };

  /// Throws LinkError.
  explicit TickPort(const link::Endpoint& endpoint) : link_(endpoint) {}

  Answer read(std::uint16_t address, void* to, std::uint16_t size);
  Answer write(std::uint16_t address, std::uint8_t value);
  Answer read_image(app::ImageKind kind, std::size_t offset, void* to, std::size_t size);

  dxl::Error error() const { return error_; }
  bool connected() const { return link_.connected(); }

 private:
  struct Request {
    std::uint8_t* to = nullptr;
    std::size_t size = 0;
  };
  static constexpr std::uint8_t kId = dxl::controller::kDefaultId;

  void add_read(std::uint16_t address, std::uint8_t* to, std::size_t size);
  void add_write(std::uint8_t id, std::uint16_t address, const void* data, std::size_t size);
  Answer exchange();
  bool collect(bool& refused);
  void drain();

  link::Link link_;
  dxl::Error error_ = dxl::Error::kNone;
  std::vector<std::uint8_t> outbox_;
  std::vector<Request> asked_;
  app::ImageKind window_ = app::ImageKind::kNone;  ///< kNone: unknown
};

/// Shadow of a controller at a serial link. This PC fetches its last ticks
/// (firmware/app/tick_log.hpp) at its own pace; the controller never waits. Dropped ticks are a
/// gap: its State is read again.
class PolledCheck final : public Check {
 public:
  /// The caller keeps both arguments alive.
  PolledCheck(const Params& params, TickPort& port, const action::Library& own = {})
      : Check(params, own), port_(port) {}

  /// False: nothing new, or no answer.
  bool turn(std::uint64_t now_us);

 private:
  static constexpr std::size_t kTicks = app::TickLog::kTicks;

  bool good(TickPort::Answer answer);
  bool begin();
  bool hold(app::TickLog::Hold what);
  bool read_state();
  bool read_ticks();
  bool follow();
  bool compare(const TickRecord& record);
  bool settle(const TickRecord& record);

  TickPort& port_;
  std::uint32_t next_ = 0;  ///< the next tick to fetch
  std::uint64_t now_us_ = 0;
};

}  // namespace verp::shadow
