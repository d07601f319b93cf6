#include "common/protocol/canopen/dictionary.hpp"

namespace verp::canopen {
namespace {

struct AbortText {
  Abort abort;
  const char* text;
};

constexpr AbortText kTexts[] = {
    {Abort::kNone, "none"},
    {Abort::kToggle, "toggle bit did not alternate"},
    {Abort::kTimeout, "timeout"},
    {Abort::kCommand, "unknown or unexpected command"},
    {Abort::kBlockSize, "invalid block size"},
    {Abort::kSequence, "invalid sequence number"},
    {Abort::kCrc, "wrong CRC"},
    {Abort::kOutOfMemory, "out of memory"},
    {Abort::kUnsupportedAccess, "access not supported"},
    {Abort::kWriteOnly, "write only"},
    {Abort::kReadOnly, "read only"},
    {Abort::kNoObject, "no such object"},
    {Abort::kNotMappable, "cannot be mapped to a PDO"},
    {Abort::kPdoLength, "mapped objects exceed the PDO"},
    {Abort::kIncompatibleParameter, "parameters do not go together"},
    {Abort::kIncompatibleDevice, "incompatible inside the device"},
    {Abort::kHardware, "hardware error"},
    {Abort::kLength, "wrong length"},
    {Abort::kTooLong, "too long"},
    {Abort::kTooShort, "too short"},
    {Abort::kNoSubindex, "no such subindex"},
    {Abort::kValueRange, "value not allowed"},
    {Abort::kValueTooHigh, "value too high"},
    {Abort::kValueTooLow, "value too low"},
    {Abort::kMaxBelowMin, "maximum below minimum"},
    {Abort::kNoConnection, "no SDO connection"},
    {Abort::kGeneral, "general error"},
    {Abort::kCannotStore, "cannot be stored"},
    {Abort::kLocalControl, "under local control"},
    {Abort::kDeviceState, "not in this device state"},
    {Abort::kNoDictionary, "no object dictionary"},
    {Abort::kNoData, "no data"},
};

}  // namespace

const char* abort_text(Abort abort) {
  for (const AbortText& each : kTexts) {
    if (each.abort == abort) return each.text;
  }
  return "unknown abort code";
}

}  // namespace verp::canopen
