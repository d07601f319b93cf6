#pragma once
#include <string>

namespace verp::model {

/// What is wrong with a name or path that no file was found for; kind: what it should have been.
std::string why_not_found(const std::string& name_or_path, const std::string& kind);

}  // namespace verp::model
