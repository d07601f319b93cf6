#pragma once
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/run/session/plan.hpp"

namespace verp::own {

/// A controller that cannot be loaded, or put out what no joint can do: which, where, why.
class OwnError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A controller of somebody's own, in this process. What it says of itself is its folder.
class Loaded {
 public:
  /// `file`: its controller.so. Throws OwnError.
  Loaded(const std::filesystem::path& folder, const std::filesystem::path& file);
  ~Loaded();
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;

  /// One for one run, which lives on with what is returned. Its call throws OwnError for a goal
  /// that was refused; one that crashes ends this process, in one line and with status 1.
  static session::Decide controller(const std::shared_ptr<const Loaded>& loaded);

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
  void* library_ = nullptr;
  const void* module_ = nullptr;
};

}  // namespace verp::own
