// Fields of an options struct (options.h) without their types, so that what reads, writes and
// checks them is compiled once. Options as JSON values: options_json.h.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "simulation/core/options.h"

namespace arthro {
namespace internal {

// An enumeration, by the words of its choices.
struct ChosenWord {
  std::vector<const char*> words;
  int chosen = -1;  // index in words; -1 if none stands for the value
  std::function<void(int)> choose;
};

struct OptionField {
  std::string name;
  std::string unit;
  std::variant<double*, int*, bool*, std::string*, ChosenWord> value;
  std::optional<Range> range;
};

struct FieldLister {
  std::vector<OptionField> fields = {};

  template <class T, class R>
  void operator()(const char* name, T& field, const R& rule, const char* unit, const char*) {
    OptionField& listed = fields.emplace_back();
    listed.name = name;
    listed.unit = unit;
    if constexpr (std::is_same_v<R, Range>) listed.range = rule;
    if constexpr (std::is_enum_v<T>) {
      ChosenWord choice;
      for (const auto& [value, word] : rule.words) {
        if (value == field) choice.chosen = static_cast<int>(choice.words.size());
        choice.words.push_back(word);
      }
      choice.choose = [&field, words = rule.words](int chosen) {
        field = words[static_cast<std::size_t>(chosen)].first;
      };
      listed.value = std::move(choice);
    } else {
      listed.value = &field;
    }
  }
};

// The fields point into `options`.
template <class Options>
std::vector<OptionField> ListFields(Options& options) {
  FieldLister lister;
  options.Visit(lister);
  return std::move(lister.fields);
}

void CheckFields(const std::vector<OptionField>& fields);
std::string FieldsText(const std::vector<OptionField>& fields, int indent);
void ReadFieldsText(std::string_view text, const std::filesystem::path& file,
                    const std::vector<OptionField>& fields);

}  // namespace internal

// Throws Error(kBadArgument) that names the first field outside its range.
template <class Options>
void CheckOptions(Options options) {
  internal::CheckFields(internal::ListFields(options));
}

// JSON text; a negative indent writes one line.
template <class Options>
std::string OptionsText(Options options, int indent = -1) {
  return internal::FieldsText(internal::ListFields(options), indent);
}

// Fields that `text` does not name keep their value. Throws Error(kBadData) as ReadOptions does.
template <class Options>
void ReadOptionsText(std::string_view text, const std::filesystem::path& file, Options& options) {
  internal::ReadFieldsText(text, file, internal::ListFields(options));
}

}  // namespace arthro
