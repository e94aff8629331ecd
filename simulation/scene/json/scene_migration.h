// Versions of scene.json ("schema": "arthroscene.scene/N") [method.md, Scene]. An older file is
// brought to the newest version step by step before it is read; a newer one is refused by its name.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

namespace arthro {

inline constexpr int kSceneVersion = 2;

std::string SceneSchemaName(int version);

// Entry v turns a file of version v into one of version v + 1, in place; "schema" is updated here.
using SceneMigrations = std::map<int, void (*)(nlohmann::json&)>;

// The steps of this program. 1 to 2: "tasks" becomes "exercises", and the "text" of each its
// "brief".
const SceneMigrations& KnownSceneMigrations();

// Throws Error(kBadScene): no scene at all, a version newer than `newest`, or one with no way up.
void MigrateScene(nlohmann::json& json, const std::filesystem::path& file,
                  const SceneMigrations& migrations = KnownSceneMigrations(),
                  int newest = kSceneVersion);

}  // namespace arthro
