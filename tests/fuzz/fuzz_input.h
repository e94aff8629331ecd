// Parts that all fuzz targets share. A target gives its bytes to one reader. An arthro::Error is a
// good end. Everything else ends the program and is a finding: another exception, a message that is
// no printable line, a value that cannot be read back after it was written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "simulation/core/error.h"

namespace arthro::test {

inline std::string_view TextOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Throws std::logic_error with the claim.
void Require(bool holds, const char* claim);
// The message of a refusal is one line that a terminal shows as it is, of a length for a person.
void RequireSentence(const Error& error);

// Calls a reader. Returns 0, as libFuzzer wants it from a target.
template <class Read>
int Refuses(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    RequireSentence(error);
  }
  return 0;
}

// A folder of this process, which is removed at its end. Temporary folders of the readers lie in
// it.
const std::filesystem::path& PrivateFolder();

// The bytes as a file of this name in the private folder, for a reader that takes files only. The
// next call with the same name replaces it.
std::filesystem::path InputFile(const char* name, std::string_view bytes);

}  // namespace arthro::test
