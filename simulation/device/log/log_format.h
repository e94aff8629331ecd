// Bytes of a device log, little-endian, version 5:
//   "ARTHRLOG", u32 version, then blocks to the end of the file
//   block: u32 size of the payload, u32 records in it, u32 CRC-32 of the payload, u32 CRC-32 of the
//          twelve bytes before; payload
// The payload of the first block is JSON, {"version": 5, "sources": [{family, model, serial,
// roles}]}, and its count that of the sources. Other blocks contain records: u8 kind, u8 source,
// u16 size of the body, i64 t_ns, u64 number; then, by kind, the body that Append writes. The last
// block holds a single record, the end. A program that dies while writing leaves no end, and
// perhaps an incomplete block; nothing else is lost. Version 1 has no end, and versions 1 and 2
// have no wishes and no version in their first block. Version 3 has no options, and its wishes no
// camera head, disturbances and mounts. Versions before 5 have no pieces of tissue: a block whose
// count has the bit kPieceBit holds one of them, i64 t_ns and bytes (training/track). A damaged
// piece is left out, since the rest of the log does not depend on it. All versions can be read.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/device/log/log_record.h"

namespace arthro::simulation {

inline constexpr std::uint32_t kLogVersion = 5, kOldestLogVersion = 1;
inline constexpr std::size_t kLargestBlock = 1 << 20;  // bytes of payload

// Appends a record to `payload`; allocates nothing where kLargestRecord more bytes are reserved.
inline constexpr std::size_t kLargestRecord = 512;  // bytes
void Append(const LogRecord& record, std::string& payload);
// Appends a record of an attempt, of at most kLargestBody bytes.
inline constexpr std::size_t kLargestBody = 0xffff;
void AppendBody(LogKind kind, std::int64_t t_ns, std::uint64_t number, std::string_view body,
                std::string& payload);

// Largest piece of tissue, and the bit by which its block is told.
inline constexpr std::size_t kLargestPiece = kLargestBlock - sizeof(std::int64_t);
inline constexpr std::uint32_t kPieceBit = 0x80000000U;

// Return the beginning of a file with its first block, a block, and the block of a piece.
std::string LogHead(std::span<const LogSource> sources, std::uint32_t version = kLogVersion);
std::string LogBlock(std::string_view payload, std::uint32_t records);
std::string PieceBlock(std::int64_t t_ns, std::string_view piece);
// Returns the last block, with the number of pushed records, dropped ones included.
std::string LogEnd(std::uint64_t pushed);

// Record of an attempt; `begin` and `size` tell its bytes in DeviceLogContent::bodies.
struct LoggedBody {
  LogKind kind = LogKind::kFrame;
  std::int64_t t_ns = 0;
  std::size_t begin = 0, size = 0;
};

struct DeviceLogContent {
  std::vector<LogSource> sources;
  std::vector<LoggedBody> attempt;  // in the order of the file
  std::vector<LoggedBody> pieces;   // pieces of tissue, in the order of the file
  long damaged_pieces = 0;          // left out
  std::string bodies;
  std::vector<LogRecord> records;  // in order of time, without the end
  // Number of records that were dropped while recording; without an end, a lower bound.
  long missing = 0;
  // A sentence about a missing end; empty where the log is complete, as far as its version shows.
  std::string torn;
};

// Returns true for bytes that begin as a log.
bool IsDeviceLog(std::string_view bytes) noexcept;

// Reads a log. Where the recording was cut short (its last block is incomplete, the rest is zeros,
// or it has no end) the complete blocks are returned, and `torn` is set. Throws Error(kBadData) for
// other data, another version, or damage in the middle.
DeviceLogContent ParseDeviceLog(std::string_view bytes, const std::filesystem::path& file = {});
DeviceLogContent ReadDeviceLog(const std::filesystem::path& file);

}  // namespace arthro::simulation
