#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include "host/author/edit/document.hpp"
#include "host/os/files/whole.hpp"

namespace verp::edit {
namespace {

namespace fs = std::filesystem;

/// Writes into a new file and says which.
std::string keep(const fs::path& file, const std::string& text) {
  const char* temporary = std::getenv("TMPDIR");
  for (const fs::path& folder : {file.parent_path(), fs::path(temporary ? temporary : "/tmp")}) {
    for (int number = 1; number < 100; ++number) {
      const std::string end = number == 1 ? ".unsaved" : ".unsaved" + std::to_string(number);
      const fs::path place = folder / (file.filename().string() + end);
      const files::Trouble trouble = files::create(place, text);
      if (!trouble.any()) return "what was edited is in " + place.string();
      if (trouble.error() != EEXIST) break;
    }
  }
  return "what was edited could not be put anywhere: it is in the editor only";
}

[[noreturn]] void refuse(const fs::path& file, const std::string& text, const std::string& why) {
  throw model::LoadError(file.string(), 0, "not saved: " + why, keep(file, text));
}

/// True if no user may write, even if the superuser could.
bool is_read_only(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return false;
  return (status.st_mode & 0222) == 0 || ::access(file.c_str(), W_OK) != 0;
}

}  // namespace

std::string Document::put_aside() const {
  return file_.string() + ": not saved; " + keep(file_, text_);
}

void Document::save() {
  std::error_code error;
  const fs::path link = fs::weakly_canonical(file_, error);
  const fs::path file = error ? file_ : link;
  const bool exists = fs::exists(file, error);
  if (exists) {
    const std::string now = files::read(file).value_or("");
    if (!on_disk_ || now != *on_disk_) {
      refuse(file_, text_, "the file was changed by another program since it was opened");
    }
    if (now == text_) return;
  } else if (on_disk_) {
    refuse(file_, text_, "the file was removed since it was opened");
  }
  if (exists && is_read_only(file)) refuse(file_, text_, "the file is read-only");
  fs::create_directories(file.parent_path(), error);
  const files::Trouble trouble = files::replace(file_, text_);
  if (trouble.any()) refuse(file_, text_, trouble.what());
  on_disk_ = text_;
}

}  // namespace verp::edit
