#pragma once
#include <functional>
#include <string>

namespace verp::files::test {

/// A disk that loses what was not synced; the linker's --wrap puts it below fsync and rename. Calls
/// `cut` with each content that `file` could have after a power cut just before and after each such
/// call in `work`. Unsynced content is torn; renames without a sync of their folder are there or
/// not. Returns the number of cuts.
int each_power_cut(const std::string& file, const std::function<void()>& work,
                   const std::function<void(const std::string& content)>& cut);

inline constexpr const char* kTorn = "(torn)";
inline constexpr const char* kMissing = "(missing)";

}  // namespace verp::files::test
