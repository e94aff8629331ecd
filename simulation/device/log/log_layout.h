// Layout of a device log, shared by its writer (log_format.cpp) and its reader (log_parse.cpp);
// log_format.h describes it. Not for others.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <zlib.h>

namespace arthro::simulation {

static_assert(std::endian::native == std::endian::little);

inline constexpr std::string_view kLogMagic = "ARTHRLOG";
inline constexpr std::size_t kBlockHead = 16, kRecordHead = 20;  // bytes
// First versions: the checksum of the head covers the version; wishes are complete; there are
// pieces of tissue.
inline constexpr std::uint32_t kVersionInHead = 3, kCompleteWishes = 4, kHasPieces = 5;

inline std::uint32_t Checksum(std::string_view bytes) noexcept {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

}  // namespace arthro::simulation
