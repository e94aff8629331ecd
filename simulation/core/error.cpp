#include "simulation/core/error.h"

#include <algorithm>
#include <cstdint>
#include <new>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace arthro {
namespace {

namespace fs = std::filesystem;

// Longest parts of a message, in characters.
constexpr std::size_t kLongestQuoted = 80, kLongestWord = 240, kLongestLine = 1000;
constexpr char32_t kReplacement = 0xfffd;

// The character at the front of `text`, which loses it; kReplacement for a byte that is not UTF-8.
char32_t TakeCharacter(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t size = first < 0x80           ? 1
                           : (first >> 5) == 0x06 ? 2
                           : (first >> 4) == 0x0e ? 3
                           : (first >> 3) == 0x1e ? 4
                                                  : 0;
  char32_t letter = size == 1 ? first : static_cast<char32_t>(first & (0x7f >> size));
  bool is_whole = size > 0 && size <= text.size();
  for (std::size_t i = 1; is_whole && i < size; ++i) {
    is_whole = (byte(i) & 0xc0) == 0x80;
    letter = letter << 6 | (byte(i) & 0x3f);
  }
  constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};  // shorter forms are not allowed
  is_whole = is_whole && letter >= kLeast[size] && letter <= 0x10ffff &&
             !(letter >= 0xd800 && letter <= 0xdfff);
  text.remove_prefix(is_whole ? size : 1);
  return is_whole ? letter : kReplacement;
}

void Append(char32_t letter, std::u32string& line) {
  const auto escape = [&](const std::string& ascii) { line.append(ascii.begin(), ascii.end()); };
  const bool is_direction = letter == 0x61c || letter == 0x200e || letter == 0x200f ||
                            (letter >= 0x2028 && letter <= 0x202e) ||
                            (letter >= 0x2066 && letter <= 0x2069);
  if (letter == '\n')
    escape("\\n");
  else if (letter == '\r')
    escape("\\r");
  else if (letter == '\t')
    escape("\\t");
  else if (letter < 0x20 || (letter >= 0x7f && letter < 0xa0))
    escape(fmt::format("\\x{:02x}", static_cast<std::uint32_t>(letter)));
  else if (is_direction)
    escape(fmt::format("\\u{:04x}", static_cast<std::uint32_t>(letter)));
  else
    line += letter;
}

std::string Utf8(std::u32string_view line) {
  std::string text;
  const auto put = [&](char32_t bits) { text += static_cast<char>(bits); };
  for (const char32_t c : line) {
    if (c < 0x80) {
      put(c);
    } else if (c < 0x800) {
      put(0xc0 | c >> 6), put(0x80 | (c & 0x3f));
    } else if (c < 0x10000) {
      put(0xe0 | c >> 12), put(0x80 | (c >> 6 & 0x3f)), put(0x80 | (c & 0x3f));
    } else {
      put(0xf0 | c >> 18), put(0x80 | (c >> 12 & 0x3f)), put(0x80 | (c >> 6 & 0x3f));
      put(0x80 | (c & 0x3f));
    }
  }
  return text;
}

std::u32string Shortened(std::u32string_view part, std::size_t longest) {
  if (part.size() <= longest) return std::u32string(part);
  return std::u32string(part.substr(0, longest - 1)) + U'…';
}

// Returns the end of the quoted text that begins behind `open`; npos where nothing closes it.
std::size_t CloseOf(std::u32string_view line, std::size_t open) {
  for (std::size_t at = open + 1; at < line.size(); ++at) {
    if (line[at] == U'\\' && at + 1 < line.size() &&
        (line[at + 1] == U'"' || line[at + 1] == U'\\'))
      ++at;
    else if (line[at] == U'"')
      return at;
  }
  return line.npos;
}

std::u32string Printable(std::string_view text) {
  // Far more than is shown, and far less than a file that is all one name.
  constexpr std::size_t kLongestRead = 1 << 16;
  std::string_view left = text.substr(0, kLongestRead);
  std::u32string line;
  while (!left.empty()) Append(TakeCharacter(left), line);
  return line;
}

std::string NameOf(const fs::path& file) {
  const std::u32string name = Printable(file.native());
  if (name.size() <= kLongestWord) return Utf8(name);
  return Utf8(U'…' + name.substr(name.size() - kLongestWord + 1));  // its end says most
}

std::string WhatOf(const std::string& sentence, const fs::path& file) {
  return file.empty() ? sentence : NameOf(file) + ": " + sentence;
}

std::string WhyOf(const std::error_code& code) {
  if (code == std::errc::filename_too_long) return "this name is too long; choose a shorter one";
  if (code == std::errc::no_such_file_or_directory) return "there is no such file or folder";
  if (code == std::errc::permission_denied || code == std::errc::operation_not_permitted ||
      code == std::errc::read_only_file_system)
    return "this may not be used; check its permissions";
  if (code == std::errc::not_a_directory) return "a part of this name is no folder";
  if (code == std::errc::too_many_symbolic_link_levels) return "its links lead in a circle";
  if (code == std::errc::no_space_on_device) return "the disk is full; free some space";
  return "the file system refused this; check the name and the disk";
}

}  // namespace

std::string PrintableLine(std::string_view text) {
  const std::u32string line = Printable(text);
  const std::u32string_view all = line;
  std::u32string shown;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t close = all[at] == U'"' ? CloseOf(all, at) : all.npos;
    if (close != all.npos) {
      shown += U'"' + Shortened(all.substr(at + 1, close - at - 1), kLongestQuoted) + U'"';
      at = close + 1;
      continue;
    }
    std::size_t end = all[at] == U' ' || all[at] == U'"' ? at + 1 : all.find_first_of(U" \"", at);
    end = std::min(end, all.size());
    shown += Shortened(all.substr(at, end - at), kLongestWord);
    at = end;
  }
  return Utf8(Shortened(shown, kLongestLine));
}

Error::Error(Code code, std::string_view sentence, fs::path file)
    : std::runtime_error(WhatOf(PrintableLine(sentence), file)),
      code_(code),
      sentence_(PrintableLine(sentence)),
      file_(std::move(file)) {}

std::string DescribeFault(const std::exception& fault) {
  if (dynamic_cast<const Error*>(&fault)) return fault.what();
  if (dynamic_cast<const std::bad_alloc*>(&fault) || dynamic_cast<const std::length_error*>(&fault))
    return "there is not enough memory for this; use a smaller picture or mesh";
  if (const auto* file = dynamic_cast<const fs::filesystem_error*>(&fault)) {
    if (file->path1().empty()) return PrintableLine(WhyOf(file->code()));
    return NameOf(file->path1()) + ": " + WhyOf(file->code());
  }
  if (dynamic_cast<const std::system_error*>(&fault))
    return "the system gave too few of its means (threads, files) for this; close other programs "
           "and try again";
  return "this stopped at a fault that was not foreseen; report the command and its input";
}

}  // namespace arthro
