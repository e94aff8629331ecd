// A short text that tells whether bytes are the same as before. It is no protection against a
// person who forges bytes on purpose: 64 bits of hash and the size.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace arthro {

// "SIZE-HASH", for example "1024-00f3a9c1d2e4b567". The same on every machine of one byte order.
std::string FingerprintOf(std::string_view bytes);

}  // namespace arthro
