#pragma once
#include <cstddef>
#include <cstdint>

#include "hal/chip/usb/descriptors.hpp"

/// A USB serial port's answers to requests at its control endpoint (USB 2.0 chapter 9; PSTN 1.2,
/// 6.3). A chip's driver moves the packets.
namespace verp::hal::usb {

/// The device controller's task before the status stage.
enum class Action : std::uint8_t {
  kNone,
  kAddress,    ///< answer at address `value` from the status stage on
  kConfigure,  ///< 0: endpoints off; else on, empty, DATA0 next
  kHalt,       ///< endpoint `value` answers STALL
  kRelease,    ///< no more STALL; DATA0 next
};

enum class Stage : std::uint8_t {
  kStall,
  kSend,     ///< send `size` bytes of `data` in packets of kControlPacket
  kReceive,  ///< `size` bytes go to received()
  kDone,     ///< no data: status stage
};

struct Answer {
  Stage stage = Stage::kStall;
  std::uint16_t size = 0;
  /// kSend: the host asked for more, so a short or empty packet must mark the end.
  bool shorter = false;
  Action action = Action::kNone;
  std::uint8_t value = 0;
  const std::uint8_t* data = nullptr;  ///< valid until the next setup()
};

/// PSTN 1.2 table 17. Only stored and returned: there is no wire.
struct LineCoding {
  std::uint32_t baud = 1'000'000;
  std::uint8_t stop_bits = 0;  ///< 0: 1, 1: 1.5, 2: 2
  std::uint8_t parity = 0;     ///< 0 none, 1 odd, 2 even, 3 mark, 4 space
  std::uint8_t data_bits = 8;
};

class CdcAcm {
 public:
  static constexpr std::size_t kSetupBytes = 8;
  struct Endpoint {
    std::uint8_t address;
    std::uint8_t type;  ///< USB 2.0 table 9-13: 2 bulk, 3 interrupt
    std::uint8_t packet;
  };
  static constexpr Endpoint kEndpoints[] = {{kDataOut, 2, kBulkPacket},
                                            {kDataIn, 2, kBulkPacket},
                                            {kNotification, 3, kNotificationPacket}};

  /// `product` must outlive this; its first kStringUnits ASCII characters are shown.
  CdcAcm(const char* product, const std::uint8_t (&serial)[kSerialBytes]) : product_(product) {
    for (std::size_t i = 0; i < kSerialBytes; ++i) serial_[i] = serial[i];
  }

  /// Call after a bus reset or disconnection.
  void reset() {
    configure(0);
    address_ = 0;
  }

  Answer setup(const std::uint8_t (&bytes)[kSetupBytes]) {
    const Request request = {
        .code = static_cast<std::uint16_t>(bytes[0] << 8 | bytes[1]),
        .value = static_cast<std::uint16_t>(bytes[2] | bytes[3] << 8),
        .index = static_cast<std::uint16_t>(bytes[4] | bytes[5] << 8),
        .length = static_cast<std::uint16_t>(bytes[6] | bytes[7] << 8),
    };
    const bool in = (bytes[0] & kIn) != 0;
    return in ? ask(request) : tell(request);
  }

  /// Takes the data that the last setup() requested. False: refuse with STALL.
  bool received(const std::uint8_t* data, std::size_t size) {
    if (size != kLineCodingBytes) return false;
    LineCoding coding;
    coding.baud = static_cast<std::uint32_t>(data[0]) | static_cast<std::uint32_t>(data[1]) << 8 |
                  static_cast<std::uint32_t>(data[2]) << 16 |
                  static_cast<std::uint32_t>(data[3]) << 24;
    coding.stop_bits = data[4];
    coding.parity = data[5];
    coding.data_bits = data[6];
    const bool known = coding.stop_bits <= 2 && coding.parity <= 4 &&
                       ((coding.data_bits >= 5 && coding.data_bits <= 8) || coding.data_bits == 16);
    if (known) coding_ = coding;
    return known;
  }

  bool configured() const { return configuration_ != 0; }
  /// A host program has the port open: it asserts DTR.
  bool opened() const { return configured() && (lines_ & kDtr) != 0; }
  std::uint8_t address() const { return address_; }
  bool halted(std::uint8_t endpoint) const { return (halted_ & bit_of(endpoint)) != 0; }
  const LineCoding& coding() const { return coding_; }
  /// Breaks that the host requested, modulo 2^32.
  std::uint32_t breaks() const { return breaks_; }

