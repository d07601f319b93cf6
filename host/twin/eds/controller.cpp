#include <fmt/format.h>

#include "common/protocol/controller_table.hpp"
#include "firmware/app/controller_objects.hpp"
#include "host/twin/eds/eds.hpp"
#include "host/twin/eds/initials.hpp"

namespace verp::eds {
namespace {

using dxl::controller::Register;
using dxl::controller::Type;

DataType type_of(const Register& each) {
  switch (each.type) {
    case Type::kF32:
      return DataType::kReal32;
    case Type::kText:
      return DataType::kVisibleString;
    default:
      return integer(dxl::controller::type_bytes(each.type), dxl::controller::is_signed(each.type));
  }
}

Value value_of(const Register& each) {
  Value value{.name = each.name,
              .type = type_of(each),
              .writable = each.writable(),
              .mappable = each.type != Type::kText};
  if (!each.writable() || each.type == Type::kF32) return value;
  value.low = fmt::format("{}", each.minimum);
  value.high = each.minimum < 0 ? fmt::format("{}", static_cast<std::int32_t>(each.maximum))
                                : fmt::format("{}", each.maximum);
  return value;
}

Object object_of(const Register& each) {
  Object object{.index = each.object_index(), .name = each.name, .values = {}};
  if (each.count == 1 || each.type == Type::kText) {
    object.values.push_back(value_of(each));
    return object;
  }
  object.has_members = object.is_array = true;
  for (int i = 1; i <= each.count; ++i) {
    Value value = value_of(each);
    value.name = fmt::format("{} {}", each.name, i);
    object.values.push_back(value);
  }
  return object;
}

Object image_object(app::ImageKind kind, const char* name, bool writable) {
  const auto index = static_cast<std::uint16_t>(app::kImageIndex + static_cast<int>(kind));
  return {.index = index,
          .name = name,
          .values = {{.name = name, .type = DataType::kDomain, .writable = writable}}};
}

/// Factory objects of a controller on a bus with room to publish ticks.
struct Fresh {
  explicit Fresh(std::uint8_t node) : objects(application, app::controller_identity(), node) {
    app::publish_ticks(objects, node, true);
  }
  using Application = app::ControllerObjects;
  const Params params{};
  app::OperatorRegisters registers{params, app::OperatorSetup{}, app::no_images};
  Application application{registers, app::no_images};
  canopen::CommunicationObjects<Application, app::kControllerSize> objects;
};

}  // namespace

Description controller() {
  Description description{.file = "controller.eds",
                          .text = "Humanoid robot controller",
                          .identity = app::controller_identity(),
                          .size = app::kControllerSize,
                          .is_master = true,
                          .objects = {}};
  description.objects = communication_objects(description.size, description.identity);
  Fresh node_1(1), node_2(2);
  fill_initials(description.objects, node_1.objects, node_2.objects);
  for (const Register& each : dxl::controller::row::kTable) {
    description.objects.push_back(object_of(each));
  }
  description.objects.push_back(image_object(app::ImageKind::kParams, "Params image", true));
  description.objects.push_back(image_object(app::ImageKind::kActions, "Actions", true));
  description.objects.push_back(image_object(app::ImageKind::kState, "Tick held", false));
  description.objects.push_back(image_object(app::ImageKind::kTicks, "Ticks before", false));
  return description;
}

}  // namespace verp::eds
