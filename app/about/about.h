// Version, commit and libraries of the program, as `arthroscene --version --long` and the Help page
// show them. The build writes the table (CMakeLists.txt).
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace arthro::app {

// A library that the program is linked with or compiled from.
struct BuiltWith {
  const char* name;
  const char* version;  // empty: it states none
  const char* licence;  // SPDX expression
  const char* package;  // Debian package whose copyright file holds the licence's text
};

std::span<const BuiltWith> Libraries();
const char* Version();      // "0.1.0"
std::string ShortCommit();  // 12 digits; empty: built without git and without its archive
// Version, commit, licence, a line per library, and the file with the texts of their licences;
// empty: it is missing.
std::string LongVersion(const std::filesystem::path& licence_texts);

}  // namespace arthro::app
