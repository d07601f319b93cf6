#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <queue>
#include <string>
#include <vector>

#include "host/trace/record/mcap_reader.hpp"

namespace verp::record {

/// Messages of some files by time, then by file and record. Holds the chunks that overlap in time;
/// throws TraceError if these take too much.
class InOrder {
 public:
  struct Source {
    std::filesystem::path path;
    mcap::Reader* reader;
  };
  struct Next {
    std::size_t source = 0;
    mcap::Message message;
  };
  /// Reads all files once. The readers must outlive this object.
  explicit InOrder(std::vector<Source> sources);

  /// Valid until the next call; nullopt: the end.
  std::optional<Next> next();

 private:
  struct Part {
    std::uint64_t first_ns = 0, offset = 0;
    std::size_t source = 0;
  };
  struct Waiting {
    Next next;
    std::size_t number = 0;  ///< in its part
    std::shared_ptr<const std::string> bytes;
    bool operator<(const Waiting& other) const;  ///< later; for a queue whose top is the first
  };
  void load(const Part& part);

  std::vector<Source> sources_;
  std::vector<Part> parts_;
  std::size_t loaded_ = 0, held_bytes_ = 0;
  std::priority_queue<Waiting> waiting_;
  std::shared_ptr<const std::string> given_;
};

}  // namespace verp::record
