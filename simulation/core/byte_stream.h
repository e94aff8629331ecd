// Values and numbers of variable length in strings of bytes, little-endian, for formats of our own.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace arthro {

template <class T>
void PutBytes(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Takes a value from the front. Returns false where there are too few bytes.
template <class T>
bool TakeBytes(std::string_view& bytes, T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (bytes.size() < sizeof value) return false;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return true;
}

// Small numbers of both signs take one byte: 0, −1, 1, −2, … in groups of seven bits.
inline void PutSmall(std::string& bytes, std::int32_t value) {
  auto rest = (static_cast<std::uint32_t>(value) << 1U) ^ static_cast<std::uint32_t>(value >> 31);
  for (; rest >= 0x80U; rest >>= 7U) bytes.push_back(static_cast<char>(rest | 0x80U));
  bytes.push_back(static_cast<char>(rest));
}

// Returns false where there are too few bytes, or the number is too long.
inline bool TakeSmall(std::string_view& bytes, std::int32_t& value) {
  std::uint32_t rest = 0;
  for (unsigned shift = 0; shift < 35; shift += 7) {
    std::uint8_t group = 0;
    if (!TakeBytes(bytes, group)) return false;
    rest |= static_cast<std::uint32_t>(group & 0x7fU) << shift;
    if (group >= 0x80U) continue;
    value = static_cast<std::int32_t>((rest >> 1U) ^ (0U - (rest & 1U)));
    return true;
  }
  return false;
}

}  // namespace arthro
