// The controller as a CANopen node: any frames, and whole transfers by the SDO client, whose frames
// are lost and changed on their way. Both ends keep their state machines and buffers.
#include "common/protocol/canopen/device.hpp"
#include "common/protocol/canopen/sdo_client.hpp"
#include "firmware/app/controller_objects.hpp"
#include "tests/fuzz/canopen.hpp"
#include "tests/unit/images/actions_board.hpp"

namespace verp::fuzz {
namespace {

using canopen::SdoClient;
constexpr std::uint8_t kNode = 100;

struct Pair {
  Pair(Bytes& from, app::Images& images)
      : bytes(from), registers(test::kRobot, {}, images), objects(registers, images) {
    device.start();
  }

  /// A frame on its way: mostly whole.
  bool passes(CanFrame& frame) {
    const std::uint8_t fate = noisy ? bytes.byte() : 0;
    if (fate >= 240) frame.data[bytes.byte() % 8] = bytes.byte();
    return fate < 224 || fate >= 240;
  }
  void answer() {
    CanFrame frame;
    for (int i = 0; i < 200 && device.next(frame, now_us); ++i) client.receive(frame, now_us);
    now_us += 1000;
  }
  void exchange(int rounds) {
    CanFrame frame;
    for (; rounds > 0 && client.state() == SdoClient::State::kBusy; --rounds, now_us += 1000) {
      for (int i = 0; i < 200 && client.next(frame, now_us); ++i) {
        if (passes(frame)) device.receive(frame, now_us);
      }
      for (int i = 0; i < 200 && device.next(frame, now_us); ++i) {
        if (passes(frame)) client.receive(frame, now_us);
      }
    }
  }
  void transfer() {
    const std::uint8_t how = bytes.byte();
    const auto mode = how % 2 == 0 ? SdoClient::Mode::kPlain : SdoClient::Mode::kBlock;
    noisy = how % 8 > 3;
    const canopen::Address at{bytes.word(), bytes.byte()};
    const std::uint32_t size = bytes.word() % sizeof buffer;
    if (how % 4 < 2) {
      client.upload(at, buffer, sizeof buffer, mode, now_us);
    } else {  // what was read last, or a part of it, changed
      const std::string_view over = bytes.take(bytes.byte());
      std::memcpy(buffer, over.data(), over.size());
      client.download(at, buffer, size == 0 ? client.size() : size, mode, now_us);
    }
    exchange(3000);
    client.cancel();
  }

  Bytes& bytes;
  app::OperatorRegisters registers;
  app::ControllerObjects objects;
  canopen::Device<app::ControllerObjects, app::kControllerSize> device{
      objects, app::controller_identity(), kNode};
  SdoClient client{kNode};
  std::uint8_t buffer[16384] = {};
  std::uint64_t now_us = 0;
  bool noisy = false;
};

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp::fuzz;
  Bytes bytes(data, size);
  static verp::app::test::FakeBoard& board = *new verp::app::test::FakeBoard;
  board.place.blocks_taken = 1000;
  Pair pair(bytes, board.images);
  while (bytes.left() > 0) {
    if (bytes.byte() % 4 == 0) {
      pair.transfer();
      continue;
    }
    pair.device.receive(frame_to(kNode, bytes), pair.now_us);
    pair.client.receive(frame_to(kNode, bytes), pair.now_us);
    pair.answer();
  }
  return 0;
}
