#include "simulation/scene/json_text.h"

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

#include <fmt/format.h>

namespace arthro {
namespace {

using nlohmann::json;

// `byte`: from 1, as the parser counts.
std::string LineAndColumn(const std::string& text, std::size_t byte) {
  const std::size_t end = std::min(byte > 0 ? byte - 1 : 0, text.size());
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
  const std::size_t start = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  return fmt::format("line {}, column {}", line + 1,
                     end - (start == std::string::npos ? 0 : start + 1) + 1);
}

struct TwiceFinder {
  std::vector<std::set<std::string>> open = {};
  std::string twice = {};

  bool operator()(int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) open.emplace_back();
    if (event == json::parse_event_t::object_end) open.pop_back();
    if (event == json::parse_event_t::key && !open.back().insert(value.get<std::string>()).second)
      twice = value.get<std::string>();
    return true;
  }
};

// Where the parser gave up, which what it throws does not say of a number.
struct EndFinder final : json::json_sax_t {
  std::size_t byte = 0;  // just behind
  std::string token;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t at, const std::string& last, const json::exception&) override {
    byte = at;
    token = last;
    return false;
  }
};

std::string TooLarge(const std::string& text) {
  constexpr std::size_t kShown = 40;
  EndFinder end;
  json::sax_parse(text, &end);
  const std::size_t begin = end.byte > end.token.size() ? end.byte - end.token.size() : 0;
  return fmt::format("the number {}{} at {} is larger than any that is read; mend it",
                     end.token.substr(0, kShown), end.token.size() > kShown ? "…" : "",
                     LineAndColumn(text, begin + 1));
}

}  // namespace

json ParseJson(const std::string& text, Code code, const std::filesystem::path& file) {
  TwiceFinder twice;
  json parsed;
  try {
    parsed = json::parse(text, std::ref(twice));
  } catch (const json::parse_error& fault) {
    throw Error(
        code,
        fmt::format("this is not JSON from {} on; mend it there", LineAndColumn(text, fault.byte)),
        file);
  } catch (const json::exception&) {  // a number beyond what a double holds
    throw Error(code, TooLarge(text), file);
  }
  if (!twice.twice.empty())
    throw Error(code,
                fmt::format("the key {} comes twice in one object; remove one of them",
                            json(twice.twice).dump()),
                file);
  return parsed;
}

}  // namespace arthro
