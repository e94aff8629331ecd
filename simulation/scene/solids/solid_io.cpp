#include "simulation/scene/solids/solid_io.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/scene/json/field_json.h"
#include "simulation/scene/json/field_schema.h"
#include "simulation/scene/json/scene_json.h"

namespace arthro {
namespace {

constexpr const char* kSchema = "arthroscene.solid/1";

}  // namespace

bool IsSolidFile(const std::filesystem::path& file) { return file.extension() == ".solid"; }

Solid ParseSolid(const std::string& text, const std::filesystem::path& file) {
  const nlohmann::json json = ParseJson(text, Code::kBadMesh, file);
  if (!json.is_object())
    throw Error(Code::kBadMesh, "a solid must be a JSON object {…}; mend or remove it", file);
  std::vector<JsonFault> faults;
  JsonObjectReader reader(json, "", faults);
  std::string schema;
  reader.Text("schema", schema, JsonObjectReader::kRequired);
  if (schema != kSchema && !schema.empty())
    throw Error(Code::kBadMesh,
                fmt::format("its schema is \"{}\"; this program reads \"{}\"", schema, kSchema),
                file);
  Solid solid;
  solid.Visit(FieldReader(reader));
  reader.RefuseOtherKeys(true);
  if (!faults.empty()) throw Error(Code::kBadMesh, faults.front().sentence, file);
  if (const std::string fault = FaultOfSolid(solid); !fault.empty())
    throw Error(Code::kBadMesh, fault, file);
  return solid;
}

Solid ReadSolid(const std::filesystem::path& file) {
  return ParseSolid(ReadWholeFile(file, kMostJsonBytes), file);
}

std::string JsonFromSolid(const Solid& solid) {
  nlohmann::ordered_json json;
  json["schema"] = kSchema;
  Solid copy = solid;
  copy.Visit(FieldWriter(json));
  return PrettyJson(json);
}

void WriteSolid(const std::filesystem::path& file, const Solid& solid) {
  WriteAtomically(file, JsonFromSolid(solid));
}

std::string SolidSchemaText() {
  auto json = FileSchema(
      kSchema, "Arthroscene solid, version 1",
      "A tissue given by functions: primitives that are joined in the order of the list. SI units, "
      "the tissue's own frame. This schema cannot express three rules. The first part is a union "
      "of level 0. A level rises by one at a time. The solid has an end and is not empty.",
      SchemaOfFields(Solid()));
  json["definitions"]["quaternion"] = FieldDefinitions()["quaternion"];
  return PrettyJson(json);
}

}  // namespace arthro
