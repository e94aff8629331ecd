// Damages a file's bytes by a seed, in the ways that a disk, a transfer, a careless edit or an
// attacker does.
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace arthro::test {

enum class FileFormat { kBinary, kPng, kText, kJson, kXml };

struct Mutation {
  std::string bytes;
  std::string what;  // description of the change, for a report
};

// The same seed and bytes give the same mutation.
Mutation Mutate(const std::string& bytes, FileFormat format, std::uint64_t seed);

}  // namespace arthro::test
