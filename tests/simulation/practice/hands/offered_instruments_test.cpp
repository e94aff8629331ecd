#include "simulation/practice/hands/offered_instruments.h"

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

TEST(OfferedInstruments, AreThoseOfTheSceneInTheOrderOfTheKeys) {
  Scene scene;
  scene.instruments = {{"shaver", "shaver"}, {"hook", "probe"}, {"second hook", "probe"}};
  EXPECT_EQ(OfferedInstruments(scene), (std::vector{ToolKind::kProbe, ToolKind::kShaver}));
  EXPECT_TRUE(IsOffered(scene, ToolKind::kShaver));
  EXPECT_FALSE(IsOffered(scene, ToolKind::kPunch));
}

TEST(OfferedInstruments, AreAllWhereTheSceneListsNone) {
  EXPECT_EQ(OfferedInstruments({}).size(), 4u);
}

TEST(OfferedInstruments, TheNextOneSkipsWhatIsNotOffered) {
  const std::vector offered{ToolKind::kProbe, ToolKind::kShaver};
  EXPECT_EQ(NextOffered(offered, ToolKind::kProbe), ToolKind::kShaver);
  EXPECT_EQ(NextOffered(offered, ToolKind::kShaver), ToolKind::kProbe);
  EXPECT_EQ(NextOffered({ToolKind::kGrasper}, ToolKind::kGrasper), ToolKind::kGrasper);
}

}  // namespace
}  // namespace arthro::simulation
