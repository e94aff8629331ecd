#include "simulation/scene/json/scene_migration.h"

#include <charconv>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro {
namespace {

constexpr std::string_view kFamily = "arthroscene.scene/";

// The N of "arthroscene.scene/N"; 0 where it is not one.
int VersionOf(std::string_view schema) {
  if (!schema.starts_with(kFamily)) return 0;
  schema.remove_prefix(kFamily.size());
  int version = 0;
  const char* end = schema.data() + schema.size();
  const auto [stop, fault] = std::from_chars(schema.data(), end, version);
  return fault == std::errc() && stop == end && version > 0 ? version : 0;
}

// Moves the value of one key to another. A file that has both keeps both: the reader then refuses
// the old one.
void RenameKey(nlohmann::json& json, const char* from, const char* to) {
  const auto old = json.find(from);
  if (old == json.end() || json.contains(to)) return;
  nlohmann::json value = std::move(*old);
  json.erase(from);
  json[to] = std::move(value);
}

void ExercisesFromTasks(nlohmann::json& scene) {
  RenameKey(scene, "tasks", "exercises");
  const auto exercises = scene.find("exercises");
  if (exercises == scene.end() || !exercises->is_array()) return;
  for (nlohmann::json& exercise : *exercises)
    if (exercise.is_object()) RenameKey(exercise, "text", "brief");
}

}  // namespace

std::string SceneSchemaName(int version) { return fmt::format("{}{}", kFamily, version); }

const SceneMigrations& KnownSceneMigrations() {
  static const SceneMigrations steps = {{1, ExercisesFromTasks}};
  return steps;
}

void MigrateScene(nlohmann::json& json, const std::filesystem::path& file,
                  const SceneMigrations& migrations, int newest) {
  if (!json.is_object()) throw Error(Code::kBadScene, "a scene must be a JSON object {…}", file);
  const auto schema = json.find("schema");
  const int found =
      schema != json.end() && schema->is_string() ? VersionOf(schema->get<std::string>()) : 0;
  if (found == 0)
    throw Error(
        Code::kBadScene,
        fmt::format("this file is no scene: its schema {}, and that of a scene is \"{}\"; open the "
                    "folder of a scene, its scene.json or an .arthro file",
                    schema == json.end() ? "is missing" : "is " + schema->dump(),
                    SceneSchemaName(newest)),
        file);
  if (found > newest)
    throw Error(Code::kBadScene,
                fmt::format("this scene is written as {}, which is newer than this program (it "
                            "reads up to {}); install a newer Arthroscene",
                            SceneSchemaName(found), SceneSchemaName(newest)),
                file);
  for (int version = found; version < newest; ++version) {
    const auto step = migrations.find(version);
    if (step == migrations.end())
      throw Error(Code::kBadScene,
                  fmt::format("this scene is written as {}, which this program no longer reads; "
                              "open and save it with an older Arthroscene first",
                              SceneSchemaName(found)),
                  file);
    step->second(json);
    json["schema"] = SceneSchemaName(version + 1);
  }
}

}  // namespace arthro
