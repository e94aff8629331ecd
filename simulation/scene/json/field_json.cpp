#include "simulation/scene/json/field_json.h"

#include <algorithm>
#include <charconv>

#include <glm/geometric.hpp>

namespace arthro {

const char* UnitInFile(std::string_view unit) {
  if (unit == "m") return "metres";
  if (unit == "rad") return "degrees";
  if (unit == "px") return "pixels";
  if (unit == "px/deg") return "pixels per degree";
  if (unit == "Pa") return "pascals";
  if (unit == "kg/m3") return "kg/m³";
  if (unit == "N" || unit == "N/m") return unit == "N" ? "newtons" : "newtons per metre";
  return "";
}

JsonLimits LimitsInFile(const Range& range, const char* unit) {
  const double factor = FileBorder(unit).factor;
  const auto shown = [factor](double limit) {
    return factor == 1.0 ? limit : std::stod(fmt::format("{:.12g}", limit * factor));
  };
  return {shown(range.min), shown(range.max), UnitInFile(unit), range.above_min};
}

double FileDegrees(double radians) {
  const double degrees = DegreesFromRadians(radians);
  if (!std::isfinite(degrees)) return degrees;
  for (int digits = 1; digits <= 16; ++digits) {
    const std::string text = fmt::format("{:.{}g}", degrees, digits);
    double candidate = 0;  // std::stod throws at numbers below 1e-308
    std::from_chars(text.data(), text.data() + text.size(), candidate);
    if (RadiansFromDegrees(candidate) == radians) return candidate;
  }
  return degrees;
}

void FieldReader::FaultOfWord(const char* name, const std::string& word,
                              const std::vector<const char*>& words) {
  reader_.Fault(name, fmt::format("is {}; it must be one of: {}", nlohmann::json(word).dump(),
                                  fmt::join(words, ", ")));
}

void FieldReader::ReadText(const char* name, std::string& field, const Words& rule, Need need) {
  std::string word;
  reader_.Text(name, word, need);
  if (!reader_.IsText(name)) return;
  if (std::find(rule.words.begin(), rule.words.end(), word) != rule.words.end())
    field = std::move(word);
  else
    FaultOfWord(name, word, {rule.words.begin(), rule.words.end()});
}

void FieldReader::ReadText(const char* name, std::string& field, const Name& rule, Need) {
  reader_.Text(name, field, JsonObjectReader::kRequired);
  if (field.empty()) return;
  if (std::find(rule.reserved.begin(), rule.reserved.end(), field) != rule.reserved.end())
    reader_.Fault(name, fmt::format("is a word that {}; choose another", rule.reserved_for));
  if (rule.is_table_cell && field.find_first_of(",\"\n\r") != std::string::npos)
    reader_.Fault(name,
                  "holds a comma, a quote or a line break, which tables cannot hold; remove it");
  if (names_ != nullptr && !names_->insert(field).second)
    reader_.Fault(name,
                  fmt::format("{} is used twice; give each its own", nlohmann::json(field).dump()));
}

void FieldReader::ReadNumbers(const char* name, std::vector<double>& field, const char* unit) {
  const Border border = FileBorder(unit);
  if (!reader_.List((name + std::string(border.suffix)).c_str(), field)) return;
  if (border.factor != 1.0)
    for (double& value : field) value /= border.factor;
}

void FieldReader::ReadPoint(const char* name, glm::dvec3& field, const Direction& rule,
                            const char* unit, Need need) {
  reader_.Point(name, field, LimitsInFile(rule.each, unit), need);
  if (!(glm::length(field) > 0.0))
    reader_.Fault(name, "is [0, 0, 0]; a direction cannot be all zeros");
}

void FieldWriter::WriteNumbers(const char* name, const std::vector<double>& field,
                               const char* unit) {
  if (std::string_view(unit) != "rad") {
    json_[name] = field;
    return;
  }
  for (const double value : field)
    json_[name + std::string(FileBorder(unit).suffix)].push_back(FileDegrees(value));
}

}  // namespace arthro
