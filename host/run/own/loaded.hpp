#pragma once
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/run/session/plan.hpp"

namespace verp::own {

/// A controller that cannot be loaded or that commanded an impossible goal. Says which, where and
/// why.
class OwnError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A user's controller, loaded into this process. Messages name it by its folder.
class Loaded {
 public:
  /// `file`: the folder's controller.so. Throws OwnError.
  Loaded(const std::filesystem::path& folder, const std::filesystem::path& file);
  ~Loaded();
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;

  /// A controller instance for one run; it keeps `loaded` alive. Calling it throws OwnError for a
  /// refused goal. A crash in it prints one line and ends this process with status 1.
  static session::Decide controller(const std::shared_ptr<const Loaded>& loaded);

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
  void* library_ = nullptr;
  const void* module_ = nullptr;
};

}  // namespace verp::own
