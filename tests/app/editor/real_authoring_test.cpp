// The whole way of an author on real footage, by real mouse events in two sessions: clip, panorama,
// depth mended in one place and two models of the library; then both aligned by landmarks that
// agree on known poses, a tear, portals, saved, shared, opened again and practised. The second
// session is recorded, and its script without a window gives the same scene.
#include <chrono>
#include <cstdio>
#include <sstream>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/input_file.h"
#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/app/editor/landmark_clicks.h"
#include "tests/support/run_window.h"
#include "tests/support/shared_data.h"

namespace arthro {
namespace {

constexpr const char* kScreen = "1280x800x24";
// Size of the overview on its own in a window of 1280 x 800 px.
constexpr int kOverviewWidth = 950, kOverviewHeight = 720;

class RealAuthoring : public testing::Test {
 protected:
  std::string Path(const std::string& name) const { return (temp_ / name).string(); }
  void Drive(const std::string& arguments, const std::string& script) const {
    const auto result = test::RunWindow(arguments + " --size 1280x800", script, kScreen);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }

  // Every fourth frame: the panorama of all 250 takes four times as long.
  std::string FootageScript(const std::string& clip) const {
    return "click New\ndrop " + clip + R"(
wait job
click "More options"
set "Use every n-th frame" 4
click Run
wait job
expect "63 of 250 frames placed"
click "Use this panorama"
wait job
click Depth
wait job
click "Map of the depth"
click Brush
click Smooth
set Size 20
stroke "Depth map" -60 -20 -30 0 0 10 30 20
wait job
expect "Mend depth: Smooth"
click Tissue
click Library
click "Medial meniscus"
wait job
click Library
click "Loose body"
wait job
click "Save as…"
set "File name" )" +
           Path("placed") + R"(
click Save
wait job
expect "Saved in"
)";
  }

  std::string TissueScript(const std::string& meniscus, const std::string& body) const {
    return R"(do record-script
click Tissue
click "Overview alone"
wait frames 3
click Fit
click "medial meniscus"
click "Align by landmarks…"
click "Solve for the scale"
)" + meniscus +
           R"(wait frames 3
expect "Landmark 3"
expect not "Landmark 4"
click Align
wait frames 3
expect "Aligned medial meniscus to"
key escape
click "loose body"
click "Align by landmarks…"
)" + body +
           R"(wait frames 3
expect "Landmark 3"
click Align
wait frames 3
expect "Aligned loose body to"
key escape
click "Both views"
click "medial meniscus"
click Cut
click "Tears of a meniscus"
click "Make this tear"
wait job
expect "tear of"
click Portals
click "Scope, instrument"
wait frames 3
click "Anteromedial, anterolateral"
wait frames 3
click "Save as…"
set "File name" )" +
           Path("mine") + R"(
click Save
wait job
expect "Saved in"
do end-script )" +
           Path("session.script") + R"(
click "Save as…"
set "File name" )" +
           Path("shared.arthro") + R"(
click Save
wait job
expect "Saved in"
click "Open…"
set "File name" )" +
           Path("shared.arthro") + R"(
wait job
expect "Opened"
click Practice
click "Practise"
wait job
wait frames 20
expect "Leave practice"
)";
  }
  test::TempFolder temp_;
};

// A tissue stands where its landmarks put it. Sides of the triangles agree to 0.1 mm, and a px of
// the overview is 0.12 mm there; the vertex that is farthest from the landmarks moves most.
void ExpectPose(const LoadedScene& scene, int tissue, const Pose& wanted) {
  const Tissue& placed = scene.scene.tissues.at(std::size_t(tissue));
  double worst = 0;
  for (const glm::dvec3& x : scene.surfaces.at(std::size_t(tissue))->vertices)
    worst = std::max(worst, glm::distance(placed.pose * x, wanted * x));
  std::printf("%s: %.3f mm at its worst vertex, scale %.3f of %.3f\n", placed.name.c_str(),
              MmFromMetres(worst), placed.pose.scale, wanted.scale);
  EXPECT_LT(worst, 0.3e-3) << placed.name;
}

TEST_F(RealAuthoring, LeadsFromAClipToASharedSceneWithTwoAlignedModels) {
  ARTHRO_REQUIRE_SHARED(clip, "data/laparoscopy_rvim/endo.mp4");
  ARTHRO_REQUIRE_XVFB();
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_NO_FATAL_FAILURE(Drive("edit", FootageScript(clip.string())));
  const LoadedScene placed = LoadScene(Path("placed"));
  ASSERT_EQ(placed.scene.tissues.size(), 2u);
  ASSERT_TRUE(placed.depth);

  const test::OverviewEye eye(placed.scene.backdrop.radius, kOverviewWidth, kOverviewHeight);
  const auto meniscus = test::ClicksToPlace(placed, 0, 0.6, eye);
  ASSERT_EQ(meniscus.pairs.size(), 3u) << "no such triangle on the relief";
  LoadedScene aligned = placed;  // the second tissue is clicked beside the first at its new place
  aligned.scene.tissues[0].pose = meniscus.portal_from_tissue;
  const auto body = test::ClicksToPlace(aligned, 1, 1.0, eye);
  ASSERT_EQ(body.pairs.size(), 3u) << "no such triangle on the relief";

  ASSERT_NO_FATAL_FAILURE(
      Drive("edit " + Path("placed"), TissueScript(meniscus.Script(), body.Script())));
  const LoadedScene shared = LoadScene(Path("shared.arthro"));
  ASSERT_EQ(shared.scene.tissues.size(), 2u);
  ExpectPose(shared, 0, meniscus.portal_from_tissue);
  ExpectPose(shared, 1, body.portal_from_tissue);
  EXPECT_FALSE(shared.scene.tissues[0].cuts.empty());
  EXPECT_LT(shared.scene.portals.incision_spacing, 0) << "the portals changed sides";
  EXPECT_TRUE(shared.depth);

  std::filesystem::rename(Path("mine"), Path("by hand"));
  const auto again = test::RunProgram("run " + Path("session.script"),
                                      "env -u DISPLAY -u WAYLAND_DISPLAY HOME=" + Path("") +
                                          " LIBGL_ALWAYS_SOFTWARE=1 "
                                          "LP_NUM_THREADS=1");
  ASSERT_EQ(again.exit_code, 0) << again.err << ReadWholeFile(Path("session.script"));
  EXPECT_EQ(ReadWholeFile(Path("mine/scene.json")), ReadWholeFile(Path("by hand/scene.json")));
  std::printf("whole way: %.0f s\n",
              std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

}  // namespace
}  // namespace arthro
