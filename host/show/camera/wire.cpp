#include "host/show/camera/wire.hpp"

#include <sys/socket.h>

#include <cerrno>
#include <cstring>

namespace verp::camera {
namespace {

class Packer {
 public:
  template <class Number>
  Packer& put(Number value) {
    data_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Packer& text(std::string_view value) {
    put(std::uint64_t{value.size()});
    data_.append(value);
    return *this;
  }
  Packer& vector(const model::Vec3& value) { return put(value.x()).put(value.y()).put(value.z()); }
  Packer& poses(const std::vector<model::Transform>& poses) {
    put(std::uint64_t{poses.size()});
    for (const model::Transform& pose : poses) {
      const Eigen::Matrix<double, 3, 4> rows = pose.matrix().topRows<3>();
      data_.append(reinterpret_cast<const char*>(rows.data()), sizeof(double) * 12);
    }
    return *this;
  }
  std::string take() { return std::move(data_); }

 private:
  std::string data_;
};

/// Gives zeros beyond the end, and whole() is false.
class Unpacker {
 public:
  explicit Unpacker(std::string_view data) : data_(data) {}
  template <class Number>
  Number get() {
    Number value{};
    const std::string_view from = bytes(sizeof value);
    if (good_) std::memcpy(&value, from.data(), sizeof value);
    return value;
  }
  model::Vec3 vector() {
    const auto x = get<double>(), y = get<double>(), z = get<double>();
    return {x, y, z};
  }
  std::string text() { return std::string(bytes(get<std::uint64_t>())); }
  /// A count of items of that size.
  std::uint64_t count(std::size_t size_of_one) {
    const auto count = get<std::uint64_t>();
    good_ = good_ && count <= data_.size() / size_of_one;
    return good_ ? count : 0;
  }
  std::vector<model::Transform> poses() {
    std::vector<model::Transform> out(count(sizeof(double) * 12), model::Transform::Identity());
    for (model::Transform& pose : out) {
      Eigen::Matrix<double, 3, 4> rows = Eigen::Matrix<double, 3, 4>::Zero();
      const std::string_view from = bytes(sizeof(double) * 12);
      if (good_) std::memcpy(rows.data(), from.data(), from.size());
      pose.matrix().topRows<3>() = rows;
    }
    return out;
  }
  bool whole() const { return good_ && data_.empty(); }

 private:
  std::string_view bytes(std::uint64_t size) {
    good_ = good_ && size <= data_.size();
    const std::string_view found = data_.substr(0, good_ ? size : 0);
    data_.remove_prefix(found.size());
    return found;
  }

