#include "simulation/scene/json/exercise_json.h"

#include "simulation/core/sha256.h"
#include "simulation/scene/json/field_json.h"

namespace arthro {

std::string CanonicalJson(Exercise exercise) {
  nlohmann::ordered_json fields = nlohmann::ordered_json::object();
  exercise.Visit(FieldWriter(fields));
  const nlohmann::json sorted = fields;
  return sorted.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string HashOf(const Exercise& exercise) { return Sha256(CanonicalJson(exercise)); }

}  // namespace arthro
