// The touch preview on the demo, whose tissues lie close to each other: without a window.
#include "app/steps/depth/touch_probe.h"

#include <map>

#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "simulation/core/units.h"
#include "tests/support/build_paths.h"

namespace arthro::app {
namespace {

// The gap between the condyle and the meniscus is narrower than the free way in front of a surface:
// the probe touched the condyle, and was pressed where nothing is.
TEST(TouchPreviewOfTheDemo, FeelsEveryTissueInSight) {
  const auto demo = std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/demo";
  const EditorState state = MakeEditorState(OpenSceneDocument(demo));
  const Scene& scene = state.document().scene;
  TouchProbe probe(state.document(), {}, TipStiffness(scene, state.tissue_presets));
  simulation::RodPose pose;
  pose.depth = 15e-3, pose.latitude = RadiansFromDegrees(-21.4);
  const simulation::ScopeOptics optics;
  const simulation::ScopeView view = simulation::ViewFromPose(pose, scene.scope.view_angle);
  struct Count {
    int seen = 0, felt = 0, reached = 0;
  };
  std::map<std::string, Count> counts;
  constexpr int kAcross = 24;
  for (int y = 0; y < kAcross; ++y)
    for (int x = 0; x < kAcross; ++x) {
      const auto sight = authoring::SightOfScope(optics, view, kAcross, {x + 0.5, y + 0.5});
      if (!sight) continue;
      const auto hit = probe.TissueAlong(*sight, 2 * scene.backdrop.radius);
      if (!hit) continue;
      const TouchReading reading = probe.PressTissue(hit->point, hit->tissue, hit->normal, 1e-3);
      Count& count = counts[scene.tissues[static_cast<std::size_t>(hit->tissue)].name];
      ++count.seen;
      count.felt += reading.tip_force > 0 ? 1 : 0;
      count.reached += reading.is_reached ? 1 : 0;
    }
  for (const char* const name : {"medial meniscus", "tibial cartilage"}) {
    const Count& count = counts[name];
    EXPECT_GE(count.seen, 30) << name;
    EXPECT_EQ(count.felt, count.seen) << name;
    EXPECT_GE(count.reached, 0.9 * count.seen) << name;
  }
}

}  // namespace
}  // namespace arthro::app
