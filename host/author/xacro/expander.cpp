#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <sstream>

#include "host/author/xacro/packages.hpp"
#include "host/author/xacro/scope.hpp"
#include "host/author/xacro/xacro.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/malformed_xml.hpp"

namespace verp::xacro {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

constexpr int kMostDepth = 100;       // of macros and includes in each other
constexpr int kMostElements = 50000;  // of the robot that is made

class Expander {
 public:
  Expander(const std::string& file, const std::string& folder) : folder_(folder) {
    const File& main = read(file);
    file_ = &main.path;
    XMLElement* const root = out_.NewElement("robot");
    out_.InsertEndChild(root);
    copy_attributes(*main.xml.RootElement(), *root, global_);
    expand_children(*main.xml.RootElement(), *root, global_);
  }

  Expanded take() {
    tinyxml2::XMLPrinter printer;
    out_.Print(&printer);
    for (const std::string& each : missing_)
      left_out_.push_back("the include " + each + " is not found");
    for (const std::string& each : guessed_)
      left_out_.push_back("the argument " + each + " has no default: false is taken");
    for (const std::string& each : unknown_)
      left_out_.push_back("the macro " + each + " is in no file that was found");
    return {printer.CStr(), left_out_};
  }

 private:
  struct File {
    std::string path;
    XMLDocument xml;
  };

  [[noreturn]] void fail(const XMLNode& at, const std::string& what, const std::string& fix) const {
    throw model::LoadError(*file_, at.GetLineNum(), what, fix);
  }

  const File& read(const std::string& path) {
    files_.push_back(std::make_unique<File>());
    File& file = *files_.back();
    file.path = path;
    model::load_xml(path, file.xml);
    return file;
  }

  // Texts.

  Value look_up(const std::string& name, const Scope& scope) const {
    if (const Value* const value = scope.find(name)) return *value;
    const std::size_t dot = name.rfind('.');  // an include's namespace
    if (dot != std::string::npos) return look_up(name.substr(dot + 1), scope);
    throw ExpressionError("there is no property '" + name + "'");
  }

  Value expression(const std::string& text, const Scope& scope) const {
    return evaluate(text, [&](const std::string& name) { return look_up(name, scope); });
  }

  /// $(arg NAME), $(find PACKAGE), ...
  std::string substitution(const std::string& text, const Scope& scope) const {
    std::istringstream words(text);
    std::string verb, name, rest;
    words >> verb >> name;
    std::getline(words >> std::ws, rest);
    if (verb == "eval") return text_of(expression(text.substr(text.find("eval") + 4), scope));
    if (verb == "dirname") return fs::path(*file_).parent_path().string();
    if (verb == "find") return find_package(name, *file_).value_or("package://" + name);
    if (verb == "optenv") return rest;
    if (verb != "arg") throw ExpressionError("$(" + text + ") is not understood");
    const auto found = arguments_.find(name);
    if (found != arguments_.end()) return found->second;
    guessed_.insert(name);
    return "false";
  }

  /// A number, where the whole text is one expression that gives one.
  Value filled(const std::string& text, const Scope& scope) const {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
      if (out.size() > kMostText) throw ExpressionError("its text is longer than 64 kB");
      if (text.compare(at, 2, "$$") == 0) {
        out += '$';
        at += 2;
        continue;
      }
      const bool is_expression = text.compare(at, 2, "${") == 0;
      if (!is_expression && text.compare(at, 2, "$(") != 0) {
        out += text[at++];
        continue;
      }
      const std::size_t end = end_of(text, at + 1);
      const std::string inside = text.substr(at + 2, end - at - 2);
      if (is_expression && at == 0 && end + 1 == text.size()) return expression(inside, scope);
      out += is_expression ? text_of(expression(inside, scope)) : substitution(inside, scope);
      at = end + 1;
    }
    return out;
  }

  /// Of the bracket that opens at `open`.
  static std::size_t end_of(const std::string& text, std::size_t open) {
    const char opens = text[open], closes = opens == '{' ? '}' : ')';
    int depth = 0;
    for (std::size_t at = open; at < text.size(); ++at) {
      if (text[at] == opens) ++depth;
      if (text[at] == closes && --depth == 0) return at;
    }
    throw ExpressionError("a bracket of '" + text + "' is not closed");
  }

  Value fill(const XMLNode& at, const std::string& text, const Scope& scope) const {
    try {
      return filled(text, scope);
    } catch (const ExpressionError& error) {
      fail(at, "'" + text + "': " + error.what(), "correct it");
    }
  }

  std::string attribute(const XMLElement& element, const char* name, const Scope& scope) const {
    const char* const text = element.Attribute(name);
    if (text == nullptr)
      fail(element, fmt::format("<{}> has no {}", element.Name(), name), "add it");
    return text_of(fill(element, text, scope));
  }

  // Elements.

