#include "tests/host/files/power_cut.hpp"

#include <sys/stat.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <vector>

extern "C" {
int __real_fsync(int descriptor);
int __real_rename(const char* from, const char* to);
int __wrap_fsync(int descriptor);
int __wrap_rename(const char* from, const char* to);
}

namespace verp::files::test {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Disk {
  struct Rename {
    ino_t file;
    std::string to;
  };
  std::string file;
  std::function<void(const std::string&)> cut;
  std::map<ino_t, std::string> synced;  ///< content of files
  ino_t named = 0;                      ///< what surely has the name; 0: nothing
  std::vector<Rename> renames;          ///< since the last sync of their folder
  int cuts = 0;

  /// What changed since its sync is torn.
  void forget_if_changed(const fs::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return;
    const auto found = synced.find(status.st_ino);
    if (found != synced.end() && found->second != content_of(path)) synced.erase(found);
  }
  std::string after_cut(ino_t inode) const {
    if (inode == 0) return kMissing;
    const auto found = synced.find(inode);
    return found == synced.end() ? kTorn : found->second;
  }
  void power_cut() {
    ++cuts;
    forget_if_changed(file);
    cut(after_cut(named));
    for (const Rename& each : renames) cut(after_cut(each.file));
  }
};

Disk* disk = nullptr;

void note_sync(int descriptor) {
  struct stat status {};
  ::fstat(descriptor, &status);
  if (S_ISREG(status.st_mode)) {
    disk->synced[status.st_ino] = content_of("/proc/self/fd/" + std::to_string(descriptor));
    return;
  }
  std::vector<Disk::Rename> left;
  for (const Disk::Rename& each : disk->renames) {
    struct stat folder {};
    ::stat(fs::path(each.to).parent_path().c_str(), &folder);
    const bool covered = folder.st_ino == status.st_ino;
    if (covered && each.to == disk->file) disk->named = each.file;
    if (!covered) left.push_back(each);
  }
  disk->renames = left;
}

}  // namespace

int each_power_cut(const std::string& file, const std::function<void()>& work,
                   const std::function<void(const std::string&)>& cut) {
  Disk here{.file = file, .cut = cut, .synced = {}, .named = 0, .renames = {}};
  struct stat old {};
  if (::stat(file.c_str(), &old) == 0) {
    here.named = old.st_ino;
    here.synced[old.st_ino] = content_of(file);
  }
  disk = &here;
  work();
  here.power_cut();
  disk = nullptr;
  return here.cuts;
}

}  // namespace verp::files::test

using verp::files::test::disk;

int __wrap_fsync(int descriptor) {
  if (disk == nullptr) return __real_fsync(descriptor);
  disk->power_cut();
  const int result = __real_fsync(descriptor);
  verp::files::test::note_sync(descriptor);
  disk->power_cut();
  return result;
}

int __wrap_rename(const char* from, const char* to) {
  if (disk == nullptr) return __real_rename(from, to);
  disk->power_cut();
  struct stat status {};
  ::stat(from, &status);
  disk->forget_if_changed(from);
  const int result = __real_rename(from, to);
  if (result == 0 && std::string(to) == disk->file) disk->renames.push_back({status.st_ino, to});
  disk->power_cut();
  return result;
}
