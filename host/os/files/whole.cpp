#include "host/os/files/whole.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace verp::files {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as Linux has it

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// A link in a folder that others may write could be theirs.
bool is_trusted(const struct stat& link, const fs::path& file) {
  struct stat folder {};
  if (::stat(folder_of(file).c_str(), &folder) != 0) return false;
  const bool shared = (folder.st_mode & (S_IWGRP | S_IWOTH)) != 0;
  return !shared || link.st_uid == ::geteuid() || link.st_uid == folder.st_uid || link.st_uid == 0;
}

/// False: errno has the reason.
bool put(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// False: errno has the reason.
bool close_written(int descriptor, bool written) {
  const int error = errno;
  const bool closed = ::close(descriptor) == 0;
  if (!written) errno = error;
  return written && closed;
}

/// A rename is on the disk when its folder is.
void sync_folder(const fs::path& file) {
  const int folder = ::open(folder_of(file).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);  // some file systems know no such sync
  ::close(folder);
}

const char* remedy_for(int error) {
  switch (error) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
    case EIO:
      return "free space, or choose another place";
    case ELOOP:
      return "it is another user's link: remove it, or choose another place";
    case EEXIST:
      return "move it away, or choose another name";
    case ENOENT:
      return "choose a folder that exists";
    default:
      return "choose a place that exists and is yours";
  }
}

}  // namespace

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

std::string Trouble::what() const {
  return std::string("cannot be written: ") + std::strerror(error_);
}

std::string Trouble::fix() const {
  return remedy_for(error_);
}

std::optional<fs::path> target_of(const fs::path& file) {
  fs::path target = file;
  for (int links = 0; links < kMostLinks; ++links) {
    struct stat link {};
    if (::lstat(target.c_str(), &link) != 0 || !S_ISLNK(link.st_mode)) return target;
    std::error_code error;
    if (!is_trusted(link, target)) break;
    target = folder_of(target) / fs::read_symlink(target, error);
  }
  errno = ELOOP;
  return std::nullopt;
}

int open_part(const fs::path& file, fs::path& part) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    part = file;
    part += "." + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".part";
    const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

bool take_name(int part, const fs::path& from, const fs::path& file) {
  struct stat old {};
  if (::stat(file.c_str(), &old) == 0)
    ::fchmod(part, old.st_mode & 0777);  // fails where a disk has no modes
  if (::fsync(part) != 0 && errno != EINVAL) return false;
  if (::rename(from.c_str(), file.c_str()) != 0) return false;
  sync_folder(file);
  return true;
}

Trouble create(const fs::path& file, std::string_view bytes) {
  const int made = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (made < 0) return Trouble(errno);
  if (close_written(made, put(made, bytes))) return {};
  const int error = errno;
  ::unlink(file.c_str());
  return Trouble(error);
}

NewFile::NewFile(const fs::path& file) : file_(file), part_(file) {
  struct stat old {};
  const bool exists = ::stat(file.c_str(), &old) == 0;
  direct_ = exists && !S_ISREG(old.st_mode) && !S_ISDIR(old.st_mode);
  if (direct_) return;
  const std::optional<fs::path> target = target_of(file);
  if (target) file_ = *target;
  bool may = target.has_value();
  if (may && exists) {
    errno = EISDIR;
    may = !S_ISDIR(old.st_mode) && ::access(file_.c_str(), W_OK) == 0;
  }
  if (may) descriptor_ = open_part(file_, part_);
  if (descriptor_ < 0) trouble_ = Trouble(errno);
}

NewFile::~NewFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(part_.c_str());
}

Trouble NewFile::keep() {
  if (direct_ || trouble_.any()) return trouble_;
  if (!take_name(descriptor_, part_, file_)) return Trouble(errno);
  ::close(descriptor_);
  descriptor_ = -1;
  return {};
}

Trouble replace(const fs::path& file, std::string_view bytes) {
  NewFile made(file);
  if (made.trouble().any()) return made.trouble();
  const int descriptor = ::open(made.part().c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) return Trouble(errno);
  if (!close_written(descriptor, put(descriptor, bytes))) return Trouble(errno);
  return made.keep();
}

}  // namespace verp::files
