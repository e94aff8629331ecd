#include "simulation/training/track/deflated.h"

#include <cstdint>
#include <zlib.h>

#include "simulation/core/byte_stream.h"

namespace arthro::simulation {
namespace {

constexpr int kLevel = 6;  // the usual one
// Largest ratio that deflate can reach [zlib.net, Technical Details]. More is not reserved.
constexpr std::size_t kMostRatio = 1032;

const Bytef* BytesOf(std::string_view bytes) {
  return reinterpret_cast<const Bytef*>(bytes.data());
}

}  // namespace

std::string Deflated(std::string_view raw) {
  uLongf size = compressBound(static_cast<uLong>(raw.size()));
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size, BytesOf(raw),
            static_cast<uLong>(raw.size()), kLevel);
  packed.resize(size);
  std::string bytes;
  bytes.reserve(sizeof(std::uint32_t) + packed.size());
  PutBytes(bytes, static_cast<std::uint32_t>(raw.size()));
  return bytes.append(packed);
}

std::optional<std::string> Inflated(std::string_view bytes) {
  std::uint32_t size = 0;
  if (!TakeBytes(bytes, size) || size > kMostRatio * (bytes.size() + 1)) return std::nullopt;
  std::string raw(size, '\0');
  uLongf written = size;
  const int result = uncompress(reinterpret_cast<Bytef*>(raw.data()), &written, BytesOf(bytes),
                                static_cast<uLong>(bytes.size()));
  if (result != Z_OK || written != size) return std::nullopt;
  return raw;
}

}  // namespace arthro::simulation