  void copy_attributes(const XMLElement& from, XMLElement& to, const Scope& scope) const {
    for (const auto* a = from.FirstAttribute(); a != nullptr; a = a->Next()) {
      if (std::strncmp(a->Name(), "xmlns:xacro", 11) == 0) continue;
      std::string text = text_of(fill(from, a->Value(), scope));
      if (std::strcmp(a->Name(), "filename") == 0 && std::strcmp(from.Name(), "mesh") == 0)
        text = moved_path(text, *file_, folder_);
      to.SetAttribute(a->Name(), text.c_str());
    }
  }

  void expand_children(const XMLNode& from, XMLNode& to, Scope& scope) {
    for (const XMLNode* each = from.FirstChild(); each != nullptr; each = each->NextSibling()) {
      if (const XMLElement* const element = each->ToElement()) {
        expand(*element, to, scope);
      } else if (const auto* const text = each->ToText()) {
        to.InsertEndChild(out_.NewText(text_of(fill(*text, text->Value(), scope)).c_str()));
      }
    }
  }

  void expand(const XMLElement& element, XMLNode& to, Scope& scope) {
    if (std::strncmp(element.Name(), "xacro:", 6) == 0)
      return obey(element, element.Name() + 6, to, scope);
    count(element, 1);
    XMLElement* const copy = out_.NewElement(element.Name());
    to.InsertEndChild(copy);
    copy_attributes(element, *copy, scope);
    expand_children(element, *copy, scope);
  }

  /// Elements, and calls of macros, which may make none.
  void count(const XMLElement& at, int more) {
    elements_ += more;
    if (elements_ > kMostElements)
      fail(at, "it makes more than 50000 elements", "look for macros that call each other");
  }

  void obey(const XMLElement& element, const std::string& word, XMLNode& to, Scope& scope) {
    if (word == "property") return define(element, scope);
    if (word == "macro") return add_macro(element, scope);
    if (word == "include") return include(element, to, scope);
    if (word == "insert_block") return insert_block(element, to, scope);
    if (word == "if" || word == "unless") {
      const bool holds = is_true(value_of(attribute(element, "value", scope)));
      if (holds == (word == "if")) expand_children(element, to, scope);
    } else if (word == "arg") {
      const std::string name = attribute(element, "name", scope);
      if (element.Attribute("default") != nullptr)
        arguments_.emplace(name, attribute(element, "default", scope));
    } else {
      call(element, word == "call" ? attribute(element, "macro", scope) : word, to, scope);
    }
  }

  void define(const XMLElement& element, Scope& scope) {
    const std::string name = attribute(element, "name", scope);
    Scope* to = &scope;
    const char* const wide = element.Attribute("scope");
    if (wide != nullptr && std::strcmp(wide, "global") == 0) to = &global_;
    if (element.Attribute("value") != nullptr) {
      const Value value = fill(element, element.Attribute("value"), scope);
      const std::string* const text = std::get_if<std::string>(&value);
      to->values[name] = text != nullptr ? value_of(*text) : value;
    } else if (element.Attribute("default") != nullptr) {
      if (scope.find(name) == nullptr)
        to->values[name] = value_of(attribute(element, "default", scope));
    } else {
      to->blocks[name] = expanded_children(element, scope);
    }
  }

  std::vector<const XMLNode*> expanded_children(const XMLNode& from, Scope& scope) {
    XMLElement* const holder = out_.NewElement("block");  // never in the tree
    expand_children(from, *holder, scope);
    std::vector<const XMLNode*> nodes;
    for (const XMLNode* each = holder->FirstChild(); each != nullptr; each = each->NextSibling())
      nodes.push_back(each);
    return nodes;
  }

  void add_macro(const XMLElement& element, const Scope& scope) {
    Macro macro;
    const char* const parameters = element.Attribute("params");
    macro.parameters = parameters_of(parameters == nullptr ? "" : parameters);
    macro.body = &element;
    macro.file = file_;
    std::string name = attribute(element, "name", scope);
    if (name.rfind("xacro:", 0) == 0) name = name.substr(6);
    macros_[name] = macro;
  }

  void include(const XMLElement& element, XMLNode& to, Scope& scope) {
    const std::string name = attribute(element, "filename", scope);
    fs::path path = fs::path(*file_).parent_path() / moved_path(name, *file_, parent_of(*file_));
    if (!fs::exists(path)) {
      missing_.insert(name);
      return;
    }
    const Deeper deeper(*this, element);
    const std::string* const before = file_;
    const File& file = read(path.string());
    file_ = &file.path;
    expand_children(*file.xml.RootElement(), to, scope);
    file_ = before;
  }

  static std::string parent_of(const std::string& file) {
    const std::string folder = fs::path(file).parent_path().string();
    return folder.empty() ? "." : folder;
  }

  void insert_block(const XMLElement& element, XMLNode& to, const Scope& scope) {
    const std::string name = attribute(element, "name", scope);
    const auto* const block = scope.find_block(name);
    if (block == nullptr) fail(element, "there is no block '" + name + "'", "correct the name");
    count(element, static_cast<int>(block->size()));
    for (const XMLNode* each : *block) to.InsertEndChild(each->DeepClone(&out_));
  }

