#include "host/author/action/kept.hpp"

#include <cstring>

namespace verp::action {

std::vector<std::uint8_t> kept_image(const CompiledActions& made, const Params& params) {
  LibraryHeader header;
  std::memcpy(static_cast<void*>(&header), made.words.data(), sizeof header);
  const KeptMark mark = make_mark(header, params);
  std::vector<std::uint8_t> image(header.size + sizeof mark);
  std::memcpy(image.data(), made.words.data(), header.size);
  std::memcpy(image.data() + header.size, &mark, sizeof mark);
  return image;
}

}  // namespace verp::action
