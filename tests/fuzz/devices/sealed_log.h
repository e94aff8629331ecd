// A whole log of devices around the records that a fuzz input holds.
#pragma once

#include <string>
#include <string_view>

#include "simulation/device/log/log_format.h"

namespace arthro::test {

// Bytes that begin as a log stay as they are. Otherwise the first byte is the number of records in
// the block that follows, which gets its checksums, between the head and the end of a log of one
// WoodenHaptics.
inline std::string SealedLog(std::string_view bytes) {
  using namespace simulation;
  if (bytes.empty() || IsDeviceLog(bytes)) return std::string(bytes);
  const LogSource source{
      "wooden_haptics", "woodenhaptics", "1", {DeviceRole::kInstrument, std::nullopt}};
  const auto count = static_cast<unsigned char>(bytes.front());
  return LogHead({&source, 1}) + LogBlock(bytes.substr(1), count) + LogEnd(count);
}

}  // namespace arthro::test
