#pragma once
#include <tinyxml2.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/author/xacro/expression.hpp"

namespace verp::xacro {

/// A macro, or a block that a caller gives to one.
struct Macro {
  struct Parameter {
    std::string name;
    std::optional<std::string> preset;
    int stars = 0;  ///< 1: one element; 2: its children
  };
  std::vector<Parameter> parameters;
  const tinyxml2::XMLElement* body = nullptr;
  const std::string* file = nullptr;
};

/// Names that hold between a macro's call and its end.
struct Scope {
  const Scope* outer = nullptr;
  std::map<std::string, Value> values;
  std::map<std::string, std::vector<const tinyxml2::XMLNode*>> blocks;  ///< expanded

  const Value* find(const std::string& name) const {
    for (const Scope* at = this; at != nullptr; at = at->outer) {
      const auto found = at->values.find(name);
      if (found != at->values.end()) return &found->second;
    }
    return nullptr;
  }
  const std::vector<const tinyxml2::XMLNode*>* find_block(const std::string& name) const {
    for (const Scope* at = this; at != nullptr; at = at->outer) {
      const auto found = at->blocks.find(name);
      if (found != at->blocks.end()) return &found->second;
    }
    return nullptr;
  }
};

/// The parameters of a macro: "a b:=1 c:='x y' *origin **block".
std::vector<Macro::Parameter> parameters_of(const std::string& text);

}  // namespace verp::xacro
