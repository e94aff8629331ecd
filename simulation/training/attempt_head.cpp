#include "simulation/training/attempt_head.h"

#include "simulation/core/json_text.h"
#include "simulation/scene/json/field_json.h"

namespace arthro::simulation {

std::string AttemptHeadText(AttemptHead head) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  head.Visit(FieldWriter(json));
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

AttemptHead AttemptHeadOf(std::string_view text, const std::filesystem::path& file) {
  const nlohmann::json json = ParseJson(text, Code::kBadData, file);
  if (!json.is_object())
    throw Error(Code::kBadData, "the head of this attempt is no JSON object; record it again",
                file);
  std::vector<JsonFault> faults;
  JsonObjectReader reader(json, "", faults);
  AttemptHead head;
  head.Visit(FieldReader(reader));
  if (!faults.empty()) throw Error(Code::kBadData, faults[0].sentence, file);
  return head;
}

}  // namespace arthro::simulation
