#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hal/chip/stm32/io.hpp"
#include "hal/chip/stm32/registers/memory_map.hpp"
#include "tests/support/stm32/bank.hpp"
#include "tests/support/stm32/time.hpp"

/// A whole STM32, built from its reference manual. Time passes with each access
/// (Options::access_cycles) or by advance().
namespace verp::hal::stm32::model {

class Machine;
class AdcModel;
class CanModel;
class CoreModel;
class DmaModel;
class FlashModel;
class GpioModel;
class IwdgModel;
class OtgFsModel;
class PwrModel;
class RccModel;
class SpiModel;
class TimerModel;
class UsartModel;

class ModelIo {
 public:
  explicit ModelIo(Machine& machine) : machine_(&machine) {}
  std::uint8_t read8(std::uint32_t address);
  std::uint16_t read16(std::uint32_t address);
  std::uint32_t read32(std::uint32_t address);
  void write8(std::uint32_t address, std::uint8_t value);
  void write16(std::uint32_t address, std::uint16_t value);
  void write32(std::uint32_t address, std::uint32_t value);
  std::uint32_t bus_address(const void* data, std::size_t size);
  void barrier();
  bool mask_interrupts();
  void unmask_interrupts();
  void wait_for_interrupt();

 private:
  Machine* machine_;
};

static_assert(Io<ModelIo>);

enum class ResetCause { kPowerOn, kPin, kSoftware, kIwdg, kWwdg, kLowPower, kBrownOut };

struct Options {
  std::uint32_t hse_hz = 8000000;
  std::uint32_t access_cycles = 10;  ///< per access and the code around it
};

class Machine {
 public:
  explicit Machine(Family family, Options options = {});
  ~Machine();
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  Family family() const { return family_; }
  const Options& options() const { return options_; }
  ModelIo io() { return ModelIo(*this); }

  Time now() const { return now_; }
  /// As if the core slept; interrupts run.
  void advance(Time time) { advance_to(now_ + time); }
  void at(Time when, std::function<void()> what);
  std::uint64_t core_cycles() const;

  /// In order: "USART2: write of 0x... to BRR while UE is set".
  const std::vector<std::string>& violations() const { return violations_; }
  std::string violations_text() const;
  void forget_violations() { violations_.clear(); }

  /// Runs while the line is up, the NVIC enables it and no other handler runs.
  void attach(unsigned irq, std::function<void()> handler);

  void reset(ResetCause cause);
  std::uint32_t resets() const { return resets_; }
  /// Called after each reset but the first; it may throw to end the running code.
  void on_reset(std::function<void(ResetCause)> handler) { reset_handler_ = std::move(handler); }
  /// Without power, accesses do nothing and read 0.
  bool dark() const { return dark_; }
  void power_off();
  void power_on();

  AdcModel& adc(unsigned number);
  /// The first call creates it and must precede the firmware's use: chips have no memory to spare
  /// for unused ones.
  CanModel& can1();
  CanModel& can2();
  CoreModel& core() { return *core_; }
  DmaModel& dma(unsigned number);
  FlashModel& flash() { return *flash_; }
  GpioModel& gpio(char port);
  IwdgModel& iwdg() { return *iwdg_; }
  OtgFsModel& otg_fs() { return *otg_fs_; }
  PwrModel& pwr() { return *pwr_; }
  RccModel& rcc() { return *rcc_; }
  SpiModel& spi(unsigned number);
  TimerModel& tim(unsigned number);
  UsartModel& usart(unsigned number);

  std::uint32_t bus_read(std::uint32_t address, unsigned width);
  void bus_write(std::uint32_t address, std::uint32_t value, unsigned width);
  void access_begins();
  void settle();
  void touch() { dirty_ = true; }
  void violate(const std::string& what);
  bool clocked(const Bank& bank, const std::string& what);
  /// All banks count up to here at the old clocks.
  void clocks_change();
  std::uint32_t map(const void* data, std::size_t size);
  std::uint8_t* memory(std::uint32_t address, unsigned width);
  bool mask_interrupts();
  void unmask_interrupts();
  void wait_for_interrupt();
  void barrier();
  void reset_banks(std::uint32_t reset_offset, std::uint32_t bits);
  const std::vector<std::unique_ptr<Bank>>& banks() const { return banks_; }

 private:
  struct Region {
    std::uint32_t address;
    std::uint8_t* data;
    std::size_t size;
  };
  template <class Model, class... Arguments>
  Model& add(Arguments&&... arguments);
  void add_serial();
  void add_others();
  Bank* bank_at(std::uint32_t address);
  void advance_to(Time when);
  Time next_event() const;
  void run_due();
  bool serve_dma();
  void dispatch_interrupts();
  bool deliver(unsigned irq);

  Family family_;
  Options options_;
  Time now_ = 0;
  Time next_ = 0;
  bool dirty_ = true;
  bool settling_ = false;
  bool dark_ = false;
  bool masked_ = false;
  bool in_handler_ = false;
  std::uint32_t resets_ = 0;
  Time cycles_from_ = 0;
  std::uint64_t cycles_before_ = 0;
  Bank* last_bank_ = nullptr;
  std::multimap<Time, std::function<void()>> script_;
  std::map<unsigned, std::function<void()>> handlers_;
  std::function<void(ResetCause)> reset_handler_;
  std::vector<std::string> violations_;
  std::vector<Region> regions_;
  std::uint32_t next_region_ = 0x20000000;
  std::vector<std::unique_ptr<Bank>> banks_;
  std::unique_ptr<CoreModel> core_;
  CanModel* can1_ = nullptr;
  CanModel* can2_ = nullptr;
  FlashModel* flash_ = nullptr;
  IwdgModel* iwdg_ = nullptr;
  OtgFsModel* otg_fs_ = nullptr;
  PwrModel* pwr_ = nullptr;
  RccModel* rcc_ = nullptr;
  std::map<char, GpioModel*> gpio_;
  std::map<unsigned, AdcModel*> adc_;
  std::map<unsigned, DmaModel*> dma_;
  std::map<unsigned, SpiModel*> spi_;
  std::map<unsigned, TimerModel*> tim_;
  std::map<unsigned, UsartModel*> usart_;
};

}  // namespace verp::hal::stm32::model
