#include "simulation/core/fingerprint.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <fmt/format.h>

namespace arthro {

// Multiply and rotate over words of 8 bytes, then the finalizer of MurmurHash3 (A. Appleby, public
// domain): about 3 GB/s, so that a depth map of 40 MB costs some 15 ms.
std::string FingerprintOf(std::string_view bytes) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15u;
  std::uint64_t hash = kOdd ^ bytes.size();
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min(sizeof word, bytes.size() - at));
    hash = std::rotl((hash ^ word) * kOdd, 29);
  }
  hash ^= hash >> 33;
  hash *= 0xff51afd7ed558ccdu;
  hash ^= hash >> 33;
  hash *= 0xc4ceb9fe1a85ec53u;
  hash ^= hash >> 33;
  return fmt::format("{}-{:016x}", bytes.size(), hash);
}

}  // namespace arthro
