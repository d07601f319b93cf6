#include "host/show/camera/painter.hpp"

#include <cerrno>
#include <optional>
#include <utility>

namespace verp::camera {

std::vector<Picture> Painter::look(const Moment& moment) {
  return ask(Kind::kMoment, pack(moment));
}

Picture Painter::look(const Moment& moment, const Outside& from) {
  std::vector<Picture> pictures = ask(Kind::kOutside, pack(moment, from));
  if (pictures.size() != 1) fail();
  return std::move(pictures.front());
}

std::vector<Picture> Painter::ask(Kind kind, std::string_view data) {
  if (program_ == nullptr) throw CameraError("cameras: their program has ended");
  std::vector<Picture> pictures;
  errno = 0;
  if (!send(program_->socket(), kind, data)) fail();
  while (const std::optional<Message> message = receive(program_->socket())) {
    if (message->kind == Kind::kDone) return pictures;
    if (message->kind == Kind::kRefused) throw std::invalid_argument(message->data);
    if (message->kind == Kind::kFailed) {
      program_.reset();
      throw CameraError("cameras: " + message->data);
    }
    auto picture = unpack_picture(message->data);
    if (message->kind != Kind::kPicture || !picture) break;
    pictures.push_back(std::move(*picture));
    errno = 0;
  }
  fail();
}

void Painter::fail() {
  const std::unique_ptr<DrawingProgram> program = std::move(program_);
  throw CameraError("cameras: " + program->end());
}

}  // namespace verp::camera
