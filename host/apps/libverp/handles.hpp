#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "host/apps/libverp/failure.hpp"

namespace verp::abi {

/// Number of forks between the process that loaded the library and this one.
unsigned forks();

/// Objects of one kind of handle. Handles are never reused: a closed one is recognised. One call at
/// a time uses an object. A forked process must not use or destroy the parent's objects, whose
/// files and programs belong to the parent.
template <class Object>
class Handles {
 public:
  /// `what`: the kind in words; `kind`: separates its handles from others'.
  Handles(const char* what, std::uint64_t kind) : what_(what), next_(kind) { forks(); }
  ~Handles() {
    // Never destroyed here, but reachable, so that no leak is reported.
    static auto& of_parent = *new std::vector<std::shared_ptr<Object>>;
    for (auto& [id, place] : places_) {
      if (place.forks != forks()) of_parent.push_back(std::move(place.object));
    }
  }
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  class Use {
   public:
    Use(Handles& all, std::uint64_t id, std::shared_ptr<Object> object)
        : all_(all), id_(id), object_(std::move(object)) {}
    ~Use() { all_.give_back(id_); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    Object& operator*() const { return *object_; }
    Object* operator->() const { return object_.get(); }

   private:
    Handles& all_;
    std::uint64_t id_;
    std::shared_ptr<Object> object_;
  };

  template <class Handle>
  Handle add(std::shared_ptr<Object> object) {
    const std::lock_guard lock(mutex_);
    const std::uint64_t id = next_;
    next_ += kKinds;
    places_.emplace(id, Place{std::move(object), forks()});
    return reinterpret_cast<Handle>(id);
  }

  template <class Handle>
  Use use(Handle handle) {
    const auto id = reinterpret_cast<std::uint64_t>(handle);
    const std::lock_guard lock(mutex_);
    Place& place = find(id);
    if (std::exchange(place.busy, true)) throw busy();
    return Use(*this, id, place.object);
  }

  /// Removes the object, so that no later call finds it.
  template <class Handle>
  std::shared_ptr<Object> take(Handle handle) {
    const auto id = reinterpret_cast<std::uint64_t>(handle);
    const std::lock_guard lock(mutex_);
    Place& place = find(id);
    if (place.busy) throw busy();
    std::shared_ptr<Object> object = std::move(place.object);
    places_.erase(id);
    return object;
  }

 private:
  static constexpr std::uint64_t kKinds = 16;
  struct Place {
    std::shared_ptr<Object> object;
    unsigned forks = 0;
    bool busy = false;
  };

  Place& find(std::uint64_t id) {
    const auto found = places_.find(id);
    if (found != places_.end() && found->second.forks != forks())
      throw Failure(VERP_BAD_HANDLE, std::string("this ") + what_ +
                                         " is of the process that forked this one; open one here");
    if (found != places_.end()) return found->second;
    throw Failure(VERP_BAD_HANDLE, std::string("this ") + what_ +
                                       (id == 0 ? " is null" : " was closed, or never was one") +
                                       "; open one");
  }
  Failure busy() const {
    return Failure(VERP_BUSY,
                   std::string("another thread, or a callback's caller, is using this ") + what_ +
                       "; use it from one thread at a time, not from callbacks");
  }
  void give_back(std::uint64_t id) {
    const std::lock_guard lock(mutex_);
    places_.at(id).busy = false;
  }

  const char* what_;
  std::mutex mutex_;
  std::uint64_t next_;
  std::map<std::uint64_t, Place> places_;
};

}  // namespace verp::abi
