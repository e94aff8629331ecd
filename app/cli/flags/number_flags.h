// Numbers on the command line, by one rule for every flag of every job: decimal digits with a
// point, finite, within a stated range. Anything else is wrong use, exit code 2, with one sentence
// that names the flag, the value and the range. Lists are separated by commas.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "simulation/core/options.h"

namespace arthro::app {

// Values that a flag takes. The unit is the flag's own, such as "mm".
struct NumberRule {
  Range range;
  std::string unit;
  bool is_whole = false;
};

inline constexpr Range kAnyWholeNumber{std::numeric_limits<int>::min(),
                                       std::numeric_limits<int>::max()};
// Ten turns either way: a larger angle is a slip of the pen.
inline constexpr Range kAnyAngle{-3600.0, 3600.0};  // degrees

// The type names of number options in the help begin so; a test finds them by these words.
inline constexpr std::string_view kNumberType = "NUMBER", kWholeType = "INTEGER",
                                  kListType = "LIST";

// One number. Throws CLI::ValidationError.
double NumberFromWord(const std::string& flag, std::string_view word, const NumberRule& rule);
// Numbers between commas. Throws CLI::ValidationError.
std::vector<double> NumbersFromWord(const std::string& flag, std::string_view word,
                                    const NumberRule& rule);
// Two whole numbers, such as 1280x800. Throws CLI::ValidationError.
std::pair<int, int> SizeFromWord(const std::string& flag, std::string_view word, Range range);

// An option that gives `take` its number; for what AddNumber cannot express.
CLI::Option* AddNumberOption(CLI::App& job, const std::string& flag, const NumberRule& rule,
                             const std::string& help, std::function<void(double)> take);
CLI::Option* AddListOption(CLI::App& job, const std::string& flag, const NumberRule& rule,
                           const std::string& help,
                           std::function<void(const std::vector<double>&)> take);

// A flag for `target`, which must outlive the parse. Its value now is shown as the default.
template <class T>
CLI::Option* AddNumber(CLI::App& job, const std::string& flag, T& target, Range range,
                       const char* unit, const std::string& help) {
  static_assert(std::is_same_v<T, int> || std::is_same_v<T, double>);
  return AddNumberOption(job, flag, {range, unit, std::is_same_v<T, int>}, help,
                         [&target](double value) { target = static_cast<T>(value); })
      ->default_str(fmt::format("{}", target));
}

// The same for a value that something else decides where the flag is not given.
template <class T>
CLI::Option* AddNumber(CLI::App& job, const std::string& flag, std::optional<T>& target,
                       Range range, const char* unit, const std::string& help) {
  static_assert(std::is_same_v<T, int> || std::is_same_v<T, double>);
  return AddNumberOption(job, flag, {range, unit, std::is_same_v<T, int>}, help,
                         [&target](double value) { target = static_cast<T>(value); });
}

// A list between commas; the flag may be given again.
template <class T>
CLI::Option* AddNumbers(CLI::App& job, const std::string& flag, std::vector<T>& target, Range range,
                        const char* unit, const std::string& help) {
  static_assert(std::is_same_v<T, int> || std::is_same_v<T, double>);
  return AddListOption(job, flag, {range, unit, std::is_same_v<T, int>}, help,
                       [&target](const std::vector<double>& values) {
                         target.clear();
                         for (const double value : values) target.push_back(static_cast<T>(value));
                       })
      ->default_str(target.empty() ? "" : fmt::format("{}", fmt::join(target, ",")));
}

}  // namespace arthro::app