  std::string_view data_;
  bool good_ = true;
};

/// Increase with each change of the messages.
constexpr std::uint32_t kBuild = 0x63616d03;

struct Head {
  std::uint32_t kind = 0, size = 0;
};

bool send_all(int socket, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t sent = ::send(socket, data, size, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    data += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int socket, char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t got = ::recv(socket, data, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    data += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

void put_moment(const Moment& moment, Packer& out) {
  out.put(moment.time_us).put(moment.robot).put(std::uint8_t{moment.raw});
  out.put(std::uint64_t{moment.cameras.size()});
  for (const std::uint32_t camera : moment.cameras) out.put(camera);
  out.put(std::uint64_t{moment.link_world.size()});
  for (const auto& links : moment.link_world) out.poses(links);
  out.poses(moment.body_world);
}

Moment get_moment(Unpacker& in) {
  Moment moment;
  moment.time_us = in.get<std::uint64_t>();
  moment.robot = in.get<std::uint32_t>();
  moment.raw = in.get<std::uint8_t>() != 0;
  for (auto left = in.count(sizeof(std::uint32_t)); left > 0; --left)
    moment.cameras.push_back(in.get<std::uint32_t>());
  for (auto left = in.count(sizeof(std::uint64_t)); left > 0; --left)
    moment.link_world.push_back(in.poses());
  moment.body_world = in.poses();
  return moment;
}

template <class T>
std::optional<T> if_whole(const Unpacker& in, T&& value) {
  return in.whole() ? std::optional<T>(std::forward<T>(value)) : std::nullopt;
}

}  // namespace

bool send(int socket, Kind kind, std::string_view data) {
  const Head head{static_cast<std::uint32_t>(kind), static_cast<std::uint32_t>(data.size())};
  return send_all(socket, reinterpret_cast<const char*>(&head), sizeof head) &&
         send_all(socket, data.data(), data.size());
}

std::optional<Message> receive(int socket) {
  Head head;
  if (!receive_all(socket, reinterpret_cast<char*>(&head), sizeof head)) return std::nullopt;
  Message message{static_cast<Kind>(head.kind), std::string(head.size, '\0')};
  if (!receive_all(socket, message.data.data(), message.data.size())) return std::nullopt;
  return message;
}

std::string pack(const Stage& stage) {
  Packer out;
  out.put(kBuild).text(stage.world_file).put(std::uint64_t{stage.robots.size()});
  for (const Stage::Robot& robot : stage.robots) out.put(robot.seed).text(robot.file);
  return out.take();
}

std::optional<Stage> unpack_stage(std::string_view data) {
  Unpacker in(data);
  Stage stage;
  if (in.get<std::uint32_t>() != kBuild) return std::nullopt;
  stage.world_file = in.text();
  for (auto left = in.count(2 * sizeof(std::uint64_t)); left > 0; --left) {
    Stage::Robot& robot = stage.robots.emplace_back();
    robot.seed = in.get<std::uint64_t>();
    robot.file = in.text();
  }
  return if_whole(in, std::move(stage));
}

std::string pack(const Moment& moment) {
  Packer out;
  put_moment(moment, out);
  return out.take();
}

std::string pack(const Moment& moment, const Outside& from) {
  Packer out;
  put_moment(moment, out);
  out.text(from.view).vector(from.eye_m).vector(from.target_m).put(from.vertical_fov_rad);
  out.put(from.width).put(from.height);
  out.put(std::uint8_t{from.shadows}).put(std::uint8_t{from.antialias});
  return out.take();
}

std::optional<Moment> unpack_moment(std::string_view data) {
  Unpacker in(data);
  return if_whole(in, get_moment(in));
}

std::optional<std::pair<Moment, Outside>> unpack_outside(std::string_view data) {
  Unpacker in(data);
  std::pair<Moment, Outside> both{get_moment(in), {}};
  Outside& from = both.second;
  from.view = in.text();
  from.eye_m = in.vector();
  from.target_m = in.vector();
  from.vertical_fov_rad = in.get<double>();
  from.width = in.get<std::uint32_t>();
  from.height = in.get<std::uint32_t>();
  from.shadows = in.get<std::uint8_t>() != 0;
  from.antialias = in.get<std::uint8_t>() != 0;
  return if_whole(in, std::move(both));
}

std::string pack(const Picture& picture) {
  Packer out;
  out.put(picture.camera).put(picture.time_us).put(picture.width).put(picture.height);
  out.text(picture.encoding).text(picture.data).put(std::uint64_t{picture.names.size()});
  for (const std::string& name : picture.names) out.text(name);
  return out.take();
}

std::optional<Picture> unpack_picture(std::string_view data) {
  Unpacker in(data);
  Picture picture;
  picture.camera = in.get<std::uint32_t>();
  picture.time_us = in.get<std::uint64_t>();
  picture.width = in.get<std::uint32_t>();
  picture.height = in.get<std::uint32_t>();
  picture.encoding = in.text();
  picture.data = in.text();
  for (auto left = in.count(sizeof(std::uint64_t)); left > 0; --left)
    picture.names.push_back(in.text());
  return if_whole(in, std::move(picture));
}

std::string pack(std::uint64_t number) {
  return Packer().put(number).take();
}

std::optional<std::uint64_t> unpack_number(std::string_view data) {
  Unpacker in(data);
  const auto number = in.get<std::uint64_t>();
  return in.whole() ? std::optional(number) : std::nullopt;
}

}  // namespace verp::camera
