// Options as command-line flags, by their one list of fields (simulation/core/options.h): lengths
// as --name-mm, angles as --name-deg, enums by their words, with range, unit and default in the
// help.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <tuple>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/option_fields.h"
#include "simulation/core/options.h"

namespace arthro::app {

// "m" and "rad" as the flags' own units.
inline std::string UnitShown(std::string_view unit) {
  if (unit == "m") return "mm";
  if (unit == "rad") return "degrees";
  return std::string(unit);
}

// A limit that a change of unit took a rounding error to, without it: 18, not 18.000000000000004.
inline double Shown(double limit) { return std::stod(fmt::format("{:.12g}", limit)); }

struct CliVisitor {
  CLI::App& job;
  std::string group = "Options";

  template <class T, class R>
  void operator()(const char* name, T& field, const R& range, const char* unit, const char* help) {
    const Border border = PersonBorder(unit);
    std::string flag = "--" + std::string(name) + border.suffix;
    std::replace(flag.begin(), flag.end(), '_', '-');
    std::string text = help;
    T* target = &field;
    if constexpr (std::is_enum_v<T>) {
      std::vector<std::string> words;
      std::string current;
      for (const auto& [value, word] : range.words) {
        words.push_back(word);
        if (value == field) current = word;
      }
      const auto choices = range.words;
      job.add_option_function<std::string>(
             flag,
             [target, choices](const std::string& chosen) {
               for (const auto& [value, word] : choices)
                 if (chosen == word) *target = value;
             },
             text)
          ->check(CLI::IsMember(words))
          ->default_str(current)
          ->group(group);
    } else if constexpr (std::is_same_v<T, bool>) {
      // --flag or --flag=false
      job.add_flag(flag, field, text)->default_str(field ? "true" : "false")->group(group);
    } else if constexpr (std::is_same_v<T, double>) {
      static_assert(std::is_same_v<R, Range>, "a number has a range");
      const double factor = border.factor;
      AddNumberOption(job, flag,
                      {{Shown(range.min * factor), Shown(range.max * factor), range.above_min},
                       UnitShown(unit)},
                      text, [target, factor](double shown) { *target = shown / factor; })
          ->default_str(fmt::format("{:g}", field * factor))
          ->group(group);
    } else if constexpr (std::is_same_v<T, int>) {
      Range whole = kAnyWholeNumber;
      if constexpr (std::is_same_v<R, Range>) whole = range;
      AddNumber(job, flag, field, whole, unit, text)->group(group);
    } else {
      static_assert(std::is_same_v<T, std::string>);
      job.add_option(flag, field, text)->capture_default_str()->group(group);
    }
  }
};

// Several option structs as one.
template <class... Options>
struct JoinedOptions {
  std::tuple<Options&...> parts;
  template <class V>
  void Visit(V&& v) {
    std::apply([&v](Options&... options) { (options.Visit(v), ...); }, parts);
  }
};

// One flag per field, --options FILE and --dump-options. Flags win over the file wherever they
// stand on the line, because the file is read as soon as it is named and flags are applied at the
// end. `options` must outlive the parse.
template <class... Options>
void AddOptions(CLI::App& job, Options&... options) {
  constexpr const char* kGroup = "Parameters";
  JoinedOptions<Options...> joined{{options...}};
  job.add_option_function<std::string>(
         "--options",
         [joined](const std::string& file) mutable {
           ReadOptionsText(ReadWholeFile(file, kMostJsonBytes), file, joined);
         },
         "JSON file with parameters; flags win over it.")
      ->type_name("FILE")
      ->trigger_on_parse()
      ->group(kGroup);
  joined.Visit(CliVisitor{job, kGroup});
  // Defined last, so that its callback runs after those of the flags above.
  job.add_flag_callback(
         "--dump-options",
         [joined] {
           std::printf("%s\n", OptionsText(joined, 2).c_str());
           throw CLI::Success();
         },
         "Print the parameters as JSON for --options, and do nothing else.")
      ->group(kGroup);
}

// Range of a field as command line and panels show it.
template <class Options>
Range ShownRange(std::string_view name) {
  const FieldFinder field = FindField<Options>(name);
  const double factor = PersonBorder(field.unit).factor;
  return {Shown(field.range.min * factor), Shown(field.range.max * factor), field.range.above_min};
}

}  // namespace arthro::app
