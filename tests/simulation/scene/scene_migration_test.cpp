#include "simulation/scene/json/scene_migration.h"

#include <gtest/gtest.h>

#include "simulation/core/error.h"

namespace arthro {
namespace {

using nlohmann::json;

std::string FaultOf(json scene, const SceneMigrations& steps, int newest) {
  try {
    MigrateScene(scene, "scene.json", steps, newest);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SceneMigration, StepsRunInOrderUpToTheNewest) {
  const SceneMigrations steps = {
      {1, [](json& scene) { scene["log"] = scene["log"].get<std::string>() + "a"; }},
      {2, [](json& scene) { scene["log"] = scene["log"].get<std::string>() + "b"; }}};
  json scene = {{"schema", "arthroscene.scene/1"}, {"log", ""}};
  MigrateScene(scene, "scene.json", steps, 3);
  EXPECT_EQ(scene["log"], "ab");
  EXPECT_EQ(scene["schema"], "arthroscene.scene/3");
  json newer = {{"schema", "arthroscene.scene/2"}, {"log", ""}};
  MigrateScene(newer, "scene.json", steps, 3);
  EXPECT_EQ(newer["log"], "b");
}

TEST(SceneMigration, NewestIsLeftAlone) {
  json scene = {{"schema", SceneSchemaName(kSceneVersion)}, {"title", "t"}};
  const json before = scene;
  MigrateScene(scene, "scene.json");
  EXPECT_EQ(scene, before);
}

TEST(SceneMigration, TurnsTasksOfTheFirstVersionIntoExercises) {
  json scene = {{"schema", "arthroscene.scene/1"},
                {"tasks", {{{"id", "look"}, {"title", "Look"}, {"text", "Find the horn."}}}}};
  MigrateScene(scene, "scene.json");
  EXPECT_EQ(
      scene,
      (json{{"schema", "arthroscene.scene/2"},
            {"exercises", {{{"id", "look"}, {"title", "Look"}, {"brief", "Find the horn."}}}}}));
}

TEST(SceneMigration, LeavesAFirstVersionWithoutTasksAsItWas) {
  json scene = {{"schema", "arthroscene.scene/1"}, {"title", "t"}, {"tasks", 5}};
  MigrateScene(scene, "scene.json");
  EXPECT_EQ(scene["exercises"], 5);  // for the reader to refuse
  EXPECT_EQ(scene["title"], "t");
}

TEST(SceneMigration, RefusesANewerVersionByName) {
  const std::string fault = FaultOf({{"schema", "arthroscene.scene/7"}}, {}, 1);
  EXPECT_NE(fault.find("arthroscene.scene/7"), std::string::npos) << fault;
  EXPECT_NE(fault.find("newer"), std::string::npos) << fault;
}

TEST(SceneMigration, RefusesWhatIsNoScene) {
  for (const json& scene :
       {json::array(), json::object(), json{{"schema", 1}}, json{{"schema", "arthroscene.lens/1"}},
        json{{"schema", "arthroscene.scene/"}}, json{{"schema", "arthroscene.scene/1x"}},
        json{{"schema", "arthroscene.scene/-1"}}, json{{"schema", "arthroscene.scene/0"}},
        json{{"schema", "arthroscene.scene/99999999999999999999"}}})
    EXPECT_NE(FaultOf(scene, {}, 1), "") << scene;
}

TEST(SceneMigration, RefusesAVersionWithNoWayUp) {
  EXPECT_NE(FaultOf({{"schema", "arthroscene.scene/1"}}, {}, 2).find("no longer"),
            std::string::npos);
}

}  // namespace
}  // namespace arthro
