#include "simulation/core/json_text.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <vector>

#include <fmt/format.h>

namespace arthro {
namespace {

using nlohmann::json;

// `byte`: from 1, as the parser counts.
std::string LineAndColumn(std::string_view text, std::size_t byte) {
  const std::size_t end = std::min(byte > 0 ? byte - 1 : 0, text.size());
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  const std::size_t start = end == 0 ? text.npos : text.rfind('\n', end - 1);
  return fmt::format("line {}, column {}", line + 1,
                     end - (start == text.npos ? 0 : start + 1) + 1);
}

// Walks through a text without building a value: sax_parse keeps its own stack on the heap.
struct Checker final : json::json_sax_t {
  std::vector<std::set<std::string>> open = {};  // keys of every open object; none for an array
  std::string twice = {};
  bool is_too_deep = false, is_broken = false, is_number_too_large = false;
  std::size_t byte = 0;  // just behind the fault
  std::string token = {};

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool key(string_t& name) override {
    if (!open.back().insert(name).second) twice = name;
    return true;
  }
  bool start_object(std::size_t) override { return Open(); }
  bool start_array(std::size_t) override { return Open(); }
  bool end_object() override { return Close(); }
  bool end_array() override { return Close(); }
  bool parse_error(std::size_t at, const std::string& last, const json::exception& fault) override {
    constexpr int kOutOfRange = 406;  // exception id of the parser
    is_number_too_large = fault.id == kOutOfRange;
    is_broken = true;
    byte = at;
    token = last;
    return false;
  }

 private:
  bool Open() {
    open.emplace_back();
    is_too_deep = open.size() > static_cast<std::size_t>(kDeepestJson);
    return !is_too_deep;
  }
  bool Close() {
    open.pop_back();
    return true;
  }
};

std::string TooLarge(std::string_view text, const Checker& checked) {
  constexpr std::size_t kShown = 40;
  const std::string& token = checked.token;
  const std::size_t begin = checked.byte > token.size() ? checked.byte - token.size() : 0;
  return fmt::format("the number {}{} at {} is larger than any that is read; mend it",
                     token.substr(0, kShown), token.size() > kShown ? "…" : "",
                     LineAndColumn(text, begin + 1));
}

void CheckJson(std::string_view text, Code code, const std::filesystem::path& file) {
  Checker checked;
  json::sax_parse(text, &checked);
  if (checked.is_too_deep)
    throw Error(code,
                fmt::format("this JSON is nested more than {} deep, which no file of this program "
                            "is; check where it comes from",
                            kDeepestJson),
                file);
  if (checked.is_number_too_large) throw Error(code, TooLarge(text, checked), file);
  if (checked.is_broken)
    throw Error(code,
                fmt::format("this is not JSON from {} on; mend it there",
                            LineAndColumn(text, checked.byte)),
                file);
  if (!checked.twice.empty())
    throw Error(code,
                fmt::format("the key {} comes twice in one object; remove one of them",
                            json(checked.twice).dump()),
                file);
}

// Follows a path of keys and indices through a JSON text that is known to be valid.
class KeyFinder {
 public:
  KeyFinder(std::string_view text, std::string_view path) : text_(text), path_(path) {}

  std::size_t Find() {
    SkipSpace();
    found_ = at_;
    Enter();
    return found_;
  }

 private:
  // At the start of a value whose path was matched so far.
  void Enter() {
    if (path_.empty() || at_ >= text_.size()) return;
    if (text_[at_] == '{' && path_.front() != '[')
      EnterMember();
    else if (text_[at_] == '[' && path_.front() == '[')
      EnterElement();
  }

  void EnterMember() {
    if (path_.front() == '.') path_.remove_prefix(1);
    for (++at_, SkipSpace(); at_ < text_.size() && text_[at_] != '}'; SkipComma()) {
      const std::size_t start = at_;
      SkipValue();
      const std::string_view name = text_.substr(start + 1, at_ - start - 2);
      SkipSpace();
      ++at_;  // the colon
      SkipSpace();
      const bool is_next =
          path_.starts_with(name) &&
          (path_.size() == name.size() || path_[name.size()] == '.' || path_[name.size()] == '[');
      if (is_next) {
        path_.remove_prefix(name.size());
        found_ = start;
        return Enter();
      }
      SkipValue();
    }
  }

  void EnterElement() {
    const std::size_t close = path_.find(']');
    std::size_t index = 0;
    if (close == path_.npos ||
        std::from_chars(path_.data() + 1, path_.data() + close, index).ec != std::errc())
      return;
    for (++at_, SkipSpace(); at_ < text_.size() && text_[at_] != ']'; SkipComma(), --index) {
      if (index == 0) {
        path_.remove_prefix(close + 1);
        found_ = at_;
        return Enter();
      }
      SkipValue();
    }
  }

  void SkipSpace() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

  void SkipComma() {
    SkipSpace();
    if (at_ < text_.size() && text_[at_] == ',') ++at_;
    SkipSpace();
  }

  // Behind a text, a number, a word, or a list or object with all that it holds.
  void SkipValue() {
    int depth = 0;
    bool is_text = false;
    for (; at_ < text_.size(); ++at_) {
      const char letter = text_[at_];
      if (is_text) {
        if (letter == '\\') ++at_;
        if (letter != '"') continue;
        is_text = false;
        if (depth == 0) return void(++at_);
      } else if (letter == '"') {
        is_text = true;
      } else if (letter == '{' || letter == '[') {
        ++depth;
      } else if (depth > 0 && (letter == '}' || letter == ']')) {
        if (--depth == 0) return void(++at_);
      } else if (depth == 0 && std::string_view(",:}] \t\r\n").find(letter) != text_.npos) {
        return;
      }
    }
  }

  std::string_view text_, path_;
  std::size_t at_ = 0, found_ = 0;
};

}  // namespace

int LineOfKey(std::string_view text, std::string_view key) {
  const std::size_t found = KeyFinder(text, key).Find();
  return 1 + static_cast<int>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(found), '\n'));
}

json ParseJson(std::string_view text, Code code, const std::filesystem::path& file) {
  CheckJson(text, code, file);
  return json::parse(text);
}

nlohmann::ordered_json ParseOrderedJson(std::string_view text, Code code,
                                        const std::filesystem::path& file) {
  CheckJson(text, code, file);
  return nlohmann::ordered_json::parse(text);
}

}  // namespace arthro
