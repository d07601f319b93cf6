#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// Store: small values that outlive the power, by key: calibration, settings, the crash record.
///
/// Promises of a backend:
///  - get(key, to, capacity): the size of the value of `key` as it would be found if the power went
///    now; copies its first min(size, capacity) bytes. 0: there is none.
///  - put(key, from, size): takes a copy of a new value; size 0 removes the key. kAccepted is not
///    yet durable: that is when work() has said kIdle. One at a time: kBusy until then.
///    kNoRoom: values, keys or this value would exceed what the store holds; nothing changed.
///    kBadKey: 0 and 0xFFFF are no keys.
///  - work(may_erase): one step, bounded: at most as many bytes as the backend says, so that a
///    control period can afford it; an erase, which can stop the processor for seconds, only if
///    may_erase (torque off). kNeedsErase: it cannot go on without. kFailed: the memory did not
///    take the value; it keeps the old one, the new one is dropped, and put() works again.
///  - Power that goes at any time, also within an erase or half-way through a word, leaves of each
///    key the old or the new value, and from the next start on always the same of the two.
///  - No call allocates or throws.
/// Implementations: hal/fake/memory_store.hpp, firmware/store/flash_store.hpp. User: a board's
/// calibration and settings, by the operator link.
namespace verp::hal {

enum class PutResult : std::uint8_t { kAccepted = 0, kBusy = 1, kNoRoom = 2, kBadKey = 3 };
enum class WorkState : std::uint8_t { kIdle = 0, kWorking = 1, kNeedsErase = 2, kFailed = 3 };

inline constexpr std::uint16_t kNoKey = 0xFFFF;

template <class Memory>
concept Store = requires(Memory& store, const Memory& seen, std::uint16_t key, std::uint8_t* to,
                         const std::uint8_t* from, std::size_t size, bool may_erase) {
  { seen.get(key, to, size) } -> std::same_as<std::size_t>;
  { store.put(key, from, size) } -> std::same_as<PutResult>;
  { store.work(may_erase) } -> std::same_as<WorkState>;
};

}  // namespace verp::hal
