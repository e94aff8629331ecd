// A cell of a table whose columns are parted by commas.
#pragma once

#include <string>

namespace arthro {

// Quotes a text with a comma, a quote or a line break; its own quotes are doubled (RFC 4180).
inline std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace arthro
