// Words that begin a sentence of their own.
#pragma once

#include <string>
#include <utility>

namespace arthro::app {

// `words` with a capital; a first letter that is not ASCII stays.
inline std::string Capital(std::string words) {
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z')
    words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

}  // namespace arthro::app
