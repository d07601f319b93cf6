#pragma once
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/run/session/plan.hpp"

namespace verp::own {

/// The controller cannot be loaded, or commanded an impossible goal.
class OwnError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Loaded {
 public:
  /// `file`: the folder's controller.so. Throws OwnError.
  Loaded(const std::filesystem::path& folder, const std::filesystem::path& file);
  ~Loaded();
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;

  /// A controller for one run; it keeps `loaded` alive. The call throws OwnError for a refused
  /// goal; a crash in it prints one line and exits with 1.
  static session::Decide controller(const std::shared_ptr<const Loaded>& loaded);

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
  void* library_ = nullptr;
  const void* module_ = nullptr;
};

}  // namespace verp::own
