#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/sdo_server.hpp"

namespace verp::canopen {

/// Servers of the default channel and `kFurther` more (1201h and on), one client each. They take
/// turns in sending.
template <Dictionary D, std::size_t kFurther>
class SdoServers {
 public:
  SdoServers(D& dictionary, std::uint8_t node, unsigned number = 0)
      : server_(dictionary, number == 0 ? default_sdo(node) : further_sdo(number)),
        others_(dictionary, node, number + 1) {}

  void receive(const Frame& frame, std::uint64_t now_us) {
    server_.receive(frame, now_us);
    others_.receive(frame, now_us);
  }
  bool next(Frame& frame, std::uint64_t now_us) {
    first_ = !first_;
    if (first_) return server_.next(frame, now_us) || others_.next(frame, now_us);
    return others_.next(frame, now_us) || server_.next(frame, now_us);
  }
  void reset() {
    server_.reset();
    others_.reset();
  }

 private:
  SdoServer<D> server_;
  SdoServers<D, kFurther - 1> others_;
  bool first_ = false;
};

template <Dictionary D>
class SdoServers<D, 0> : public SdoServer<D> {
 public:
  SdoServers(D& dictionary, std::uint8_t node, unsigned number = 0)
      : SdoServer<D>(dictionary, number == 0 ? default_sdo(node) : further_sdo(number)) {}
};

}  // namespace verp::canopen