 private:
  static constexpr std::uint8_t kIn = 0x80;
  static constexpr std::uint16_t kDtr = 1;
  static constexpr std::uint16_t kEndpointHalt = 0;  // USB 2.0 table 9-6
  static constexpr std::size_t kLineCodingBytes = 7;

  struct Request {
    std::uint16_t code;  ///< bmRequestType, bRequest
    std::uint16_t value;
    std::uint16_t index;
    std::uint16_t length;
  };
  /// USB 2.0 table 9-3, PSTN 1.2 table 13.
  enum Code : std::uint16_t {
    kGetDeviceStatus = 0x8000,
    kGetInterfaceStatus = 0x8100,
    kGetEndpointStatus = 0x8200,
    kClearEndpointFeature = 0x0201,
    kSetEndpointFeature = 0x0203,
    kSetAddress = 0x0005,
    kGetDescriptor = 0x8006,
    kGetConfiguration = 0x8008,
    kSetConfiguration = 0x0009,
    kGetInterface = 0x810A,
    kSetLineCoding = 0x2120,
    kGetLineCoding = 0xA121,
    kSetControlLineState = 0x2122,
    kSendBreak = 0x2123,
  };

  Answer ask(const Request& request) {
    switch (request.code) {
      case kGetDescriptor:
        return describe(request);
      case kGetConfiguration:
        return send_word(request, configuration_, 1);
      case kGetDeviceStatus:  // bus-powered, no remote wake-up
        return request.index == 0 ? send_word(request, 0, 2) : Answer{};
      case kGetInterfaceStatus:
        return has_interface(request.index) ? send_word(request, 0, 2) : Answer{};
      case kGetInterface:  // no alternate settings: always 0
        return has_interface(request.index) ? send_word(request, 0, 1) : Answer{};
      case kGetEndpointStatus:
        return endpoint_status(request);
      case kGetLineCoding:
        return is_for_port(request) ? send_coding(request) : Answer{};
      default:
        return {};
    }
  }

  Answer tell(const Request& request) {
    if (request.code == kSetLineCoding) {
      if (!is_for_port(request) || request.length != kLineCodingBytes) return {};
      return {.stage = Stage::kReceive, .size = kLineCodingBytes};
    }
    if (request.length != 0) return {};
    switch (request.code) {
      case kSetAddress:
        return set_address(request);
      case kSetConfiguration:
        return set_configuration(request);
      case kSetEndpointFeature:
        return halt(request, true);
      case kClearEndpointFeature:
        return halt(request, false);
      case kSetControlLineState:
        if (!is_for_port(request)) return {};
        lines_ = request.value;
        return {.stage = Stage::kDone};
      case kSendBreak:
        if (!is_for_port(request)) return {};
        if (request.value != 0) ++breaks_;  // 0 ends a break
        return {.stage = Stage::kDone};
      default:
        return {};
    }
  }

  static Answer send(const Request& request, const std::uint8_t* data, std::size_t size) {
    if (request.length == 0) return {.stage = Stage::kDone};
    const bool shorter = size < request.length;
    return {.stage = Stage::kSend,
            .size = shorter ? static_cast<std::uint16_t>(size) : request.length,
            .shorter = shorter,
            .data = data};
  }
  Answer send_word(const Request& request, std::uint16_t word, std::size_t size) {
    if (request.value != 0) return {};
    reply_[0] = low(word);
    reply_[1] = high(word);
    return send(request, reply_, size);
  }
  Answer send_coding(const Request& request) {
    if (request.value != 0) return {};
    for (unsigned i = 0; i < 4; ++i) reply_[i] = static_cast<std::uint8_t>(coding_.baud >> 8 * i);
    reply_[4] = coding_.stop_bits;
    reply_[5] = coding_.parity;
    reply_[6] = coding_.data_bits;
    return send(request, reply_, kLineCodingBytes);
  }

