#include "tests/hostile/mutation.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>
#include <zlib.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace arthro::test {
namespace {

constexpr int kDeep = 70000;  // levels; a recursive reader's stack of 8 MB does not hold them

constexpr std::array<const char*, 26> kNumbers = {"-1",
                                                  "0",
                                                  "-0.0",
                                                  "1",
                                                  "nan",
                                                  "NaN",
                                                  "-inf",
                                                  "Infinity",
                                                  "1e308",
                                                  "-1e308",
                                                  "1e400",
                                                  "1e-320",
                                                  "1e30",
                                                  "1e10",
                                                  "65536",
                                                  "2147483647",
                                                  "2147483648",
                                                  "-2147483649",
                                                  "4294967296",
                                                  "10000000000",
                                                  "9223372036854775808",
                                                  "99999999999999999999999",
                                                  "0x10",
                                                  "1,5",
                                                  "",
                                                  "null"};

class Mutator {
 public:
  Mutator(std::string bytes, FileFormat format, std::uint64_t seed)
      : bytes_(std::move(bytes)), format_(format), random_(seed) {}

  Mutation Run() {
    const int times = Below(4) == 0 ? 2 + static_cast<int>(Below(4)) : 1;
    for (int i = 0; i < times; ++i) Once();
    return {bytes_, what_};
  }

 private:
  std::uint64_t Below(std::uint64_t end) { return end == 0 ? 0 : random_() % end; }
  std::size_t Place() { return static_cast<std::size_t>(Below(bytes_.size() + 1)); }
  void Say(const std::string& what) { what_ += (what_.empty() ? "" : "; ") + what; }
  bool IsText() const {
    return format_ == FileFormat::kText || format_ == FileFormat::kJson ||
           format_ == FileFormat::kXml;
  }

  void Once() {
    if (bytes_.empty()) return;
    const std::uint64_t choice = Below(100);
    if (format_ == FileFormat::kJson && choice < 40 && !is_deep_) return JsonValue();
    if (IsText()) {
      if (choice < 60) return Number();
      if (choice < 68) return SwapTokens();
      if (choice < 74) return Nest();
      if (choice < 82) return InsertText();
      if (choice < 86) return RepeatLine();
    } else if (choice < 40) {
      return LengthField();
    } else if (choice < 50 && format_ == FileFormat::kPng) {
      return PngHeader();
    }
    switch (Below(5)) {
      case 0:
        return FlipBits();
      case 1:
        return Truncate();
      case 2:
        return DeleteBlock();
      case 3:
        return CopyBlock();
      default:
        return RandomBlock();
    }
  }

  void FlipBits() {
    const std::uint64_t count = 1 + Below(8);
    for (std::uint64_t i = 0; i < count; ++i)
      bytes_[Below(bytes_.size())] ^= static_cast<char>(1 << Below(8));
    Say(fmt::format("{} bits flipped", count));
  }
  void Truncate() {
    const std::size_t size = Below(8) == 0 ? Below(64) : Place();
    bytes_.resize(std::min(size, bytes_.size()));
    Say(fmt::format("cut to {} bytes", bytes_.size()));
  }
  void DeleteBlock() {
    const std::size_t at = Place(), size = static_cast<std::size_t>(Below(1 + bytes_.size() / 4));
    bytes_.erase(at, size);
    Say(fmt::format("{} bytes deleted at {}", size, at));
  }
  void CopyBlock() {
    const std::size_t from = Place(), to = Place();
    const std::string block = bytes_.substr(from, static_cast<std::size_t>(Below(4096)));
    bytes_.insert(to, block);
    Say(fmt::format("{} bytes copied from {} to {}", block.size(), from, to));
  }
  void RandomBlock() {
    const std::size_t at = static_cast<std::size_t>(Below(bytes_.size()));
    const std::size_t size = std::min<std::size_t>(1 + Below(256), bytes_.size() - at);
    for (std::size_t i = 0; i < size; ++i) bytes_[at + i] = static_cast<char>(random_());
    Say(fmt::format("{} random bytes at {}", size, at));
  }

