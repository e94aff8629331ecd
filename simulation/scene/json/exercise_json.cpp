#include "simulation/scene/json/exercise_json.h"

#include "simulation/core/json_text.h"
#include "simulation/core/sha256.h"
#include "simulation/scene/json/field_json.h"

namespace arthro {

std::string CanonicalJson(Exercise exercise) {
  exercise.ghost.clear();
  nlohmann::ordered_json fields = nlohmann::ordered_json::object();
  exercise.Visit(FieldWriter(fields));
  const nlohmann::json sorted = fields;
  return sorted.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Exercise ExerciseFromJson(std::string_view text) {
  const nlohmann::json json = ParseJson(text, Code::kBadData);
  if (!json.is_object())
    throw Error(Code::kBadData, "the exercise is no JSON object; import the records again");
  std::vector<JsonFault> faults;
  JsonObjectReader reader(json, "", faults);
  Exercise exercise;
  exercise.Visit(FieldReader(reader));
  if (!faults.empty())
    throw Error(Code::kBadData, "the exercise in the records: " + faults[0].sentence);
  return exercise;
}

std::string HashOf(const Exercise& exercise) { return Sha256(CanonicalJson(exercise)); }

}  // namespace arthro
