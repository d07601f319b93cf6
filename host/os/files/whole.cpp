#include "host/os/files/whole.hpp"

#include <unistd.h>

#include <cerrno>
#include <fstream>

namespace verp::files {

namespace fs = std::filesystem;

std::optional<std::string> read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::string bytes;
  for (char chunk[1 << 16]; in.read(chunk, sizeof chunk) || in.gcount() > 0;) {
    bytes.append(chunk, static_cast<std::size_t>(in.gcount()));
    if (bytes.size() <= kMostBytes) continue;
    errno = EFBIG;
    return std::nullopt;
  }
  return bytes;
}

bool write(const fs::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  return out.good();
}

bool replace(const fs::path& file, std::string_view bytes) {
  std::error_code error;
  const bool link = fs::is_symlink(file, error);
  const fs::path target = link ? fs::weakly_canonical(file, error) : file;
  if (fs::exists(target, error) && !fs::is_regular_file(target, error)) return write(target, bytes);
  fs::path part = target;
  part += "." + std::to_string(::getpid()) + ".part";
  const bool written = write(part, bytes);
  if (written) fs::rename(part, target, error);
  if (written && !error) return true;
  fs::remove(part, error);
  return false;
}

}  // namespace verp::files
