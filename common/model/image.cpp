#include "common/model/image.hpp"

#include "common/model/coupling.hpp"

namespace verp {
namespace {

constexpr std::size_t kHeaderSize = sizeof(ImageHeader);

// The gait reads the joints of a leg that has no solver, too. 0 is their default.
bool well_formed_leg(const Params& params, const LegParams& leg) {
  if (leg.solver > LegSolver::kNewton) return false;
  for (int k = 0; k < kLegJoints; ++k) {
    const std::uint8_t joint = leg.joint[k];
    const bool unset = leg.solver == LegSolver::kNone && joint == 0;
    const bool end = k == 0 || k == kLegJoints - 1;
    const bool empty = leg.solver == LegSolver::kNewton && joint == kNoJoint && end;
    if (joint >= params.joint_count && !unset && !empty) return false;
  }
  return true;
}

// Followers come last: each needs a driver and a path to the body.
bool well_formed_place(const Params& params, int joint) {
  const int servos = params.servo_count(), parent = params.joint[joint].parent;
  if (parent > params.joint_count) return false;
  if (joint < servos) return parent <= joint || parent > servos;
  if (model::driver_of(params, joint) == joint) return false;
  int node = joint + 1, steps = 0;
  for (; node != 0 && node <= params.joint_count && steps < kMaxNodes; ++steps) {
    node = params.joint[node - 1].parent;
  }
  return node == 0;
}

// CAN node ids are 1 to 127 and index every table there.
bool well_formed_bus(const Params& params) {
  if (params.bus_protocol == BusProtocol::kDynamixel2 ||
      params.bus_protocol == BusProtocol::kFeetech) {
    return true;
  }
  if (params.bus_protocol != BusProtocol::kCia402) return false;
  constexpr std::uint8_t kMaxNode = 127;
  for (int j = 0; j < params.joint_count; ++j) {
    const std::uint8_t id = params.joint[j].servo_id;
    if (id == 0 || id > kMaxNode) return false;
  }
  if (params.imu.device_id > kMaxNode) return false;
  for (const std::uint8_t id : params.feet.device_id) {
    if (id > kMaxNode) return false;
  }
  return true;
}

}  // namespace

std::uint32_t params_crc(const Params& params) {
  return crc32(&params, sizeof params);
}

void seal_image(ParamsImage& image) {
  __builtin_memcpy(image.header.magic, kImageMagic, sizeof kImageMagic);
  image.header.image_version = kImageVersion;
  image.header.core_version = kCoreVersion;
  image.header.size = sizeof image;
  const auto* bytes = reinterpret_cast<const unsigned char*>(&image);
  image.header.crc32 = crc32(bytes + kHeaderSize, sizeof image - kHeaderSize);
}

ImageFault check_image(const void* bytes, std::size_t size) {
  if (size < kHeaderSize) return ImageFault::kTruncated;
  ImageHeader header;
  __builtin_memcpy(&header, bytes, kHeaderSize);
  for (std::size_t i = 0; i < sizeof kImageMagic; ++i) {
    if (header.magic[i] != kImageMagic[i]) return ImageFault::kNotAnImage;
  }
  if (header.image_version != kImageVersion || header.size != sizeof(ParamsImage)) {
    return ImageFault::kOtherLayout;
  }
  if (size < sizeof(ParamsImage)) return ImageFault::kTruncated;
  const auto* first = static_cast<const unsigned char*>(bytes);
  if (crc32(first + kHeaderSize, sizeof(ParamsImage) - kHeaderSize) != header.crc32) {
    return ImageFault::kDamaged;
  }
  if (header.core_version != kCoreVersion) return ImageFault::kOtherCore;
  const auto* params = reinterpret_cast<const Params*>(first + offsetof(ParamsImage, params));
  if (!is_well_formed(*params)) return ImageFault::kOutOfBounds;
  FieldName bad;
  return numbers_fit(*params, bad) ? ImageFault::kNone : ImageFault::kOutOfRange;
}

bool is_well_formed(const Params& params) {
  if (params.joint_count > kMaxJoints || params.followers > params.joint_count) return false;
  if (params.rise_torque_percent == 0 || params.rise_torque_percent > 100) return false;
  for (int j = 0; j < params.joint_count; ++j) {
    if (params.joint[j].servo_profile >= kServoProfiles || !well_formed_place(params, j)) {
      return false;
    }
  }
  for (const std::uint8_t joint :
       {params.head_pan, params.head_tilt, params.arm[0], params.arm[1]}) {
    if (joint != 0xFF && joint >= params.servo_count()) return false;
  }
  for (const LegParams& leg : params.leg) {
    if (!well_formed_leg(params, leg)) return false;
  }
  return well_formed_bus(params);
}

}  // namespace verp
