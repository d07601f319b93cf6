// A board's settings in flash, whatever its pages hold; then values are put and read.
#include "firmware/store/flash_store.hpp"

#include "hal/fake/fake_flash.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace verp::fuzz {
namespace {

using Flash = hal::FakeFlash<1024, 4>;

/// Programs a page header or a record, mostly with its right CRC, or raw slots.
void fill(Flash& flash, std::size_t page, Bytes& bytes) {
  std::string content(1024, '\xFF');
  std::size_t at = 0;
  const auto put = [&](const void* from, std::size_t size) {
    if (at + size <= content.size()) std::memcpy(content.data() + at, from, size);
    at = at + size;
  };
  const store::PageHeader header = store::page_header(bytes.byte());
  put(&header, sizeof header);
  for (int records = bytes.byte() % 32; records > 0 && at < content.size(); --records) {
    const std::uint8_t how = bytes.byte();
    store::RecordHeader record{.key = bytes.byte(), .size = bytes.byte()};
    const std::string_view value = bytes.take(record.size);
    record.crc32 = crc32(value.data(), value.size(), store::begin_crc(record));
    if (how > 240) record.crc32 = bytes.word();
    put(&record, sizeof record);
    put(value.data(), value.size());
    at = store::slots_bytes(at);
  }
  for (at = 0; at + Flash::kUnit <= content.size(); at += Flash::kUnit)
    flash.program(page, at, reinterpret_cast<const std::uint8_t*>(content.data()) + at);
  for (int flips = bytes.byte() % 4; flips > 0; --flips)
    flash.damage(page, bytes.word() % 1024, bytes.byte());
}

}  // namespace
}  // namespace verp::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  fuzz::Bytes bytes(data, size);
  fuzz::Flash flash;
  fuzz::fill(flash, 0, bytes);
  fuzz::fill(flash, 1, bytes);
  store::FlashStore<fuzz::Flash> settings(flash);
  settings.open();
  std::uint8_t value[256];
  for (std::uint16_t key = 0; key < 256; ++key) settings.get(key, value, sizeof value);
  while (bytes.left() > 0) {
    const std::uint16_t key = bytes.byte();
    const std::string_view wanted = bytes.take(bytes.byte());
    const auto* from = reinterpret_cast<const std::uint8_t*>(wanted.data());
    if (settings.put(key, from, wanted.size()) != hal::PutResult::kAccepted) continue;
    hal::WorkState done = hal::WorkState::kWorking;
    for (int i = 0; i < 1000 && done == hal::WorkState::kWorking; ++i) done = settings.work(true);
    const bool there = settings.get(key, value, sizeof value) == wanted.size() &&
                       std::memcmp(value, wanted.data(), wanted.size()) == 0;
    fuzz::require(there || done != hal::WorkState::kIdle, "a value that was kept is there");
  }
  fuzz::require(flash.misuses() == 0, "the store keeps to its pages");
  return 0;
}
