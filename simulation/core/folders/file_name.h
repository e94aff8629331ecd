// File names from words that a person wrote.
#pragma once

#include <cctype>
#include <string>

namespace arthro {

// Returns a name in lower case with single dashes: "Medial meniscus" gives "medial-meniscus". Words
// without a letter or digit give `otherwise`.
inline std::string FileNameFrom(const std::string& words, const std::string& otherwise) {
  std::string name;
  for (const unsigned char letter : words) {
    if (std::isalnum(letter))
      name += static_cast<char>(std::tolower(letter));
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? otherwise : name;
}

}  // namespace arthro
