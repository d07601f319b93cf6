#include "host/robot/model/bam_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/os/files/whole.hpp"
#include "host/robot/model/load_error.hpp"

namespace verp::model {
namespace {

using Json = nlohmann::json;

class BamReader {
 public:
  explicit BamReader(const std::string& file) : text_(files::read(file).value_or("")) {
    out_.file = file;
  }

  Bam read() {
    parse();
    out_.model = words("model");
    out_.actuator = words("actuator");
    out_.kt_n_m_a = number("kt", 1e-6, 1e3).value_or(0);
    out_.resistance_ohm = number("R", 1e-3, 1e4).value_or(0);
    out_.current_limit_a = number("current_limit", 0, 1e4).value_or(0);
    read_gearbox();
    for (const auto& [name, value] : json_.items()) {
      if (std::find(used_.begin(), used_.end(), name) == used_.end()) out_.unread.push_back(name);
    }
    if (!out_.has_motor()) {
      for (const char* const name : {"kt", "R", "current_limit"}) {
        if (json_.contains(name)) out_.unread.emplace_back(name);
      }
    }
    return std::move(out_);
  }

 private:
  int line_of(std::size_t at) const {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at, text_.size()));
    return 1 + static_cast<int>(std::count(text_.begin(), end, '\n'));
  }

  [[noreturn]] void fail(int line, const std::string& what, const std::string& fix) const {
    throw LoadError(out_.file, line, what, fix);
  }

  void parse() {
    try {
      json_ = Json::parse(text_);
    } catch (const Json::parse_error& error) {
      fail(line_of(error.byte), "is not well-formed JSON", "give a file of BAM's parameters");
    }
    if (!json_.is_object())
      fail(1, "holds no parameters",
           "give a file like {\"kt\": 1.6, \"friction_base\": 0.05, ...}");
  }

  std::string words(const char* name) {
    used_.emplace_back(name);
    const auto found = json_.find(name);
    return found != json_.end() && found->is_string() ? found->get<std::string>() : "";
  }

  std::optional<double> number(const char* name, double low, double high) {
    used_.emplace_back(name);
    const auto found = json_.find(name);
    if (found == json_.end()) return std::nullopt;
    const int line = line_of(text_.find(fmt::format("\"{}\"", name)));
    if (!found->is_number())
      fail(line, fmt::format("\"{}\" is no number", name), "write one, like 0.05");
    const double value = found->get<double>();
    if (!(value >= low && value <= high)) {
      fail(line, fmt::format("\"{}\" is {:.6g}", name, value),
           fmt::format("choose from {:.6g} to {:.6g}", low, high));
    }
    return value;
  }

  double needed(const char* name, double most) {
    const auto value = number(name, 0, most);
    if (!value) fail(1, fmt::format("it lacks \"{}\"", name), "add it, as BAM's fits have it");
    return *value;
  }

  /// The shares of the load: one pair in M3 and M4, one for each side in M5 and M6.
  void read_shares(Gearbox& g) {
    g.is_directional =
        json_.contains("load_friction_motor") || json_.contains("load_friction_external");
    const auto share = [&](const char* name, double most) {
      return number(name, 0, most).value_or(0);
    };
    if (!g.is_directional) {
      g.l_base = share("load_friction_base", kMostLoad);
      g.l_strib = share("load_friction_stribeck", kMostLoad);
    } else {
      g.l_base = share("load_friction_motor", kMostLoad);
      g.l_strib = share("load_friction_motor_stribeck", kMostLoad);
      g.l_external = share("load_friction_external", kMostLoad);
      g.l_external_strib = share("load_friction_external_stribeck", kMostLoad);
      g.q_motor_per_n_m = share("load_friction_motor_quad", kMostQuadratic);
      g.q_external_per_n_m = share("load_friction_external_quad", kMostQuadratic);
    }
  }

  void read_gearbox() {
    Gearbox& g = out_.gearbox;
    g.armature_kg_m2 = needed("armature", kMostArmature_kg_m2);
    g.f_base_n_m = needed("friction_base", kMostTorque_n_m);
    g.f_visc_n_m_s = needed("friction_viscous", kMostTorque_n_m);
    g.f_strib_n_m = number("friction_stribeck", 0, kMostTorque_n_m).value_or(0);
    g.w_s_rad_s = number("dtheta_stribeck", 1e-3, 1e3).value_or(1);
    g.alpha = number("alpha", 0.1, 20).value_or(1);
    read_shares(g);
  }

  const std::string text_;
  Bam out_;
  Json json_;
  std::vector<std::string> used_;
};

}  // namespace

std::string Bam::source() const {
  const std::string name = std::filesystem::path(file).filename().string();
  if (model.empty() && actuator.empty()) return "BAM, " + name;
  return fmt::format("BAM {} of {}, {}", model, actuator, name);
}

std::string Bam::unread_text() const {
  if (unread.empty()) return "";
  return fmt::format("{} of {}", fmt::join(unread, ", "),
                     std::filesystem::path(file).filename().string());
}

Bam read_bam(const std::string& file) {
  return BamReader(file).read();
}

}  // namespace verp::model
