// Meshes and height maps that the twin touches. Their readers tell the caller, which knows the
// place, by std::runtime_error.
#include "host/robot/model/mesh_file.hpp"

#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  std::string text(reinterpret_cast<const char*>(data), size);
  const bool obj = text.starts_with("v ") || text.starts_with('#');
  const bool pgm = text.starts_with('P');
  if (!obj && !pgm && !text.starts_with("solid") && size >= 84) {  // a binary .stl has its count
    const auto count = static_cast<std::uint32_t>((size - 84) / 50);
    text.resize(84 + std::size_t{50} * count);
    std::memcpy(text.data() + 80, &count, sizeof count);
  }
  const auto file = fuzz::in_file(obj ? "a.obj" : pgm ? "a.pgm" : "a.stl", text);
  try {
    if (pgm) {
      model::read_pgm(file, {1, 1, 1});
    } else {
      model::read_mesh_to_touch(file, {1, 1, 1});
    }
  } catch (const std::runtime_error& error) {
    fuzz::require(typeid(error) == typeid(std::runtime_error), "the reader refuses it itself");
  }
  return 0;
}
