#pragma once
#include <cstdint>

#include "hal/chip/stm32/registers/dma.hpp"
#include "tests/support/stm32/bank.hpp"

/// A transfer happens as soon as its peripheral requests it, if the stream's channel is wired to it
/// (dma_requests.hpp). FIFO, bursts and double buffers are not modelled.
namespace verp::hal::stm32::model {

class DmaModel : public Bank {
 public:
  DmaModel(Machine& machine, unsigned number, std::uint32_t base, Gate gate);

  struct Script {
    bool enable_stuck = false;       ///< EN stays 1 once set
    Time disable_time = us(1);       ///< from EN written 0 to EN read 0
    std::uint32_t fail_after = ~0u;  ///< TEIF after so many transfers
  };
  Script script[dma::kStreams];

  std::uint32_t transfers(unsigned stream) const { return streams_[stream].transfers; }
  bool serve();

  void reset() override;
  void run() override;
  Time next() const override;
  bool interrupt(unsigned irq) const override;

 protected:
  bool may_write(std::uint32_t offset, std::uint32_t raw) override;
  void on_write(std::uint32_t offset, std::uint32_t raw, std::uint32_t old) override;

 private:
  struct Stream {
    std::uint32_t loaded = 0;  ///< NDTR at the start
    Time off_at = kNever;
    bool ending = false;  ///< EN was written 0
    std::uint32_t transfers = 0;
  };
  static std::uint32_t at(std::uint32_t offset, unsigned stream) {
    return offset + stream * dma::kStreamStep;
  }
  bool active(unsigned stream) const {
    return has(at(dma::kCr, stream), dma::kCrEn) && !streams_[stream].ending;
  }
  void control_written(unsigned stream, std::uint32_t old);
  void start(unsigned stream);
  bool serve(unsigned stream);
  void transfer(unsigned stream);
  void count_down(unsigned stream);
  void flag(unsigned stream, std::uint32_t flags);
  void stop(unsigned stream);

  unsigned number_;
  Stream streams_[dma::kStreams];
};

}  // namespace verp::hal::stm32::model
