#pragma once
#include <cstddef>
#include <cstdint>

/// A full-speed USB serial port with one CDC-ACM function. Universal Serial Bus 2.0 (chapter 9),
/// CDC 1.2 and PSTN 1.2 (USB-IF class documents).
namespace verp::hal::usb {

/// pid.codes' test ids, for private testing only. A product needs its own.
inline constexpr std::uint16_t kVendorId = 0x1209, kProductId = 0x0001;
inline constexpr std::uint16_t kDeviceRelease = 0x0100;  ///< bcdDevice: 1.0

inline constexpr std::uint8_t kControlPacket = 64, kBulkPacket = 64, kNotificationPacket = 16;
inline constexpr std::uint8_t kDataOut = 0x01, kDataIn = 0x81, kNotification = 0x82;
inline constexpr std::uint8_t kControlInterface = 0, kDataInterface = 1, kInterfaces = 2;
inline constexpr std::uint8_t kOnlyConfiguration = 1;

/// USB 2.0 table 9-5.
enum class Descriptor : std::uint8_t {
  kDevice = 1,
  kConfiguration = 2,
  kString = 3,
  kInterface = 4,
  kEndpoint = 5,
  kClassInterface = 0x24,  ///< CDC 1.2 table 12
};
/// Indices in the device descriptor.
enum class String : std::uint8_t { kLanguages = 0, kMaker = 1, kProduct = 2, kSerial = 3 };

constexpr std::uint8_t low(std::uint16_t value) {
  return static_cast<std::uint8_t>(value);
}
constexpr std::uint8_t high(std::uint16_t value) {
  return static_cast<std::uint8_t>(value >> 8);
}
constexpr std::uint8_t type(Descriptor descriptor) {
  return static_cast<std::uint8_t>(descriptor);
}

/// USB 2.0 table 9-8.
inline constexpr std::uint8_t kDeviceDescriptor[] = {
    18,
    type(Descriptor::kDevice),
    0x00,  // bcdUSB: 2.0
    0x02,
    0x02,  // bDeviceClass: communications
    0,
    0,
    kControlPacket,
    low(kVendorId),
    high(kVendorId),
    low(kProductId),
    high(kProductId),
    low(kDeviceRelease),
    high(kDeviceRelease),
    static_cast<std::uint8_t>(String::kMaker),
    static_cast<std::uint8_t>(String::kProduct),
    static_cast<std::uint8_t>(String::kSerial),
    1,  // bNumConfigurations
};

inline constexpr std::uint8_t kConfigurationBytes = 67;
/// USB 2.0 tables 9-10, 9-12, 9-13; CDC 1.2 tables 15 and 16; PSTN 1.2 tables 3 and 4. Bus-powered
/// with 500 mA at most.
inline constexpr std::uint8_t kConfigurationDescriptor[] = {
    // Configuration.
    9, type(Descriptor::kConfiguration), kConfigurationBytes, 0, kInterfaces, kOnlyConfiguration, 0,
    0x80,  // bmAttributes: bit 7 is always set
    250,   // bMaxPower: unit 2 mA
    // Control interface: abstract control model. No protocol, so the host does not probe a
    // modem.
    9, type(Descriptor::kInterface), kControlInterface, 0, 1, 0x02, 0x02, 0x00, 0,
    // Header: CDC 1.10.
    5, type(Descriptor::kClassInterface), 0x00, 0x10, 0x01,
    // Call management: none.
    5, type(Descriptor::kClassInterface), 0x01, 0x00, kDataInterface,
    // Abstract control model: line coding and control line state, break.
    4, type(Descriptor::kClassInterface), 0x02, 0x06,
    // Union.
    5, type(Descriptor::kClassInterface), 0x06, kControlInterface, kDataInterface,
    // Notifications: required; nothing is ever sent.
    7, type(Descriptor::kEndpoint), kNotification, 0x03, kNotificationPacket, 0, 255,
    // The data interface and its bulk endpoints.
    9, type(Descriptor::kInterface), kDataInterface, 0, 2, 0x0A, 0x00, 0x00, 0,  //
    7, type(Descriptor::kEndpoint), kDataOut, 0x02, kBulkPacket, 0, 0,           //
    7, type(Descriptor::kEndpoint), kDataIn, 0x02, kBulkPacket, 0, 0};
static_assert(sizeof kDeviceDescriptor == kDeviceDescriptor[0]);
static_assert(sizeof kConfigurationDescriptor == kConfigurationBytes);

inline constexpr const char* kMaker = "VERP";
inline constexpr std::uint16_t kEnglish = 0x0409;  ///< United States (USB-IF, LANGIDs)

/// The serial string shows it as 24 hexadecimal digits.
inline constexpr std::size_t kSerialBytes = 12;
/// A string descriptor: two bytes, then UTF-16 units.
inline constexpr std::size_t kStringUnits = 2 * kSerialBytes;
inline constexpr std::size_t kStringBytes = 2 + 2 * kStringUnits;

}  // namespace verp::hal::usb
