// A noisy depth map as the overview shows it. Draws without a window.
#include "app/editor/pictures/shown_backdrop.h"

#include <chrono>
#include <random>
#include <thread>

#include "app/editor/every_step.h"
#include "app/view/exposure/footage_light.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/plain_document.h"

namespace arthro::test {
namespace {

constexpr int kSize = 300;
constexpr float kError = 5e-4f;  // m

class ShownBackdropTest : public ViewTest {
 protected:
  ColourImage OverviewOf(const authoring::Document& document, const DepthMap& relief) const {
    app::Overview overview;
    overview.SetBackdrop(*document.panorama, relief,
                         app::WithKnownLight(document.scene.backdrop, *document.depth));
    overview.Render(kSize, kSize);
    return overview.ReadPixels();
  }
};

TEST_F(ShownBackdropTest, TheOverviewHasTheReliefWithoutItsNoise) {
  authoring::Document document = PlainDocument();
  ColourImage grey = *document.panorama;
  std::fill(grey.rgb.begin(), grey.rgb.end(), std::uint8_t{128});
  DepthMap noisy = *document.depth;
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0f, kError);
  for (float& height : noisy.relief) height += noise(random);
  document.panorama = Share(std::move(grey));
  document.depth = Share(std::move(noisy));
  document.depth_sigma = Share(DepthMap(document.depth->width, document.depth->height, kError));
  const app::EditorState state = app::MakeEditorState(document);

  app::ShownBackdrop shown;
  app::Overview overview;
  EXPECT_TRUE(shown.Take(state, *view_, overview)) << "a rough relief at once";
  while (shown.busy()) {
    shown.Collect();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_TRUE(shown.Take(state, *view_, overview)) << "the quiet one when it is made";
  EXPECT_FALSE(shown.Take(state, *view_, overview)) << "and then nothing changes";
  overview.Render(kSize, kSize);

  const app::DrawnRelief quiet = app::MakeDrawnRelief(
      {document.panorama->width, document.panorama->height}, *document.depth, *document.depth_sigma,
      app::WithKnownLight(document.scene.backdrop, *document.depth));
  EXPECT_EQ(overview.ReadPixels().rgb, OverviewOf(document, quiet.sampled).rgb);
  EXPECT_NE(overview.ReadPixels().rgb, OverviewOf(document, *document.depth).rgb);
}

}  // namespace
}  // namespace arthro::test
