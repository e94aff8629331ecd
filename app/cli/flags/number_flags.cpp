#include "app/cli/flags/number_flags.h"

#include <charconv>
#include <cmath>
#include <utility>

namespace arthro::app {
namespace {

// The typed word, shortened and without control characters.
std::string Quoted(std::string_view word) {
  constexpr std::size_t kMostShown = 40;
  std::string shown;
  for (const char letter : word.substr(0, kMostShown))
    shown += static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f ? '?' : letter;
  return '"' + shown + (word.size() > kMostShown ? "…\"" : "\"");
}

// "from 0.1 to 1000 mm"
std::string ToString(const NumberRule& rule) {
  return fmt::format("{} {} to {}{}{}", rule.range.above_min ? "above" : "from", rule.range.min,
                     rule.range.max, rule.unit.empty() ? "" : " ", rule.unit);
}

// "a number from 0.1 to 1000 mm"
std::string RuleWords(const NumberRule& rule) {
  return fmt::format("a {}number {}", rule.is_whole ? "whole " : "", ToString(rule));
}

// "INTEGER from 1 to 99"; every int there is goes without saying.
std::string TypeName(std::string_view kind, const NumberRule& rule) {
  const bool is_any =
      rule.range.min == kAnyWholeNumber.min && rule.range.max == kAnyWholeNumber.max;
  if (is_any) return std::string(kind);
  return fmt::format("{} {}", kind, ToString(rule));
}

template <class T>
std::optional<T> Parsed(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  T value{};
  const char* end = word.data() + word.size();
  const auto [stop, fault] = std::from_chars(word.data(), end, value);
  if (word.empty() || fault != std::errc() || stop != end) return std::nullopt;
  return value;
}

// NaN is in no range, infinities are outside every one.
std::optional<double> NumberIn(std::string_view word, const NumberRule& rule) {
  std::optional<double> value;
  if (!rule.is_whole)
    value = Parsed<double>(word);
  else if (const auto whole = Parsed<long long>(word))
    value = static_cast<double>(*whole);
  if (value && !Contains(rule.range, *value)) value.reset();
  return value;
}

}  // namespace

double NumberFromWord(const std::string& flag, std::string_view word, const NumberRule& rule) {
  if (const auto value = NumberIn(word, rule)) return *value;
  const bool has_comma = word.find(',') != word.npos;
  throw CLI::ValidationError(
      flag, fmt::format("{} is not {}{}", Quoted(word), RuleWords(rule),
                        has_comma ? "; decimals are written with a point, as in 1.5" : ""));
}

std::vector<double> NumbersFromWord(const std::string& flag, std::string_view word,
                                    const NumberRule& rule) {
  std::vector<double> values;
  for (std::string_view rest = word;;) {
    const std::string_view one = rest.substr(0, rest.find(','));
    const auto value = NumberIn(one, rule);
    if (!value)
      throw CLI::ValidationError(
          flag,
          fmt::format("{}: {} is not {}; a list is separated by commas, and decimals are "
                      "written with a point, as in 1.5,2",
                      Quoted(word), one.empty() ? "an empty place" : Quoted(one), RuleWords(rule)));
    values.push_back(*value);
    if (one.size() == rest.size()) return values;
    rest.remove_prefix(one.size() + 1);
  }
}

std::pair<int, int> SizeFromWord(const std::string& flag, std::string_view word, Range range) {
  const NumberRule rule{range, "px", true};
  const std::size_t cross = word.find('x');
  const auto width = NumberIn(word.substr(0, cross), rule);
  const auto height = cross == word.npos ? std::nullopt : NumberIn(word.substr(cross + 1), rule);
  if (!width || !height)
    throw CLI::ValidationError(flag, fmt::format("{} is no size such as 1280x800, each side {}",
                                                 Quoted(word), RuleWords(rule)));
  return {static_cast<int>(*width), static_cast<int>(*height)};
}

CLI::Option* AddNumberOption(CLI::App& job, const std::string& flag, const NumberRule& rule,
                             const std::string& help, std::function<void(double)> take) {
  return job
      .add_option_function<std::string>(
          flag,
          [flag, rule, take = std::move(take)](const std::string& word) {
            take(NumberFromWord(flag, word, rule));
          },
          help)
      ->type_name(TypeName(rule.is_whole ? kWholeType : kNumberType, rule));
}

CLI::Option* AddListOption(CLI::App& job, const std::string& flag, const NumberRule& rule,
                           const std::string& help,
                           std::function<void(const std::vector<double>&)> take) {
  return job
      .add_option_function<std::vector<std::string>>(
          flag,
          [flag, rule, take = std::move(take)](const std::vector<std::string>& words) {
            std::vector<double> all;
            for (const std::string& word : words)
              for (const double value : NumbersFromWord(flag, word, rule)) all.push_back(value);
            take(all);
          },
          help)
      ->type_name(TypeName(kListType, rule));
}

}  // namespace arthro::app
