#include "simulation/core/options_json.h"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "simulation/core/error.h"
#include "simulation/core/json_text.h"

namespace arthro::internal {
namespace {

using nlohmann::json;

// `factor`: from the unit in memory to the one that is shown.
std::string ToString(const Range& range, double factor) {
  return fmt::format("{} {} and {}{}", range.above_min ? "more than" : "between",
                     range.min * factor, range.above_min ? "at most " : "", range.max * factor);
}

std::string KeyOf(const OptionField& field) { return field.name + FileBorder(field.unit).suffix; }

// Reads one value of a JSON object into the field that it is for.
struct ValueReader {
  const json& value;
  const OptionField& field;
  const std::filesystem::path& file;

  void operator()(double* target) const {
    if (!value.is_number()) Refuse("a number");
    *target = Number();
  }

  void operator()(int* target) const {
    if (!value.is_number_integer()) Refuse("a whole number");
    const double number = Number();
    using Int = std::numeric_limits<int>;
    if (number < Int::min() || number > Int::max())
      Refuse(fmt::format("a whole number between {} and {}", Int::min(), Int::max()));
    *target = static_cast<int>(number);
  }

  void operator()(bool* target) const {
    if (!value.is_boolean()) Refuse("true or false");
    *target = value.get<bool>();
  }

  void operator()(std::string* target) const {
    if (!value.is_string()) Refuse("text");
    *target = value.get<std::string>();
  }

  void operator()(const ChosenWord& choice) const {
    const auto word = std::find_if(choice.words.begin(), choice.words.end(),
                                   [this](const char* each) { return value == each; });
    if (word == choice.words.end()) Refuse(fmt::format("one of {}", fmt::join(choice.words, ", ")));
    choice.choose(static_cast<int>(word - choice.words.begin()));
  }

  // In the unit in memory, within the range.
  double Number() const {
    const double factor = FileBorder(field.unit).factor;
    const double number = value.get<double>() / factor;
    if (field.range && !Contains(*field.range, number)) Refuse(ToString(*field.range, factor));
    return number;
  }

  [[noreturn]] void Refuse(const std::string& wanted) const {
    throw Error(
        Code::kBadData,
        fmt::format("option \"{}\" is {}; it must be {}", KeyOf(field), value.dump(), wanted),
        file);
  }
};

struct ValueWriter {
  json& target;
  double factor;

  void operator()(const double* value) const { target = *value * factor; }
  void operator()(const ChosenWord& choice) const {
    target = choice.words[static_cast<std::size_t>(choice.chosen)];
  }
  template <class T>
  void operator()(const T* value) const {
    target = *value;
  }
};

void CheckNumber(const OptionField& field, double value) {
  if (!field.range || Contains(*field.range, value)) return;
  const Border border = PersonBorder(field.unit);
  throw Error(Code::kBadArgument,
              fmt::format("option {}{} is {}; it must be {}", field.name, border.suffix,
                          value * border.factor, ToString(*field.range, border.factor)));
}

}  // namespace

json JsonFromFields(const std::vector<OptionField>& fields) {
  json all = json::object();
  for (const OptionField& field : fields) {
    const auto* choice = std::get_if<ChosenWord>(&field.value);
    if (choice && choice->chosen < 0) continue;
    std::visit(ValueWriter{all[KeyOf(field)], FileBorder(field.unit).factor}, field.value);
  }
  return all;
}

void ReadFields(const json& all, const std::filesystem::path& file,
                const std::vector<OptionField>& fields) {
  if (!all.is_object()) throw Error(Code::kBadData, "options must be a JSON object {…}", file);
  std::set<std::string> known{"schema"};
  for (const OptionField& field : fields) {
    const auto entry = all.find(*known.insert(KeyOf(field)).first);
    if (entry != all.end()) std::visit(ValueReader{*entry, field, file}, field.value);
  }
  for (const auto& [key, value] : all.items())
    if (!known.contains(key))
      throw Error(Code::kBadData,
                  fmt::format("option \"{}\" is not known; see --help for the list", key), file);
}

void CheckFields(const std::vector<OptionField>& fields) {
  for (const OptionField& field : fields) {
    if (const auto* number = std::get_if<double*>(&field.value)) CheckNumber(field, **number);
    if (const auto* whole = std::get_if<int*>(&field.value)) CheckNumber(field, **whole);
  }
}

std::string FieldsText(const std::vector<OptionField>& fields, int indent) {
  return JsonFromFields(fields).dump(indent);
}

void ReadFieldsText(std::string_view text, const std::filesystem::path& file,
                    const std::vector<OptionField>& fields) {
  ReadFields(ParseJson(text, Code::kBadData, file), file, fields);
}

}  // namespace arthro::internal
