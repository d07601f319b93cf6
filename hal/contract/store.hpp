#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

/// Store: small non-volatile values by key.
///
/// A backend promises:
///  - get(key, to, capacity): the size of the value that would survive a power cut now; copies its
///    first min(size, capacity) bytes. 0: no such key.
///  - put(key, from, size): copies a new value; size 0 removes the key. kAccepted is durable once
///    work() returns kIdle; until then further puts return kBusy. kNoRoom: nothing changed.
///    kBadKey: 0 and 0xFFFF are not keys.
///  - work(may_erase): one step that fits a control period; the backend states its maximum of
///    bytes. It erases, which can stop the processor for seconds, only if may_erase (torque off).
///    kNeedsErase: it cannot continue without. kFailed: the memory rejected the value; the old one
///    stays, and put() works again.
///  - A power cut at any time leaves the old or the new value of each key; from the next start on
///    always the same one.
///  - No call allocates or throws.
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