  // An extreme integer over whatever stands there, more often near the beginning or the end.
  void LengthField() {
    constexpr std::array<std::uint64_t, 9> kValues = {
        0, 1, 0x7f, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff, 0x7fffffffffffffff, ~0ull};
    const std::uint64_t value = kValues[Below(kValues.size())];
    const std::size_t size = std::size_t{1} << Below(4);
    const bool is_big_endian = Below(2) == 0;
    const std::size_t near = std::min<std::size_t>(512, bytes_.size());
    const std::size_t at = Below(3) == 0   ? Place()
                           : Below(2) == 0 ? Below(near)
                                           : bytes_.size() - near + Below(near);
    for (std::size_t i = 0; i < size && at + i < bytes_.size(); ++i) {
      const std::size_t byte = is_big_endian ? size - 1 - i : i;
      bytes_[at + i] = static_cast<char>(value >> (8 * byte));
    }
    Say(fmt::format("{} in {} bytes {} at {}", value, size, is_big_endian ? "BE" : "LE", at));
  }

  // A field of the header with a checksum that fits, so that the decoder believes it.
  void PngHeader() {
    if (bytes_.size() < 33) return;
    const std::size_t field = Below(7);
    constexpr std::array<std::size_t, 7> kOffset = {16, 20, 24, 25, 26, 27, 28};
    const bool is_size = field < 2;
    constexpr std::array<std::uint32_t, 6> kSizes = {0, 1, 30000, 100000, 0x7fffffff, 0xffffffff};
    const std::uint32_t value =
        is_size ? kSizes[Below(kSizes.size())] : static_cast<std::uint32_t>(Below(256));
    for (int i = 0; i < (is_size ? 4 : 1); ++i)
      bytes_[kOffset[field] + i] = static_cast<char>(is_size ? value >> (8 * (3 - i)) : value);
    const auto crc =
        static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(&bytes_[12]), 17));
    for (int i = 0; i < 4; ++i) bytes_[29 + i] = static_cast<char>(crc >> (8 * (3 - i)));
    Say(fmt::format("PNG header byte {} set to {}", kOffset[field], value));
  }

  // [begin, end) of every number in the text.
  std::vector<std::pair<std::size_t, std::size_t>> Numbers() const {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    constexpr const char* kPart = "0123456789.eE+-";
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
      if (std::strchr("0123456789-", bytes_[i]) == nullptr || bytes_[i] == '\0') continue;
      std::size_t end = i;
      while (end < bytes_.size() && bytes_[end] != '\0' && std::strchr(kPart, bytes_[end])) ++end;
      found.emplace_back(i, end);
      i = end;
    }
    return found;
  }

  void Number() {
    const auto numbers = Numbers();
    if (numbers.empty()) return FlipBits();
    const auto [begin, end] = numbers[Below(numbers.size())];
    const std::string value = kNumbers[Below(kNumbers.size())];
    Say(fmt::format("number {} at {} becomes \"{}\"", bytes_.substr(begin, end - begin), begin,
                    value));
    bytes_.replace(begin, end - begin, value);
  }

  std::vector<std::pair<std::size_t, std::size_t>> Tokens() const {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    const auto is_gap = [](char c) { return std::strchr(" \t\r\n,:;<>{}[]=", c) != nullptr; };
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
      if (is_gap(bytes_[i])) continue;
      std::size_t end = i;
      while (end < bytes_.size() && !is_gap(bytes_[end])) ++end;
      found.emplace_back(i, end);
      i = end;
    }
    return found;
  }

  void SwapTokens() {
    const auto tokens = Tokens();
    if (tokens.size() < 2) return FlipBits();
    auto a = tokens[Below(tokens.size())], b = tokens[Below(tokens.size())];
    if (b.first < a.first) std::swap(a, b);
    if (a.first == b.first) return;
    const std::string first = bytes_.substr(a.first, a.second - a.first);
    const std::string second = bytes_.substr(b.first, b.second - b.first);
    bytes_.replace(b.first, b.second - b.first, first);
    bytes_.replace(a.first, a.second - a.first, second);
    Say(fmt::format("tokens at {} and {} swapped", a.first, b.first));
  }

  void Nest() {
    is_deep_ = true;
    const auto numbers = Numbers();
    std::string open, close;
    if (format_ == FileFormat::kXml) {
      for (int i = 0; i < kDeep; ++i) open += "<a>", close += "</a>";
    } else {
      const bool is_object = Below(2) == 0;
      for (int i = 0; i < kDeep; ++i)
        open += is_object ? "{\"a\":" : "[", close += is_object ? "}" : "]";
      if (is_object) open += "1";
    }
    const bool closes = Below(2) == 0;
    if (!closes) close.clear();
    if (numbers.empty()) return FlipBits();
    const auto [begin, end] = numbers[Below(numbers.size())];
    std::size_t at = begin;
    if (format_ == FileFormat::kXml) {
      at = bytes_.find('>', begin);
      at = at == std::string::npos ? begin : at + 1;
      bytes_.insert(at, open + close);
    } else {
      bytes_.replace(begin, end - begin, open + close);
    }
    Say(fmt::format("{} levels{} at {}", kDeep, closes ? "" : ", open,", at));
  }

  void InsertText() {
    const std::array<std::string, 9> texts = {std::string("\x1b[31m\x07"),
                                              std::string(1, '\0'),
                                              std::string("\xff\xfe\x80"),
                                              std::string(100000, 'x'),
                                              std::string("\r\n\r\n"),
                                              std::string("\xef\xbb\xbf"),
                                              std::string("\"}]'>"),
                                              std::string("\xc2\x9b"
                                                          "2J"),
                                              std::string("%s%n../../../etc/passwd")};
    const std::size_t which = Below(texts.size());
    // In the middle of a token, so that it lands in a value or a name.
    const auto tokens = Tokens();
    std::size_t at = Place();
    if (!tokens.empty()) {
      const auto [begin, end] = tokens[Below(tokens.size())];
      at = (begin + end) / 2;
    }
    bytes_.insert(at, texts[which]);
    Say(fmt::format("text {} inserted at {}", which, at));
  }

  void RepeatLine() {
    const std::size_t at = bytes_.find('\n', Place());
    if (at == std::string::npos) return CopyBlock();
    const std::size_t end = bytes_.find('\n', at + 1);
    const std::string line = bytes_.substr(at, end == std::string::npos ? end : end - at);
    const std::uint64_t times = Below(4) == 0 ? 10000 : 1;
    std::string copies;
    for (std::uint64_t i = 0; i < times && copies.size() < 2000000; ++i) copies += line;
    bytes_.insert(at, copies);
    Say(fmt::format("the line at {} repeated {} times", at, times));
  }

  // Another value in a random place of the tree; the text stays JSON.
  void JsonValue() {
    nlohmann::json root = nlohmann::json::parse(bytes_, nullptr, false);
    if (root.is_discarded() || !root.is_structured()) return Number();
    std::vector<nlohmann::json::json_pointer> places;
    const nlohmann::json flat = root.flatten();
    for (const auto& [name, value] : flat.items()) {
      nlohmann::json::json_pointer pointer(name);
      while (true) {
        places.push_back(pointer);
        if (pointer.empty() || Below(3) != 0) break;
        pointer = pointer.parent_pointer();
      }
    }
    if (places.empty()) return Number();
    const auto place = places[Below(places.size())];
    const std::vector<nlohmann::json> values = {nullptr,
                                                true,
                                                0,
                                                -1,
                                                1e308,
                                                -1e308,
                                                1e-320,
                                                9223372036854775807ll,
                                                std::uint64_t{18446744073709551615ull},
                                                1e10,
                                                "",
                                                "\x1b]0;title\x07",
                                                "a\nb",
                                                std::string(300, 'n'),
                                                std::string(100000, 'x'),
                                                "../../../../etc/passwd",
                                                "/dev/zero",
                                                "https://example.org/x.png",
                                                nlohmann::json::array(),
                                                nlohmann::json::object(),
                                                nlohmann::json::array({1, "2", nullptr})};
    const std::size_t which = Below(values.size() + 3);
    const std::string before = root[place].dump();
    std::string change;
    if (which < values.size()) {
      root[place] = values[which];
      change = Short(root[place].dump());
    } else if (which == values.size() || place.empty()) {
      if (!place.empty()) {
        nlohmann::json& parent = root[place.parent_pointer()];
        if (parent.is_object()) parent.erase(place.back());
      }
      change = "removed";
    } else {  // the value of another place
      const auto other = places[Below(places.size())];
      root[place] = nlohmann::json(root[other]);
      change = "the value of " + other.to_string();
    }
    bytes_ = root.dump(1);
    Say(fmt::format("{} becomes {}", place.to_string(), change));
  }
  static std::string Short(const std::string& text) {
    return text.size() > 60 ? text.substr(0, 60) + "..." : text;
  }

  std::string bytes_;
  FileFormat format_;
  std::mt19937_64 random_;
  std::string what_;
  bool is_deep_ = false;  // the JSON library's tree is recursive, so that such a text is left alone
};

}  // namespace

Mutation Mutate(const std::string& bytes, FileFormat format, std::uint64_t seed) {
  return Mutator(bytes, format, seed).Run();
}

}  // namespace arthro::test
