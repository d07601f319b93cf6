#include <fmt/format.h>

#include <iterator>

#include "common/protocol/canopen/pdo.hpp"
#include "host/twin/eds/eds.hpp"

namespace verp::eds {
namespace {

using Out = std::back_insert_iterator<std::string>;

// CiA 306 requires a date; files are regenerated, so it is the first version's.
constexpr const char* kDate = "11-21-2026";
constexpr const char* kTime = "12:00AM";
constexpr struct {
  int kbit_s;
  bool supported;  ///< bxCAN cannot make 800; a tick does not fit at slower rates
} kRates[] = {{10, false}, {20, false}, {50, false},  {125, true},
              {250, true}, {500, true}, {800, false}, {1000, true}};

enum ObjectCode { kVar = 7, kArray = 8, kRecord = 9, kDomainCode = 2 };

void put_header(const Description& about, Out out) {
  fmt::format_to(out,
                 "[FileInfo]\nFileName={}\nFileVersion=1\nFileRevision=0\nEDSVersion=4.0\n"
                 "Description={}\nCreationTime={}\nCreationDate={}\nCreatedBy=verp bus eds\n"
                 "ModificationTime={}\nModificationDate={}\nModifiedBy=verp bus eds\n\n",
                 about.file, about.text, kTime, kDate, kTime, kDate);
  fmt::format_to(out,
                 "[DeviceInfo]\nVendorName=VERP\nVendorNumber=0x{:08X}\nProductName={}\n"
                 "ProductNumber=0x{:08X}\nRevisionNumber=0x{:08X}\nOrderCode=\n",
                 about.identity.vendor, about.identity.name, about.identity.product,
                 about.identity.revision);
  for (const auto& rate : kRates) {
    fmt::format_to(out, "BaudRate_{}={}\n", rate.kbit_s, rate.supported ? 1 : 0);
  }
  fmt::format_to(out,
                 "SimpleBootUpMaster={}\nSimpleBootUpSlave={}\nGranularity=8\n"
                 "DynamicChannelsSupported=0\nGroupMessaging=0\nNrOfRXPDO={}\nNrOfTXPDO={}\n"
                 "LSS_Supported=0\n\n[DummyUsage]\n",
                 about.is_master ? 1 : 0, about.is_master ? 0 : 1, about.size.rpdos,
                 about.size.tpdos);
  for (std::uint16_t index = 1; index <= 7; ++index) {
    fmt::format_to(out, "Dummy{:04X}={}\n", index, canopen::dummy_bits({index, 0}) > 0 ? 1 : 0);
  }
  fmt::format_to(out, "\n[Comments]\nLines=0\n\n");
}

bool is_mandatory(std::uint16_t index) {
  return index == 0x1000 || index == 0x1001 || index == 0x1018;
}

template <class Wanted>
void put_list(const Description& about, const char* name, Wanted wanted, Out out) {
  std::string lines;
  int count = 0;
  for (const Object& each : about.objects) {
    if (wanted(each.index)) lines += fmt::format("{}=0x{:04X}\n", ++count, each.index);
  }
  fmt::format_to(out, "[{}]\nSupportedObjects={}\n{}\n", name, count, lines);
}

void put_value(const std::string& section, const Value& value, Out out) {
  const int code = value.type == DataType::kDomain ? kDomainCode : kVar;
  fmt::format_to(out, "[{}]\nParameterName={}\nObjectType=0x{:X}\nDataType=0x{:04X}\n", section,
                 value.name, code, static_cast<unsigned>(value.type));
  if (!value.low.empty()) fmt::format_to(out, "LowLimit={}\n", value.low);
  if (!value.high.empty()) fmt::format_to(out, "HighLimit={}\n", value.high);
  fmt::format_to(out, "AccessType={}\n", value.writable ? "rw" : "ro");
  // A tool may read an empty value as 0.
  if (!value.initial.empty()) fmt::format_to(out, "DefaultValue={}\n", value.initial);
  fmt::format_to(out, "PDOMapping={}\n\n", value.mappable ? 1 : 0);
}

void put_object(const Object& object, Out out) {
  const std::string section = fmt::format("{:X}", object.index);
  if (!object.has_members) return put_value(section, object.values.front(), out);
  const std::size_t count = object.values.size();
  fmt::format_to(out, "[{}]\nParameterName={}\nObjectType=0x{:X}\nSubNumber={}\n\n", section,
                 object.name, object.is_array ? int{kArray} : int{kRecord}, count + 1);
  const std::uint8_t highest =
      object.subindices.empty() ? static_cast<std::uint8_t>(count) : object.subindices.back();
  put_value(section + "sub0",
            {.name = "Highest sub-index supported",
             .writable = object.count_writable,
             .initial = fmt::format("{}", object.count_writable ? object.count_initial : highest)},
            out);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t subindex = object.subindices.empty() ? i + 1 : object.subindices[i];
    put_value(fmt::format("{}sub{:X}", section, subindex), object.values[i], out);
  }
}

}  // namespace

std::span<const Sheet> sheets() {
  static constexpr Sheet kSheets[] = {{"controller", controller, "firmware/app/controller.eds"},
                                      {"drive", drive, "host/twin/can/drive.eds"},
                                      {"imu", imu, "host/twin/can/imu.eds"},
                                      {"foot", foot, "host/twin/can/foot.eds"}};
  return kSheets;
}

std::string to_text(const Description& description) {
  std::string text;
  const Out out = std::back_inserter(text);
  put_header(description, out);
  put_list(description, "MandatoryObjects", is_mandatory, out);
  put_list(
      description, "OptionalObjects",
      [](std::uint16_t index) { return !is_mandatory(index) && !is_manufacturers(index); }, out);
  put_list(description, "ManufacturerObjects", is_manufacturers, out);
  for (const Object& each : description.objects) put_object(each, out);
  return text;
}

}  // namespace verp::eds
