// SHA-256 of bytes [FIPS 180-4, Secure Hash Standard, doi 10.6028/NIST.FIPS.180-4], where a
// fingerprint (fingerprint.h) is too weak: records name an exercise by it.
#pragma once

#include <string>
#include <string_view>

namespace arthro {

// 64 hexadecimal digits, lower case.
std::string Sha256(std::string_view bytes);

}  // namespace arthro