  Answer describe(const Request& request) {
    switch (static_cast<Descriptor>(high(request.value))) {
      case Descriptor::kDevice:
        return send_only(request, kDeviceDescriptor, sizeof kDeviceDescriptor);
      case Descriptor::kConfiguration:
        return send_only(request, kConfigurationDescriptor, sizeof kConfigurationDescriptor);
      case Descriptor::kString:
        return describe_string(request);
      default:  // a full-speed-only device has no qualifier (USB 2.0, 9.6.2)
        return {};
    }
  }
  static Answer send_only(const Request& request, const std::uint8_t* data, std::size_t size) {
    return low(request.value) == 0 ? send(request, data, size) : Answer{};
  }
  Answer describe_string(const Request& request) {
    constexpr char kDigits[] = "0123456789ABCDEF";
    std::size_t units = 0;
    const auto add = [&](std::uint16_t unit) {
      reply_[2 + 2 * units] = low(unit);
      reply_[3 + 2 * units] = high(unit);
      ++units;
    };
    const auto add_text = [&](const char* text) {
      while (*text != 0 && units < kStringUnits) add(static_cast<std::uint8_t>(*text++));
    };
    switch (static_cast<String>(low(request.value))) {
      case String::kLanguages:
        add(kEnglish);
        break;
      case String::kMaker:
        add_text(kMaker);
        break;
      case String::kProduct:
        add_text(product_);
        break;
      case String::kSerial:
        for (const std::uint8_t byte : serial_) {
          add(static_cast<std::uint8_t>(kDigits[byte >> 4]));
          add(static_cast<std::uint8_t>(kDigits[byte & 15]));
        }
        break;
      default:
        return {};
    }
    reply_[0] = static_cast<std::uint8_t>(2 + 2 * units);
    reply_[1] = type(Descriptor::kString);
    return send(request, reply_, reply_[0]);
  }

  Answer endpoint_status(const Request& request) {
    const std::uint8_t endpoint = low(request.index);
    if (high(request.index) != 0) return {};
    const bool control = (endpoint & ~kIn) == 0;
    if (!control && !has_endpoint(endpoint)) return {};
    return send_word(request, halted(endpoint) ? 1 : 0, 2);
  }

  Answer set_address(const Request& request) {
    if (request.value > 127 || request.index != 0 || configured()) return {};
    address_ = low(request.value);
    return {.stage = Stage::kDone, .action = Action::kAddress, .value = address_};
  }
  Answer set_configuration(const Request& request) {
    if (request.value > kOnlyConfiguration || request.index != 0) return {};
    configure(low(request.value));
    return {.stage = Stage::kDone, .action = Action::kConfigure, .value = configuration_};
  }
  /// A new configuration clears halts and line state.
  void configure(std::uint8_t configuration) {
    configuration_ = configuration;
    halted_ = 0;
    lines_ = 0;
  }
  Answer halt(const Request& request, bool yes) {
    const std::uint8_t endpoint = low(request.index);
    if (request.value != kEndpointHalt || high(request.index) != 0 || !has_endpoint(endpoint)) {
      return {};
    }
    const std::uint8_t mask = bit_of(endpoint);
    halted_ = static_cast<std::uint8_t>(yes ? halted_ | mask : halted_ & ~mask);
    return {
        .stage = Stage::kDone, .action = yes ? Action::kHalt : Action::kRelease, .value = endpoint};
  }

  bool has_interface(std::uint16_t index) const { return configured() && index < kInterfaces; }
  bool has_endpoint(std::uint8_t endpoint) const { return configured() && bit_of(endpoint) != 0; }
  bool is_for_port(const Request& request) const {
    return configured() && request.index == kControlInterface;
  }
  static constexpr std::uint8_t bit_of(std::uint8_t endpoint) {
    return endpoint == kDataOut ? 1 : endpoint == kDataIn ? 2 : endpoint == kNotification ? 4 : 0;
  }

  const char* product_;
  std::uint8_t serial_[kSerialBytes];
  std::uint8_t address_ = 0;
  std::uint8_t configuration_ = 0;
  std::uint8_t halted_ = 0;
  std::uint16_t lines_ = 0;  ///< DTR, RTS
  LineCoding coding_;
  std::uint32_t breaks_ = 0;
  std::uint8_t reply_[kStringBytes] = {};
};

}  // namespace verp::hal::usb
