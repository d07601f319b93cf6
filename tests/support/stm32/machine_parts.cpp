#include <memory>
#include <string>
#include <utility>

#include "tests/support/stm32/adc_model.hpp"
#include "tests/support/stm32/can_model.hpp"
#include "tests/support/stm32/core_model.hpp"
#include "tests/support/stm32/dma_model.hpp"
#include "tests/support/stm32/flash_model.hpp"
#include "tests/support/stm32/gpio_model.hpp"
#include "tests/support/stm32/iwdg_model.hpp"
#include "tests/support/stm32/machine.hpp"
#include "tests/support/stm32/otg_fs_model.hpp"
#include "tests/support/stm32/rcc_model.hpp"
#include "tests/support/stm32/registers/syscfg_table.hpp"
#include "tests/support/stm32/spi_model.hpp"
#include "tests/support/stm32/timer_model.hpp"
#include "tests/support/stm32/usart_model.hpp"

namespace verp::hal::stm32::model {
namespace {

Gate apb1(std::uint32_t mask) {
  return {rcc::kApb1enr, mask, mask};
}
Gate apb2(std::uint32_t mask) {
  return {rcc::kApb2enr, mask, mask};
}
Gate ahb1(std::uint32_t mask) {
  return {rcc::kAhb1enr, mask, mask};
}

template <class Map>
auto& part(Map& parts, typename Map::key_type key, const char* what) {
  const auto found = parts.find(key);
  if (found == parts.end()) broken(std::string("the model has no such ") + what);
  return *found->second;
}

}  // namespace

template <class Model, class... Arguments>
Model& Machine::add(Arguments&&... arguments) {
  auto model = std::make_unique<Model>(*this, std::forward<Arguments>(arguments)...);
  Model& added = *model;
  banks_.push_back(std::move(model));
  return added;
}

Machine::Machine(Family family, Options options) : family_(family), options_(options) {
  rcc_ = &add<RccModel>();
  flash_ = &add<FlashModel>();
  pwr_ = &add<PwrModel>();
  core_ = std::make_unique<CoreModel>(*this);
  add_serial();
  add_others();
  rcc_->flag_reset(ResetCause::kPowerOn);
}

Machine::~Machine() = default;

CanModel& Machine::can1() {
  if (can1_ == nullptr) {
    can1_ = &add<CanModel>(base::kCan1, apb1(rcc::kApb1Can1), irq::kCan1Tx);
  }
  return *can1_;
}
CanModel& Machine::can2() {
  if (can2_ == nullptr) {
    can2_ = &add<CanModel>(base::kCan2, apb1(rcc::kApb1Can2), irq::kCan2Tx, &can1());
  }
  return *can2_;
}

void Machine::add_serial() {
  const auto usart = [this](unsigned number, std::uint32_t address, Gate gate, unsigned line) {
    usart_[number] = &add<UsartModel>(number, address, gate, line);
  };
  usart(1, base::kUsart1, apb2(rcc::kApb2Usart1), irq::kUsart1);
  usart(2, base::kUsart2, apb1(rcc::kApb1Usart2), irq::kUsart2);
  usart(3, base::kUsart3, apb1(rcc::kApb1Usart3), irq::kUsart3);
  usart(4, base::kUart4, apb1(rcc::kApb1Uart4), irq::kUart4);
  usart(5, base::kUart5, apb1(rcc::kApb1Uart5), irq::kUart5);
  usart(6, base::kUsart6, apb2(rcc::kApb2Usart6), irq::kUsart6);
  if (family_ == Family::kF746) {
    usart(7, base::kUart7F746, apb1(rcc::kApb1Uart7), irq::kUart7F746);
    usart(8, base::kUart8F746, apb1(rcc::kApb1Uart8), irq::kUart8F746);
  }
  spi_[1] = &add<SpiModel>(1u, base::kSpi1, apb2(rcc::kApb2Spi1), irq::kSpi1);
  spi_[2] = &add<SpiModel>(2u, base::kSpi2, apb1(rcc::kApb1Spi2), irq::kSpi2);
  spi_[3] = &add<SpiModel>(3u, base::kSpi3, apb1(rcc::kApb1Spi3), irq::kSpi3);
}

void Machine::add_others() {
  for (char port = 'A'; port <= limits(family_).last_port; ++port) {
    gpio_[port] = &add<GpioModel>(port);
  }
  dma_[1] = &add<DmaModel>(1u, base::kDma1, ahb1(rcc::kAhb1Dma1));
  dma_[2] = &add<DmaModel>(2u, base::kDma2, ahb1(rcc::kAhb1Dma2));
  tim_[2] = &add<TimerModel>(2u, base::kTim2, apb1(rcc::kApb1Tim2), irq::kTim2);
  tim_[3] = &add<TimerModel>(3u, base::kTim3, apb1(rcc::kApb1Tim3), irq::kTim3);
  tim_[4] = &add<TimerModel>(4u, base::kTim4, apb1(rcc::kApb1Tim4), irq::kTim4);
  tim_[5] = &add<TimerModel>(5u, base::kTim5, apb1(rcc::kApb1Tim5), irq::kTim5);
  iwdg_ = &add<IwdgModel>();
  otg_fs_ = &add<OtgFsModel>();
  adc_[1] = &add<AdcModel>(1u, base::kAdc1, Gate{rcc::kApb2enr, rcc::kApb2Adc1, rcc::kApb2Adc1});
  adc_[2] = &add<AdcModel>(2u, base::kAdc2, Gate{rcc::kApb2enr, rcc::kApb2Adc2, rcc::kApb2Adc1});
  adc_[3] = &add<AdcModel>(3u, base::kAdc3, Gate{rcc::kApb2enr, rcc::kApb2Adc3, rcc::kApb2Adc1});
  add<AdcCommonModel>();
  banks_.push_back(std::make_unique<Bank>(*this, "SYSCFG", base::kSyscfg, syscfg::table(family_),
                                          apb2(rcc::kApb2Syscfg)));
}

AdcModel& Machine::adc(unsigned number) {
  return part(adc_, number, "ADC");
}
DmaModel& Machine::dma(unsigned number) {
  return part(dma_, number, "DMA");
}
GpioModel& Machine::gpio(char port) {
  return part(gpio_, port, "GPIO port");
}
SpiModel& Machine::spi(unsigned number) {
  return part(spi_, number, "SPI");
}
TimerModel& Machine::tim(unsigned number) {
  return part(tim_, number, "timer");
}
UsartModel& Machine::usart(unsigned number) {
  return part(usart_, number, "USART");
}

}  // namespace verp::hal::stm32::model
