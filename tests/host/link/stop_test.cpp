#include <gtest/gtest.h>

#include <string>

#include "host/os/link/endpoint.hpp"
#include "host/os/link/link_error.hpp"
#include "host/os/link/stop_line.hpp"
#include "tests/support/gpio_pin.hpp"

namespace verp::link {
namespace {

constexpr const char* kWords = "gpio:/dev/gpiochip0,17";

bool after(StopLine& stop, int readings) {
  for (int i = 1; i < readings; ++i) stop.pressed();
  return stop.pressed();
}

TEST(StopButton, CountsAtTheSecondOpenReadingAndUntilItIsClosedForAQuarterOfASecond) {
  test::GpioPin pin;
  StopLine stop(parse_stop(kWords), pin);
  EXPECT_FALSE(stop.pressed());
  pin.grounded = false;
  EXPECT_FALSE(stop.pressed()) << "a spark";
  pin.grounded = true;
  EXPECT_FALSE(after(stop, 5));
  pin.grounded = false;
  EXPECT_TRUE(after(stop, 2));
  pin.grounded = true;
  EXPECT_TRUE(after(stop, 31));
  EXPECT_FALSE(stop.pressed());
}

TEST(StopButton, AChipThatIsGoneAndACutWireCountAsPressed) {
  test::GpioPin pin;
  StopLine stop(parse_stop(kWords), pin);
  pin.gone = true;
  EXPECT_TRUE(after(stop, 2));
  test::GpioPin cut;
  cut.grounded = false;
  EXPECT_TRUE(StopLine(parse_stop(kWords), cut).is_pressed()) << "from the first reading on";
}

TEST(StopButton, AsksForItsLineAsAnInputWithAPullUp) {
  test::GpioPin pin;
  const StopLine stop(parse_stop(kWords), pin);
  EXPECT_EQ(pin.asked.num_lines, 1u);
  EXPECT_EQ(pin.asked.offsets[0], 17u);
  EXPECT_EQ(pin.asked.config.flags,
            std::uint64_t{GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_BIAS_PULL_UP});
  EXPECT_EQ(stop.name(), kWords);
}

std::string refusal(test::GpioPin& pin) {
  try {
    const StopLine stop(parse_stop(kWords), pin);
  } catch (const LinkError& error) {
    return error.what();
  }
  return "was not refused";
}

TEST(StopButton, SaysWhyThereIsNoneAndWhatToDo) {
  test::GpioPin pin;
  pin.open_error = EACCES;
  EXPECT_NE(refusal(pin).find("usermod -aG gpio"), std::string::npos) << refusal(pin);
  pin.open_error = ENOENT;
  EXPECT_NE(refusal(pin).find("no such device; `gpiodetect`"), std::string::npos) << refusal(pin);
  pin.open_error = 0;
  pin.request_error = EBUSY;
  EXPECT_NE(refusal(pin).find("another program has it"), std::string::npos) << refusal(pin);
  pin.request_error = ENOTTY;
  EXPECT_NE(refusal(pin).find("no GPIO chip"), std::string::npos) << refusal(pin);
}

TEST(StopButton, WordsAreAChipAndALine) {
  EXPECT_EQ(parse_stop("gpio:/dev/gpiochip4,0").chip, "/dev/gpiochip4");
  for (const char* wrong : {"", "gpio:", "gpio:/dev/gpiochip0", "gpio:/dev/gpiochip0,", "gpio:,17",
                            "gpio:/dev/gpiochip0,17x", "gpio:/dev/gpiochip0,-1", "gpiochip0,17",
                            "gpio:gpiochip0,17", "gpio:/dev/gpiochip0,99999999999"}) {
    EXPECT_THROW(parse_stop(wrong), EndpointError) << wrong;
  }
}

}  // namespace
}  // namespace verp::link
