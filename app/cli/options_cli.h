// Options as command-line flags, by their one list of fields (simulation/core/options.h): lengths
// as
// --name-mm, angles as --name-deg, enums by their words, with range, unit and default in the help.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/json_text.h"
#include "simulation/core/options.h"
#include "simulation/core/options_json.h"

namespace arthro::app {

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
      const double factor = border.factor;
      auto* option = job.add_option_function<double>(
          flag,
          [target, factor, flag](double shown) {
            if (!std::isfinite(shown)) throw CLI::ValidationError(flag, "must be a finite number");
            *target = shown / factor;
          },
          text);
      if constexpr (std::is_same_v<R, Range>)
        option->check(CLI::Range(range.min * factor, range.max * factor));
      option->default_str(fmt::format("{:g}", field * factor))->group(group);
    } else {
      auto* option = job.add_option(flag, field, text)->capture_default_str()->group(group);
      if constexpr (std::is_same_v<R, Range> && std::is_arithmetic_v<T>)
        option->check(CLI::Range(static_cast<T>(range.min), static_cast<T>(range.max)));
    }
  }
};

// `options` must outlive the parse.
template <class Options>
void AddOptions(CLI::App& job, Options& options, const std::string& group = "Options") {
  CliVisitor visitor{job, group};
  options.Visit(visitor);
}

// --options FILE: options as JSON. Flags win over the file wherever they stand on the line, since
// the file is read as soon as it is named and flags are applied at the end.
template <class Options>
void AddOptionsFile(CLI::App& job, Options& options) {
  job.add_option_function<std::string>(
         "--options",
         [&options](const std::string& file) {
           options = OptionsFromJson<Options>(ParseJson(ReadWholeFile(file), Code::kBadData, file),
                                              file, options);
         },
         "JSON file with options; flags win over it")
      ->trigger_on_parse();
}

}  // namespace arthro::app
