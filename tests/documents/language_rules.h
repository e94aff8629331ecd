// Rules of language for comments, help, messages and documents that a program can check.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/documents/source_text.h"

namespace arthro::test {

struct LanguageFault {
  int line = 0;      // from 1
  std::string what;  // the rule that is broken, with the words that break it
};

enum class TextKind {
  kSource,   // C++ or GLSL: comments; the words of literals
  kProduct,  // source of the program: also the length of sentences in literals
  kScript,   // CMake list or shell script: comments
  kDocument  // Markdown: words
};

std::vector<LanguageFault> LanguageFaults(std::string_view text, TextKind kind);

struct FileFaults {
  std::filesystem::path file;  // from the root
  std::vector<LanguageFault> faults;
};

// Faults of every text of the repository; files without any are left out. The tests and the table
// of the rules themselves, which must show what is refused, are not read.
std::vector<FileFaults> RepositoryLanguageFaults(const std::filesystem::path& root);

}  // namespace arthro::test
