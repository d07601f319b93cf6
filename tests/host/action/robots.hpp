#pragma once
#include <string>

#include "host/author/action/compile.hpp"
#include "host/author/action/folder.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/robot/model/params.hpp"

namespace verp::action::test {

struct Robot {
  explicit Robot(const std::string& name)
      : entity(model::load_robot(model::find_model(name))), params(model::make_params(entity)) {}
  CompiledActions make(const std::vector<std::string>& texts) const {
    std::vector<Document> documents;
    for (const std::string& text : texts) {
      documents.push_back(
          parse_document("a" + std::to_string(documents.size() + 1) + ".action", text));
    }
    return make_library(params, documents);
  }
  model::Entity entity;
  Params params;
};

inline const Robot& generic21() {
  static const Robot robot("generic21");
  return robot;
}

/// The compiler's error, or "".
inline std::string refusal(const std::vector<std::string>& texts) {
  try {
    generic21().make(texts);
    return "";
  } catch (const model::LoadError& error) {
    return error.what();
  }
}

}  // namespace verp::action::test
