#include "host/robot/model/mesh_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "host/robot/model/number.hpp"

namespace verp::model {
namespace {

constexpr std::size_t kMostTriangles = 200'000;
constexpr std::size_t kMostBytes = 64u << 20;
constexpr int kMostSamples = 2049;  // heightfield's side
constexpr double kMostCorner_m = 1e4;

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) throw std::runtime_error("it cannot be read");
  const auto size = in.tellg();
  if (size < 0 || static_cast<std::size_t>(size) > kMostBytes)
    throw std::runtime_error("it is larger than 64 MB");
  in.seekg(0);
  return {std::istreambuf_iterator<char>(in), {}};
}

class MeshBuilder {
 public:
  MeshBuilder(const std::string& path, const Vec3& scale) : scale_(scale) { mesh_.file = path; }

  void add(const std::array<Vec3, 3>& corner) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = index_of(corner[i].cwiseProduct(scale_));
    if (mesh_.triangle.size() == kMostTriangles)
      throw std::runtime_error("it has more than 200000 triangles");
    const bool flat =
        triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
    if (!flat) mesh_.triangle.push_back(triangle);
  }

  std::shared_ptr<const Mesh> take() {
    if (mesh_.triangle.empty()) throw std::runtime_error("there is no triangle in it");
    return std::make_shared<const Mesh>(std::move(mesh_));
  }

 private:
  std::uint32_t index_of(const Vec3& corner) {
    if (!corner.allFinite() || corner.cwiseAbs().maxCoeff() > kMostCorner_m)
      throw std::runtime_error("a corner is no finite number, or 10 km away");
    const auto next = static_cast<std::uint32_t>(mesh_.vertex_m.size());
    const auto [found, fresh] = index_.insert({{corner.x(), corner.y(), corner.z()}, next});
    if (fresh) mesh_.vertex_m.push_back(corner);
    return found->second;
  }

  Vec3 scale_;
  Mesh mesh_;
  std::map<std::array<double, 3>, std::uint32_t> index_;
};

void read_binary(const std::string& bytes, MeshBuilder& out) {
  constexpr std::size_t kHead = 84, kEach = 50;
  for (std::size_t at = kHead; at + kEach <= bytes.size(); at += kEach) {
    std::array<Vec3, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
      float value[3];
      std::memcpy(value, bytes.data() + at + 12 + 12 * i, sizeof value);
      corner[i] = {static_cast<double>(value[0]), static_cast<double>(value[1]),
                   static_cast<double>(value[2])};
    }
    out.add(corner);
  }
}

bool is_binary(const std::string& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() < 84) return false;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return bytes.size() == 84 + std::size_t{50} * count;
}

void read_text(const std::string& bytes, MeshBuilder& out) {
  std::istringstream in(bytes);
  std::array<Vec3, 3> corner;
  std::size_t corners = 0;
  std::string word;
  if (!(in >> word) || word != "solid") throw std::runtime_error("it is no .stl or .obj file");
  while (in >> word) {
    if (word != "vertex") continue;
    for (int axis = 0; axis < 3; ++axis) {
      in >> word;
      const auto value = parse_number(word);
      if (!in || !value) throw std::runtime_error("'" + word + "' in it is not a number");
      corner[corners][axis] = *value;
    }
    if (++corners == 3) out.add(corner), corners = 0;
  }
}

bool ends_in_obj(const std::string& path) {
  std::string ending = path.substr(path.size() - std::min<std::size_t>(4, path.size()));
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".obj";
}

Vec3 obj_corner(std::istream& words) {
  Vec3 corner;
  for (int axis = 0; axis < 3; ++axis) {
    std::string word;
    words >> word;
    const auto value = parse_number(word);
    if (!value) throw std::runtime_error("'" + word + "' in it is not a number");
    corner[axis] = *value;
  }
  return corner;
}

/// "7", "7/2/5" or "-1", from the end.
const Vec3& obj_named(const std::string& word, const std::vector<Vec3>& corners) {
  const auto value = parse_number(word.substr(0, word.find('/')));
  const double count = static_cast<double>(corners.size());
  const double at = !value ? -1 : *value < 0 ? count + *value : *value - 1;
  if (at < 0 || at >= count || at != std::floor(at))
    throw std::runtime_error("a face names the corner '" + word + "', which is none");
  return corners[static_cast<std::size_t>(at)];
}

/// More than three corners: a fan, for flat convex faces.
void read_obj(const std::string& bytes, MeshBuilder& out) {
  std::istringstream in(bytes);
  std::vector<Vec3> corners;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") corners.push_back(obj_corner(words));
    if (word != "f") continue;
    std::vector<Vec3> face;
    while (words >> word) face.push_back(obj_named(word, corners));
    for (std::size_t i = 2; i < face.size(); ++i) out.add({face[0], face[i - 1], face[i]});
  }
}

int header_number(std::istream& in) {
  std::string word;
  while (in >> word && word.starts_with('#')) std::getline(in, word);
  const auto value = parse_number(word);
  if (!value || *value < 1 || *value > 65535 || *value != std::floor(*value))
    throw std::runtime_error("its header is not that of a .pgm file");
  return static_cast<int>(*value);
}

double sample(std::istream& in, bool text, bool wide) {
  if (text) {
    double value = -1;
    in >> value;
    return value;
  }
  int value = in.get();
  if (wide) value = 256 * value + in.get();
  return value;
}

}  // namespace

std::shared_ptr<const Mesh> read_mesh_to_touch(const std::string& path, const Vec3& scale) {
  const std::string bytes = bytes_of(path);
  MeshBuilder builder(path, scale);
  if (ends_in_obj(path)) {
    read_obj(bytes, builder);
  } else {
    is_binary(bytes) ? read_binary(bytes, builder) : read_text(bytes, builder);
  }
  return builder.take();
}

std::shared_ptr<const Heightfield> read_pgm(const std::string& path, const Vec3& size_m) {
  std::istringstream in(bytes_of(path));
  std::string magic;
  in >> magic;
  if (magic != "P2" && magic != "P5") throw std::runtime_error("it is no .pgm file (P2 or P5)");
  Heightfield field;
  field.columns = header_number(in);
  field.rows = header_number(in);
  const int white = header_number(in);
  in.get();
  if (field.columns < 2 || field.rows < 2 || field.columns > kMostSamples ||
      field.rows > kMostSamples) {
    throw std::runtime_error("its sides have to be 2 to 2049 samples");
  }
  field.size_x_m = size_m.x();
  field.size_y_m = size_m.y();
  field.height_m.resize(static_cast<std::size_t>(field.columns) *
                        static_cast<std::size_t>(field.rows));
  for (int row = field.rows - 1; row >= 0; --row) {
    for (int column = 0; column < field.columns; ++column) {
      const double value = sample(in, magic == "P2", white > 255);
      if (!in || value < 0 || value > white) throw std::runtime_error("it ends early");
      const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(field.columns) +
                      static_cast<std::size_t>(column);
      field.height_m[at] = size_m.z() * value / white;
    }
  }
  return std::make_shared<const Heightfield>(std::move(field));
}

}  // namespace verp::model
