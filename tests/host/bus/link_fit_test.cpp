#include "host/twin/bus/link_fit.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <random>

#include "firmware/app/schedule.hpp"
#include "host/twin/bus/assumed_imu.hpp"
#include "tests/host/bus/fake_plant.hpp"
#include "tests/unit/support/test_robot.hpp"

namespace verp::bus {
namespace {

namespace fs = std::filesystem;

LinkDelay held(double time_us) {
  return {
      .asked = 80, .answered = 80, .median_us = time_us, .p90_us = time_us, .worst_us = time_us};
}

struct Sys {
  explicit Sys(int time_ms) {
    const fs::path adapter = root / "bus/usb-serial/devices/ttyUSB7";
    fs::create_directories(adapter);
    std::ofstream(adapter / "latency_timer") << time_ms << '\n';
  }
  ~Sys() { fs::remove_all(root); }
  std::string folder() const { return root.string(); }
  const fs::path root = fs::temp_directory_path() / ("verp-fit-" + std::to_string(::getpid()));
};

const link::Endpoint kAdapter{link::Endpoint::Kind::kSerial, "/dev/ttyUSB7", 2'000'000, 0};
const link::Endpoint kSocket{link::Endpoint::Kind::kUnix, "/tmp/twin", 0, 0};

TEST(LinkFit, GivingUpTheSearchForAServoIsNoFaultOfTheRobot) {
  const std::string place =
      (fs::temp_directory_path() / ("verp-fit-bus-" + std::to_string(::getpid()))).string();
  link::Link silent(link::parse_endpoint("unix-listen:" + place));
  const link::Endpoint endpoint = link::parse_endpoint("unix:" + place);
  link::Link link(endpoint);
  ASSERT_TRUE(silent.wait_connected(1'000'000));
  Client client(link, endpoint, 1000);
  const Params params = verp::test::bus_params(6, true);
  for (int most = 0; most <= params.joint_count; ++most) {
    int asked = 0;
    const LinkDelay delay = measure_delay(client, params, [&] { return asked++ >= most; });
    EXPECT_EQ(delay.asked, 0) << most;
    EXPECT_EQ(delay.answered, 0);
  }
  EXPECT_THROW(measure_delay(client, params, [] { return false; }), DeviceError);
}

// Any size, rate and period; both reads time out.
TEST(LinkFit, WhatFitsEndsWithinThePeriod) {
  std::minstd_rand random(3);
  int fitting = 0;
  for (int i = 0; i < 2000; ++i) {
    Params params = verp::test::bus_params(1 + static_cast<int>(random() % 30), random() % 2 == 0);
    params.baud = 1'000'000u << random() % 3;
    params.period_us = static_cast<std::uint32_t>(4000 + random() % 16001);
    const double delay_us = static_cast<double>(random() % 12000);
    const LinkFit each = fit(params, held(delay_us));
    const double all_held_us = each.wire_us + 2.0 * each.held_us();
    EXPECT_GE(each.wire_us, app::schedule_us(params));
    if (each.fits()) {
      ++fitting;
      EXPECT_LE(all_held_us, params.period_us);
      EXPECT_GE(each.held_us() + 1, delay_us) << "what is usual is waited for";
    } else {
      EXPECT_GT(each.wire_us + 2 * delay_us, LinkFit::kUsable * params.period_us);
    }
  }
  EXPECT_GT(fitting, 200);
  EXPECT_LT(fitting, 1800);
}

// Latency timer 1 ms.
TEST(LinkFit, OneMillisecondEachWayFitsTwentyOneServosAt100Hz) {
  Params params = verp::test::bus_params(21, true);
  params.baud = 2'000'000;
  params.period_us = 10'000;
  EXPECT_TRUE(fit(params, held(2000)).fits());
  EXPECT_FALSE(fit(params, held(5000)).fits()) << "nor could two reads of 5 ms";
}

TEST(LinkFit, WithoutAnAnswerNothingFits) {
  const LinkFit silent = fit(verp::test::bus_params(3), {.asked = 80});
  EXPECT_LT(silent.needed_us(), LinkFit::kUsable * silent.period_us) << "zeros would";
  EXPECT_FALSE(silent.fits());
  EXPECT_FALSE(silent.fits_well());
}

TEST(LinkFit, ThePeriodOfferedFitsAndAShorterOneDoesNot) {
  for (double delay_us = 0; delay_us < 12000; delay_us += 100) {
    Params params = verp::test::bus_params(21);
    const int offered_ms = fit(params, held(delay_us)).shortest_period_ms();
    if (offered_ms == 0) {
      params.period_us = 20'000;
      EXPECT_FALSE(fit(params, held(delay_us)).fits_well()) << delay_us;
      continue;
    }
    EXPECT_GE(offered_ms, 4);
    EXPECT_LE(offered_ms, 20);
    params.period_us = 1000u * static_cast<unsigned>(offered_ms);
    EXPECT_TRUE(fit(params, held(delay_us)).fits_well()) << delay_us;
    params.period_us -= 1000;
    EXPECT_TRUE(offered_ms == 4 || !fit(params, held(delay_us)).fits_well()) << delay_us;
  }
}

TEST(LinkFit, TheRemedyNamesTheAdaptersTimerThePeriodAndTheRate) {
  const Sys sys(16);
  Params params = verp::test::bus_params(21);
  const LinkFit slow = fit(params, held(5000));
  EXPECT_FALSE(slow.fits());
  const std::string all = remedy(slow, params, kAdapter, sys.folder());
  EXPECT_NE(all.find(sys.folder() + "/bus/usb-serial/devices/ttyUSB7/latency_timer"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find("--period 1"), std::string::npos) << all;
  EXPECT_EQ(all.find("baud"), std::string::npos) << "of no use here: " << all;
  EXPECT_EQ(remedy(slow, params, kSocket, sys.folder()).find("tee"), std::string::npos);
  params.period_us = 5000;
  params.baud = 1'000'000;
  const LinkFit crowded = fit(params, held(100));
  EXPECT_NE(remedy(crowded, params, kSocket, sys.folder()).find("to 2000000 baud"),
            std::string::npos);
  const LinkFit hopeless = fit(params, held(40'000));
  EXPECT_NE(remedy(hopeless, params, kSocket, sys.folder()).find("adapter"), std::string::npos);
}

// In real time; only adapters known to be slow.
TEST(LinkFit, ASlowAdapterIsTurnedAwayByTheTwin) {
  const Params params = verp::test::bus_params(21);
  {
    const Sys sys(16);
    const std::string line = adapter_too_slow(params, kAdapter, sys.folder());
    EXPECT_NE(line.find("16 ms"), std::string::npos) << line;
    EXPECT_NE(line.find("latency_timer"), std::string::npos) << line;
    EXPECT_EQ(adapter_too_slow(params, kSocket, sys.folder()), "");
  }
  const Sys sys(1);
  EXPECT_EQ(adapter_too_slow(params, kAdapter, sys.folder()), "");
  EXPECT_EQ(adapter_too_slow(params, kAdapter, "/nowhere"), "") << "no such adapter";
}

TEST(AssumedImu, SaysUprightInTheMountingOfTheModel) {
  std::minstd_rand random(5);
  std::uniform_real_distribution<float> angle(-3.0F, 3.0F);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3f turned(
        Eigen::AngleAxisf(angle(random), Eigen::Vector3f(angle(random), 1, 0.5F).normalized()));
    ImuParams imu;
    for (int k = 0; k < 9; ++k) imu.body_imu[k] = turned(k / 3, k % 3);
    imu.accel_m_s2_per_count = 0.0012F;
    AssumedImu chip(imu);
    hal::ImuSample sample;
    ASSERT_EQ(chip.read(sample), hal::ImuStatus::kAssumed);
    const Eigen::Vector3f up =
        turned *
        Eigen::Vector3f(sample.accel_count[0], sample.accel_count[1], sample.accel_count[2]) *
        imu.accel_m_s2_per_count;
    EXPECT_NEAR((up - Eigen::Vector3f(0, 0, 9.80665F)).norm(), 0, 0.002);
    EXPECT_EQ(sample.gyro_count[0], 0);
    const std::uint64_t before_us = sample.time_us;
    ASSERT_EQ(chip.read(sample), hal::ImuStatus::kAssumed);
    EXPECT_GT(sample.time_us, before_us);
    EXPECT_EQ(sample.gyro_count[2], 0);
  }
}

}  // namespace
}  // namespace verp::bus
