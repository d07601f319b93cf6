#include "firmware/app/block_window.hpp"

namespace verp::app {

std::size_t ParamsImages::size(ImageKind kind) const {
  return kind == ImageKind::kParams ? sizeof(ParamsImage) : 0;
}

void ParamsImages::read(ImageKind, std::size_t offset, std::uint8_t* to, std::size_t count) const {
  __builtin_memcpy(to, reinterpret_cast<const std::uint8_t*>(&in_force_) + offset, count);
}

void ParamsImages::begin(ImageKind) {
  accepted_ = false;
  __builtin_memset(reinterpret_cast<std::uint8_t*>(&staged_), 0xFF, sizeof staged_);
}

Taken ParamsImages::write(ImageKind, std::size_t offset, const std::uint8_t* from,
                          std::size_t count) {
  accepted_ = false;
  __builtin_memcpy(reinterpret_cast<std::uint8_t*>(&staged_) + offset, from, count);
  return Taken::kYes;
}

std::uint8_t ParamsImages::commit(ImageKind, std::uint32_t crc) {
  if (crc32(&staged_, sizeof staged_) != crc) return kWrongWindowCrc;
  const ImageFault fault = check_image(&staged_, sizeof staged_);
  accepted_ = fault == ImageFault::kNone;
  return static_cast<std::uint8_t>(fault);
}

}  // namespace verp::app
