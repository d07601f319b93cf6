#include "host/robot/model/export.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>

#include "common/control/golden.hpp"
#include "common/control/self_test.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/bus_time.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::model {
namespace {

const char* meaning(ImageFault fault) {
  switch (fault) {
    case ImageFault::kNone:
      return "sound";
    case ImageFault::kTruncated:
      return "truncated";
    case ImageFault::kNotAnImage:
      return "not a Params image";
    case ImageFault::kOtherLayout:
      return "of another layout version";
    case ImageFault::kOtherCore:
      return "of another core version";
    case ImageFault::kDamaged:
      return "damaged: its CRC does not fit";
    case ImageFault::kOutOfBounds:
      return "inconsistent: an index points outside its table";
    case ImageFault::kOutOfRange:
      return "no robot's: a number in it is none, or far out of its range";
  }
  return "unknown";
}

/// Name of the first invalid number; empty: all are valid.
std::string bad_number(const Params& params) {
  FieldName bad;
  numbers_fit(params, bad);
  return bad.text;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  const files::Trouble trouble = files::replace(path, bytes);
  if (trouble.any()) throw LoadError(path.string(), 0, trouble.what(), trouble.fix());
}

}  // namespace

ParamsImage make_image(const Entity& entity) {
  ParamsImage image;
  image.params = make_params(entity);
  require_bus(entity, image.params);
  if (const std::string bad = bad_number(image.params); !bad.empty()) {
    throw LoadError(entity.file, 0, bad + " of its Params is no number, or far out of its range",
                    "look at what it comes from: limits, masses and verp:tuning of that name");
  }
  for (std::uint32_t k = 0; k < kGoldenVectors; ++k) {
    image.golden[k] = control::golden_vector(image.params, k + 1);
  }
  const auto scratch = std::make_unique<State>();
  const std::uint64_t digest = control::self_test_digest(image.params, *scratch);
  image.self_test_ticks = control::kSelfTestTicks;
  image.self_test_digest[0] = static_cast<std::uint32_t>(digest);
  image.self_test_digest[1] = static_cast<std::uint32_t>(digest >> 32);
  seal_image(image);
  return image;
}

ParamsImage read_image(const std::string& path) {
  const std::optional<std::string> bytes = files::read(path);
  if (!bytes)
    throw LoadError(path, 0, "cannot read this file", "check the path and its permissions");
  const ImageFault fault = check_image(bytes->data(), bytes->size());
  if (fault != ImageFault::kNone) {
    std::string what = std::string("this Params image is ") + meaning(fault);
    if (fault == ImageFault::kOutOfRange) {
      ParamsImage image;
      std::memcpy(&image, bytes->data(), sizeof image);
      what += " (" + bad_number(image.params) + ")";
    }
    throw LoadError(path, 1, what, "write it again with `verp export`");
  }
  ParamsImage image;
  std::memcpy(&image, bytes->data(), sizeof image);
  return image;
}

std::string image_header(const ParamsImage& image) {
  std::string text = fmt::format(
      "// Params image of {}: written by verp export, CRC-32 {:08x}. Do not edit.\n#pragma once\n\n"
      "alignas(8) inline constexpr unsigned char verp_params_image[{}] = {{",
      image.params.name, image.header.crc32, sizeof image);
  const auto* bytes = reinterpret_cast<const unsigned char*>(&image);
  for (std::size_t i = 0; i < sizeof image; ++i) {
    fmt::format_to(std::back_inserter(text), "{}{:#04x},", i % 16 == 0 ? "\n    " : " ", bytes[i]);
  }
  return text + "\n};\n";
}

int export_command(const std::string& name_or_path, const std::string& bus,
                   const std::string& directory) {
  const ParamsImage image = make_image(load_robot(find_model(name_or_path), bus));
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error || !std::filesystem::is_directory(directory)) {
    throw LoadError(directory, 0, "not a folder and cannot be made", "choose another with -o");
  }
  const std::filesystem::path folder = directory;
  write_file(folder / "params.bin", {reinterpret_cast<const char*>(&image), sizeof image});
  write_file(folder / "params.hpp", image_header(image));
  fmt::print("{}: {} bytes, CRC-32 {:08x}, {} golden vectors, self-test {:08x}{:08x}\n",
             (folder / "params.bin").string(), sizeof image, image.header.crc32, kGoldenVectors,
             image.self_test_digest[1], image.self_test_digest[0]);
  fmt::print("{}: the same bytes as a C++ array\n", (folder / "params.hpp").string());
  return 0;
}

}  // namespace verp::model
