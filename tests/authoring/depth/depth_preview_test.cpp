#include "authoring/depth/depth_preview.h"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/support/knee_picture.h"
#include "tests/support/preview_error.h"

namespace arthro::authoring {
namespace {

TEST(DepthPreview, ASmallPanoramaIsItsOwnPreview) {
  const ColourImage knee = test::KneePicture(300, 200);
  const DepthPreview preview(knee);
  EXPECT_EQ(preview.Factor(), 1);
  const DepthMap small = preview.Filter({}), whole = DepthFromColour(knee, {});
  EXPECT_EQ(std::memcmp(small.relief.data(), whole.relief.data(), whole.relief.size() * 4), 0);
}

TEST(DepthPreview, FitsThePixelsThatAreAskedFor) {
  const DepthPreview preview(test::KneePicture(2050, 1027));
  for (const int most : {1 << 18, 1 << 16, 1 << 15, 1 << 14}) {
    const DepthMap depth = preview.Filter({}, nullptr, most);
    EXPECT_LE(depth.width * depth.height, most);
    const int factor = preview.Factor(most);
    EXPECT_EQ(depth.width, (2050 + factor - 1) / factor);
    EXPECT_EQ(depth.height, (1027 + factor - 1) / factor);
    EXPECT_EQ(preview.Picture(most).width, depth.width);
  }
}

// The preview is for choosing options, so it must resemble the full result. Tolerance: a hundredth
// of the relief of 20 mm on average (2 or 3 steps of 8-bit grey), and a twentieth for 99 % of the
// pixels.
TEST(DepthPreview, IsCloseToTheWholeResult) {
  const ColourImage knee = test::KneePicture(2048, 1024);
  const DepthPreview preview(knee);
  ASSERT_GT(preview.Factor(), 1);
  for (const DepthLaw law : {DepthLaw::kLinear, DepthLaw::kInverseSquare})
    for (const int radius : {0, 2, 6}) {
      DepthOptions options;
      options.law = law;
      options.median_radius = radius;
      const auto error = test::PreviewErrorOf(preview.Filter(options),
                                              DepthFromColour(knee, options), preview.Factor());
      std::printf("law %d, radius %d: %s\n", static_cast<int>(law), radius, error.Text().c_str());
      EXPECT_LT(error.mean, 0.0002);
      EXPECT_LT(error.p99, 0.001);
      EXPECT_LT(error.disagree, 0.02);
    }
}

}  // namespace
}  // namespace arthro::authoring
