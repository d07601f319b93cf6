// Dynamixel Protocol 2.0 as bytes: the parser and all that reads its packets.
#include "common/protocol/device_end.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace verp::fuzz {
namespace {

std::size_t sum = 0;  // reads every byte that a packet shows

void look(const std::uint8_t* data, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) sum += data[i];
}

void read(const dxl::Packet& packet) {
  look(packet.parameters, packet.size);
  dxl::ReadEntry wanted;
  for (std::size_t i = 0; dxl::read_entry(packet, i, wanted); ++i) sum += wanted.length;
  dxl::WriteEntry given;
  for (std::size_t at = 0; dxl::write_entry(packet, at, given);) look(given.data, given.size);
  dxl::FastBlock block;
  for (const std::size_t length : {std::size_t{0}, std::size_t{4}, std::size_t{130}}) {
    for (std::size_t i = 0; i < 64 && dxl::fast_block(packet, i, length, block); ++i)
      look(block.data, length);
  }
}

/// What the encoder writes, the parser reads.
void there_and_back(std::string_view parameters) {
  std::uint8_t buffer[dxl::kMaxPacket];
  dxl::Encoder encoder(buffer, sizeof buffer);
  encoder.begin(7, dxl::Instruction::kWrite);
  encoder.bytes(reinterpret_cast<const std::uint8_t*>(parameters.data()), parameters.size());
  const std::size_t size = encoder.finish();
  dxl::Parser parser;
  for (std::size_t i = 0; i < size; ++i) {
    require(parser.push(buffer[i]) == (i + 1 == size), "a packet ends with its last byte");
  }
  const dxl::Packet& packet = parser.packet();
  require(size == 0 || (packet.size == parameters.size() &&
                        std::memcmp(packet.parameters, parameters.data(), packet.size) == 0),
          "a packet carries its parameters");
}

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp::fuzz;
  Bytes bytes(data, size);
  const std::string stream = packets(bytes, 4096);
  verp::dxl::Parser parser;
  for (const char each : stream) {
    for (bool found = parser.push(static_cast<std::uint8_t>(each)); found; found = parser.next())
      read(parser.packet());
  }
  require(parser.noise_bytes() <= stream.size(), "noise is at most what came");
  require(parser.steps() <= 600 * stream.size(), "the parser's work is bounded");
  there_and_back(stream.substr(0, 400));
  return 0;
}
