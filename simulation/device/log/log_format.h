// A device log as bytes, little-endian, version 2:
//   "ARTHRLOG", u32 version, then blocks to the end of the file
//   block: u32 size of the payload, u32 records in it, u32 CRC-32 of the payload, u32 CRC-32 of the
//          twelve bytes before; payload
// The first block's payload is JSON, {"sources": [{family, model, serial, roles}]}, its count that
// of the sources. Of the others it is records: u8 kind, u8 source, u16 size of what follows the
// head, i64 t_ns, u64 number; then, by kind, what Append writes. The last block holds one record
// alone, the end. Whoever dies while it writes leaves none, and perhaps a block that is not whole;
// nothing else is lost. Version 1 has no end, and is read.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/device/log/log_record.h"

namespace arthro::simulation {

inline constexpr std::uint32_t kLogVersion = 2, kOldestLogVersion = 1;
inline constexpr std::size_t kLargestBlock = 1 << 20;  // bytes of payload

// Appends to `payload`; allocates nothing where there is room for kLargestRecord more.
inline constexpr std::size_t kLargestRecord = 512;  // bytes
void Append(const LogRecord& record, std::string& payload);

// The beginning of a file, the first block with it; and a block.
std::string LogHead(std::span<const LogSource> sources, std::uint32_t version = kLogVersion);
std::string LogBlock(std::string_view payload, std::uint32_t records);
// The last block: so many records were pushed, what was dropped included.
std::string LogEnd(std::uint64_t pushed);

struct DeviceLogContent {
  std::vector<LogSource> sources;
  std::vector<LogRecord> records;  // in the order of time, without the end
  // That were dropped when it was recorded; where there is no end, those that can be seen to be.
  long missing = 0;
  // Empty: it is whole, as far as its version can tell. Else what became of its end, in words.
  std::string torn;
};

// Whether these bytes begin as a log does.
bool IsDeviceLog(std::string_view bytes) noexcept;

// Where a recording was cut short (the machine went off: its last block is not whole, the rest is
// zeros, or it has no end) what is whole before is given, and `torn` says so. Throws
// Error(kBadData): no log, another version, damaged in the middle.
DeviceLogContent ParseDeviceLog(std::string_view bytes, const std::filesystem::path& file = {});
DeviceLogContent ReadDeviceLog(const std::filesystem::path& file);

}  // namespace arthro::simulation