  void call(const XMLElement& element, std::string name, XMLNode& to, Scope& scope) {
    if (name.rfind("xacro:", 0) == 0) name = name.substr(6);
    const std::size_t dot = name.rfind('.');
    if (dot != std::string::npos) name = name.substr(dot + 1);
    const auto found = macros_.find(name);
    if (found == macros_.end()) {
      if (missing_.empty())
        fail(element, "there is no macro '" + name + "'", "define it, or correct the name");
      unknown_.insert(name);
      return;
    }
    const Macro macro = found->second;
    const Deeper deeper(*this, element);
    count(element, 1);
    Scope inner;
    inner.outer = &global_;
    give_values(element, macro, scope, inner);
    give_blocks(element, macro, scope, inner);
    const std::string* const before = file_;
    file_ = macro.file;
    expand_children(*macro.body, to, inner);
    file_ = before;
  }

  void give_values(const XMLElement& element, const Macro& macro, const Scope& scope,
                   Scope& inner) {
    for (const Macro::Parameter& each : macro.parameters) {
      if (each.stars > 0) continue;
      const char* const given = element.Attribute(each.name.c_str());
      if (given == nullptr && !each.preset) {
        fail(element, fmt::format("<{}> lacks {}", element.Name(), each.name), "add it");
      }
      if (given == nullptr && each.preset->rfind('^', 0) == 0) {
        give_outer(element, each, scope, inner);
        continue;
      }
      const Value value =
          fill(element, given != nullptr ? given : *each.preset, given != nullptr ? scope : inner);
      const std::string* const text = std::get_if<std::string>(&value);
      inner.values[each.name] = text != nullptr ? value_of(*text) : value;
    }
  }

  /// "^" or "^|preset": the caller's property of the same name.
  void give_outer(const XMLElement& element, const Macro::Parameter& parameter, const Scope& scope,
                  Scope& inner) const {
    if (const Value* const value = scope.find(parameter.name)) {
      inner.values[parameter.name] = *value;
    } else if (parameter.preset->rfind("^|", 0) == 0) {
      inner.values[parameter.name] =
          value_of(text_of(fill(element, parameter.preset->substr(2), inner)));
    } else {
      fail(element, fmt::format("<{}> lacks {}", element.Name(), parameter.name), "add it");
    }
  }

  void give_blocks(const XMLElement& element, const Macro& macro, Scope& scope, Scope& inner) {
    const XMLElement* child = element.FirstChildElement();
    for (const Macro::Parameter& each : macro.parameters) {
      if (each.stars == 0) continue;
      if (child == nullptr)
        fail(element, fmt::format("<{}> lacks the block {}", element.Name(), each.name), "add it");
      if (each.stars == 2) {
        inner.blocks[each.name] = expanded_children(*child, scope);
      } else {
        XMLElement* const holder = out_.NewElement("block");
        expand(*child, *holder, scope);
        if (holder->FirstChild() != nullptr) inner.blocks[each.name] = {holder->FirstChild()};
      }
      child = child->NextSiblingElement();
    }
  }

  /// Counts macros and includes that are open.
  class Deeper {
   public:
    Deeper(Expander& owner, const XMLElement& at) : owner_(owner) {
      if (++owner_.depth_ > kMostDepth)
        owner_.fail(at, "macros or includes have no end here", "remove the one that goes round");
    }
    ~Deeper() { --owner_.depth_; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;

   private:
    Expander& owner_;
  };

  const std::string folder_;
  const std::string* file_ = nullptr;  ///< the one that is read now
  std::vector<std::unique_ptr<File>> files_;
  XMLDocument out_;
  Scope global_;
  std::map<std::string, Macro> macros_;
  std::map<std::string, std::string> arguments_;
  std::set<std::string> missing_, unknown_;
  mutable std::set<std::string> guessed_;  ///< arguments
  std::vector<std::string> left_out_;
  int depth_ = 0, elements_ = 0;
};

}  // namespace

std::vector<Macro::Parameter> parameters_of(const std::string& text) {
  std::vector<Macro::Parameter> out;
  for (std::size_t at = 0; at < text.size();) {
    if (std::isspace(static_cast<unsigned char>(text[at])) != 0) {
      ++at;
      continue;
    }
    Macro::Parameter parameter;
    while (at < text.size() && text[at] == '*') ++parameter.stars, ++at;
    const std::size_t end = std::min(text.find_first_of(" \t\r\n:=", at), text.size());
    parameter.name = text.substr(at, end - at);
    at = end;
    if (at < text.size() && (text[at] == ':' || text[at] == '=')) {
      at += text.compare(at, 2, ":=") == 0 ? 2 : 1;
      std::string preset;
      for (char quote = 0; at < text.size(); ++at) {
        const char c = text[at];
        const bool is_quote = c == '\'' || c == '"';
        if (is_quote && (quote == 0 || quote == c)) {
          quote = quote == 0 ? c : 0;
          continue;
        }
        if (quote == 0 && std::isspace(static_cast<unsigned char>(c)) != 0) break;
        preset += c;
      }
      parameter.preset = preset;
    }
    if (parameter.name.empty()) break;
    out.push_back(parameter);
  }
  return out;
}

Expanded expand(const std::string& file, const std::string& folder) {
  return Expander(file, folder).take();
}

}  // namespace verp::xacro
