#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/model/params.hpp"
#include "firmware/app/bus_counters.hpp"
#include "firmware/app/request_master.hpp"
#include "hal/contract/frame_bus.hpp"

namespace verp::bus {

/// A serial protocol's requests and answers, for Client. One frame at a time: encode, then request.
class ClientWords {
 public:
  struct Reply {
    std::uint8_t id = 0;
    std::uint8_t error = 0;  ///< the request failed; 0: it did not
    std::span<const std::uint8_t> data;
  };
  using Take = std::function<app::Take(const Reply&)>;

  virtual ~ClientWords() = default;
  virtual std::size_t encode_ping(std::uint8_t id) = 0;
  virtual std::size_t encode_read(std::uint8_t id, std::uint16_t address, std::uint16_t length) = 0;
  virtual std::size_t encode_write(std::uint8_t id, std::uint16_t address,
                                   std::span<const std::uint8_t> data) = 0;
  /// Sends the encoded frame; passes each answer to `take` until kDone or time is over.
  virtual bool request(std::size_t frame, std::uint32_t timeout_us, const Take& take) = 0;
  /// Bytes of an answer without data.
  virtual std::size_t status_bytes() const = 0;
  virtual const app::BusCounters& counters() const = 0;
  virtual std::uint32_t damaged() const = 0;
  /// Bytes that belonged to no whole packet.
  virtual std::uint32_t noise_bytes() const = 0;
  /// Answers of `id` in these bytes and those before since `anew`.
  virtual int late_answers(std::uint8_t id, std::span<const std::uint8_t> bytes, bool anew) = 0;

  virtual BusProtocol protocol() const = 0;
};

std::unique_ptr<ClientWords> make_client_words(BusProtocol protocol, hal::FrameBus& bus);

}  // namespace verp::bus
