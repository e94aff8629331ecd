// Words and numbers of a text file, with the line they stand on for the sentence of a fault.
// Independent of the locale.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro {

class TextScanner {
 public:
  TextScanner(std::string_view text, const std::filesystem::path& file)
      : rest_(text), file_(file) {}

  // Next line without its end; false at the end of the text.
  bool NextLine(std::string_view* line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find('\n');
    *line = rest_.substr(0, end);
    rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + 1);
    ++line_;
    if (line->ends_with('\r')) line->remove_suffix(1);
    return true;
  }

  // Cuts the next word off a line; empty when there is none.
  static std::string_view TakeWord(std::string_view* line) {
    const std::size_t begin = line->find_first_not_of(" \t\r");
    if (begin == line->npos) return *line = {};
    const std::size_t end = std::min(line->find_first_of(" \t\r", begin), line->size());
    const std::string_view word = line->substr(begin, end - begin);
    line->remove_prefix(end);
    return word;
  }

  double TakeDouble(std::string_view* line) const {
    std::string_view word = TakeWord(line);
    const std::string_view whole = word;
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault == std::errc::result_out_of_range)  // infinity is refused where numbers are checked
      return word.find("e-") != word.npos || word.find("E-") != word.npos ? 0.0 : HUGE_VAL;
    if (fault != std::errc{} || end != word.data() + word.size())
      Refuse(whole.empty() ? "a number is missing"
                           : fmt::format("\"{}\" is not a number", whole.substr(0, 40)));
    return value;
  }

  long long TakeInteger(std::string_view* line) const { return ToInteger(TakeWord(line)); }

  long long ToInteger(std::string_view word) const {
    const std::string_view whole = word;
    if (word.starts_with('+')) word.remove_prefix(1);
    long long value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc{} || end != word.data() + word.size())
      Refuse(whole.empty() ? "a whole number is missing"
                           : fmt::format("\"{}\" is not a whole number", whole.substr(0, 40)));
    return value;
  }

  [[noreturn]] void Refuse(const std::string& fault) const {
    throw Error(
        Code::kBadMesh,
        fmt::format("line {}: {}; the file is damaged or cut off, export it again", line_, fault),
        file_);
  }

  std::string_view rest() const { return rest_; }
  int line() const { return line_; }

 private:
  std::string_view rest_;
  const std::filesystem::path& file_;
  int line_ = 0;
};

}  // namespace arthro
