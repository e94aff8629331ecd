// Structure that a tissue's look draws, in pictures.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "tests/app/view/view_scene.h"

namespace arthro::test {
namespace {

using app::PictureFromPose;

class TissuePattern : public ViewTest {};

// Flat crescent that faces the portal.
SurfaceMesh FlatCrescent(double inner, double outer) {
  constexpr int kAlong = 160, kAcross = 24;
  constexpr double kHalfSweep = 2.2;  // rad
  SurfaceMesh mesh;
  for (int i = 0; i <= kAlong; ++i)
    for (int j = 0; j <= kAcross; ++j) {
      const double a = kHalfSweep * (2.0 * i / kAlong - 1.0);
      const double r = inner + (outer - inner) * j / kAcross;
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), 0.0);
    }
  const auto at = [](int i, int j) { return i * (kAcross + 1) + j; };
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAcross; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return mesh;
}

// Capillaries were zeros of a noise: loops and blobs amid the tissue.
TEST_F(TissuePattern, CapillariesOfACrescentEnterAtItsRim) {
  constexpr int kSize = 900, kDark = 12, kLeast = 12;  // px, grey levels, px of a capillary
  LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
  Tissue tissue;
  tissue.pose.position = {0, 0, 0.030};
  const auto crescent = Share(FlatCrescent(0.004, 0.010));
  const auto drawn = [&](double vessels, const glm::dvec3& tint) {
    simulation::TissueLook look;
    look.structure = simulation::TissueStructure::kFibres;
    look.tint = tint;
    look.rim_tint = glm::dvec3(1.0);
    look.vessel_colour = glm::dvec3(0.0);
    look.vessels = vessels;
    view_->SetTissues(std::span(&tissue, 1), std::vector{crescent}, std::span(&look, 1));
    view_->Render(PictureFromPose({0, 0, 0, 0.016}, 0.0, 1.4), kSize);
    return view_->ReadPixels();
  };
  const ColourImage plain = drawn(0, glm::dvec3(1.0)), veined = drawn(1, glm::dvec3(1.0)),
                    dark = drawn(0, glm::dvec3(0.0));
  const auto differ = [&](const ColourImage& other, int i) {
    const std::size_t green = 3 * static_cast<std::size_t>(i) + 1;
    return int(plain.rgb[green]) - int(other.rgb[green]) > kDark;
  };
  const auto radius = [&](int i) {
    const int x = i % kSize, y = i / kSize;
    return std::hypot(x - 0.5 * (kSize - 1), y - 0.5 * (kSize - 1));
  };
  double outer = 0, inner = kSize;
  for (int i = 0; i < kSize * kSize; ++i)
    if (differ(dark, i)) outer = std::max(outer, radius(i)), inner = std::min(inner, radius(i));
  ASSERT_GT(outer - inner, 0.2 * kSize) << "the crescent fills the picture";
  cv::Mat1b lines(kSize, kSize);
  for (int i = 0; i < kSize * kSize; ++i) lines(i / kSize, i % kSize) = differ(veined, i) ? 255 : 0;
  cv::Mat1i label;
  const int labels = cv::connectedComponents(lines, label, 8);
  std::vector<int> size(std::size_t(labels), 0);
  std::vector<double> furthest(std::size_t(labels), 0.0);
  for (int i = 0; i < kSize * kSize; ++i) {
    const auto of = std::size_t(label(i / kSize, i % kSize));
    ++size[of];
    furthest[of] = std::max(furthest[of], radius(i));
  }
  int capillaries = 0, lost = 0;
  for (std::size_t of = 1; of < size.size(); ++of) {  // 0: between them
    if (size[of] < kLeast) continue;
    ++capillaries;
    lost += furthest[of] < outer - 0.15 * (outer - inner);
  }
  std::printf("%d capillaries, %d of them amid the tissue\n", capillaries, lost);
  EXPECT_GE(capillaries, 3);
  EXPECT_EQ(lost, 0);
}

}  // namespace
}  // namespace arthro::test
