// Steadiness of the picture of a scope that is held still, while what it shows trembles at rest.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "app/view/live_tissues.h"
#include "app/view/settling.h"
#include "simulation/practice/replay/replay.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/build_paths.h"

namespace arthro::test {
namespace {

using app::InstrumentView;
using app::Picture;

constexpr int kStillSize = 256;
constexpr int kFrames = 24;
constexpr int kMostChange = 2;                  // levels of 255 between two frames
constexpr double kTremble = 0.4 * app::kStill;  // m; the cycle is shorter than kStill
constexpr double kFrameTime = 0.04;             // s

int LargestChange(const ColourImage& before, const ColourImage& now) {
  int most = 0;
  for (std::size_t i = 0; i < now.rgb.size(); ++i)
    most = std::max(most, std::abs(int(now.rgb[i]) - int(before.rgb[i])));
  return most;
}

class StillScope : public ViewTest {
 protected:
  // Largest change between neighbouring frames of a film. Ring and probe tremble in a cycle of two
  // frames, as a contact at rest does; `settles`: they are drawn as practice draws them.
  int LargestChangeOfFilm(bool settles) {
    LoadedScene loaded = MakeViewScene();
    loaded.scene.backdrop.relight = 1;
    view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
    std::vector<simulation::TissueLook> looks(1);
    looks[0].structure = simulation::TissueStructure::kFibres;
    looks[0].fibres = looks[0].vessels = 1;
    view_->SetTissues(loaded.scene.tissues, loaded.surfaces, looks);
    Picture picture = app::PictureFromPose({-0.1, 0.1, 0.2, 0.01}, 0.5, std::numbers::pi / 2);
    picture.camera = LensCamera();
    picture.relief = app::kUsualRelief;
    picture.samples = 2;
    const InstrumentView held = ProbeInFront();
    const std::vector<glm::dvec3>& rest = loaded.surfaces[0]->vertices;
    std::vector<glm::dvec3> drawn = rest;
    app::LiveTissues live;
    ColourImage before;
    int most = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
      const glm::dvec3 off(frame % 2 == 0 ? kTremble : -kTremble, 0.5 * kTremble, 0);
      InstrumentView tool = held;
      tool.proxy += off;
      std::vector<glm::dvec3> now = rest;
      for (glm::dvec3& place : now) place += off;
      if (settles) {
        tool = live.Settled(tool);
        for (std::size_t v = 0; v < now.size(); ++v) app::Settle(now[v], drawn[v]);
        now = drawn;
      }
      picture.instrument = tool;
      view_->SetTissueShape(0, now);
      picture.disturbances.time = kFrameTime * frame;
      view_->Render(picture, kStillSize);
      ColourImage shown = view_->ReadPixels();
      if (frame > 0) most = std::max(most, LargestChange(before, shown));
      before = std::move(shown);
    }
    return most;
  }
};

TEST_F(StillScope, ChangesByTwoLevelsAtMostWhileContactsTremble) {
  EXPECT_LE(LargestChangeOfFilm(true), kMostChange);
}

TEST_F(StillScope, WouldTrembleIfPlacesWereDrawnAsSimulated) {
  EXPECT_GT(LargestChangeOfFilm(false), kMostChange);
}

// The demo with all that practice shows but flecks: relief, lamp, structure of the tissues, camera,
// and tissue that is simulated under an instrument. Both hands are held where the demo's trace has
// them at `moment`, s; `is_touched`: the probe touches a tissue there. Returns the largest change
// between neighbouring frames of the second second.
int LargestChangeOfDemo(double moment, bool is_touched) {
  const std::string resources = std::string(ARTHRO_SOURCE_DIR) + "/resources";
  const LoadedScene loaded = LoadScene(resources + "/demo");
  const auto presets = simulation::ReadTissuePresets(resources + "/presets/tissues");
  simulation::Recording held;
  for (const simulation::TraceRow& row : simulation::ReadTrace(resources + "/demo/trace.csv")) {
    if (std::abs(row.sample.t - moment) > 1e-6) continue;
    for (int i = 0; i <= 200; ++i) {
      held.rows.push_back(row);
      held.rows.back().sample.t = 0.01 * i;
    }
  }
  std::ranges::stable_sort(held.rows, {}, [](const auto& row) { return row.sample.t; });
  EXPECT_EQ(held.rows.size(), 402u);
  app::StillPictures pictures(loaded, simulation::LooksOf(loaded.scene.tissues, presets));
  const simulation::ScopeOptics optics = simulation::OpticsOf(loaded.scene.scope, loaded.lens);
  app::LiveTissues live;
  ColourImage before;
  int most = 0, frames = 0, touched = 0;
  double next = 0;
  simulation::Replay(loaded, held, {}, {}, nullptr, presets,
                     [&](double t, const auto& snapshot, const auto* world) {
                       if (t < next) return;
                       next += kFrameTime;
                       live.Show(*world, loaded.scene.tissues, pictures.view(), nullptr);
                       pictures.eye().Follow(*world);
                       Picture picture =
                           app::PictureOf(snapshot, pictures.eye().MoveTo(snapshot.scope),
                                          snapshot.kind, optics, {.is_upright = true});
                       picture.instrument = live.Settled(*picture.instrument);
                       picture.samples = 2;
                       picture.disturbances.time = t;
                       pictures.view().Render(picture, kStillSize);
                       ColourImage shown = pictures.view().ReadPixels();
                       if (t > 1.0) {
                         most = std::max(most, LargestChange(before, shown));
                         touched += snapshot.instrument.contact > 0 ? 1 : 0;
                         ++frames;
                       }
                       before = std::move(shown);
                     });
  EXPECT_GE(frames, 20);
  EXPECT_EQ(touched, is_touched ? frames : 0);
  std::printf("demo at %.2f s: %d levels at most, tissue touched in %d of %d frames\n", moment,
              most, touched, frames);
  return most;
}

TEST_F(StillScope, OfTheDemoChangesByTwoLevelsAtMost) {
  EXPECT_LE(LargestChangeOfDemo(5.0, false), kMostChange);
}

TEST_F(StillScope, OfTheDemoChangesByTwoLevelsAtMostWithAProbeThatPressesOnCartilage) {
  EXPECT_LE(LargestChangeOfDemo(8.5, true), kMostChange);
}

}  // namespace
}  // namespace arthro::test
