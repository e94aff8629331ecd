// The relief of a backdrop against the reference tracer: distance, colour of steps, occlusion.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <utility>

#include <glm/geometric.hpp>

#include "app/view/backdrop/backdrop_texture.h"
#include "app/view/backdrop/relief_outlines.h"
#include "simulation/core/units.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/build_paths.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::test {
namespace {

using app::Picture;
using app::PictureFromPose;

class BackdropRelief : public ViewTest {};

// A bulge of 8 mm and a step of 6 mm, where near parts hide far ones.
LoadedScene CliffScene(bool is_equirectangular) {
  LoadedScene loaded = MakeViewScene(512, 384);
  Projection& projection = loaded.scene.backdrop.projection;
  if (is_equirectangular) {
    projection.type = ProjectionType::kEquirectangular;
    projection.px_per_deg = 4;
  }
  DepthMap depth = *loaded.depth;
  for (int y = 0; y < depth.height; ++y)
    for (int x = 0; x < depth.width; ++x) depth.at(x, y) += x + y / 3 < 230 ? 0.006f : 0.0f;
  loaded.depth = Share(std::move(depth));
  return loaded;
}

// Depth map with the outlines that the view draws.
DepthMap WithSmoothOutlines(DepthMap depth) {
  app::SmoothOutlines(depth, false);
  return depth;
}

struct ReliefAgreement {
  int compared = 0, elsewhere = 0;  // pixels; off by more than 0.1 mm
  int worst_colour = 0;             // levels of 255, for the other pixels
  double worst = 0;                 // m
};
// Within the window and the panorama, without their edges.
ReliefAgreement CompareWithTraced(const ColourImage& drawn, const std::vector<float>& distances,
                                  const TracedPicture& traced, const Picture& picture,
                                  const Projection& projection) {
  ReliefAgreement result;
  const int size = drawn.width;
  const double half = 0.5 * (size - 1);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const auto ray = ReferenceRay(picture.view, picture.field_of_view, size, {x, y});
      if (!ray || std::hypot(x - half, y - half) > half - 1.5) continue;
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                            static_cast<std::size_t>(x);
      const auto pixel = ReferencePixel(projection, picture.view.tip + traced.distance[i] * *ray);
      if (!pixel || pixel->x < 1 || pixel->y < 1 || pixel->x > 510 || pixel->y > 382) continue;
      ++result.compared;
      const double off = std::abs(static_cast<double>(distances[i]) - traced.distance[i]);
      if (off > 0.1e-3) {
        ++result.elsewhere;
        continue;
      }
      result.worst = std::max(result.worst, off);
      for (int c = 0; c < 3; ++c)
        result.worst_colour =
            std::max(result.worst_colour,
                     std::abs(int{drawn.at(x, y)[c]} - int{traced.colours.at(x, y)[c]}));
    }
  return result;
}

// Bound on the depth: 0.1 mm at 20 mm. Where a crest runs through a pixel, one of the two may see
// its near side and the other what is behind it; a crest crosses some 1 % of 96 x 96 pixels.
TEST_F(BackdropRelief, ReliefDistanceAgreesWithTheReferenceTracer) {
  for (const bool is_equirectangular : {false, true}) {
    const LoadedScene loaded = CliffScene(is_equirectangular);
    const Backdrop& backdrop = loaded.scene.backdrop;
    view_->SetBackdrop(*loaded.panorama, *loaded.depth, backdrop);
    const DepthMap relief_drawn = WithSmoothOutlines(*loaded.depth);
    for (const double angle : {0.0, 30.0, 70.0}) {
      Picture picture = PictureFromPose({0.05, -0.1, 0.7, 0.018}, RadiansFromDegrees(angle), 1.5);
      picture.plain = true;
      const int size = 96;
      const TracedPicture traced = TraceWindow(backdrop, *loaded.panorama, picture.view,
                                               picture.field_of_view, size, {}, &relief_drawn);
      double share_before = 1;
      for (const app::ReliefSearch relief :
           {app::ReliefSearch{0, 1}, {16, 1}, {128, 1}, {1024, 1}, {64, 4}}) {
        picture.relief = relief;
        view_->Render(picture, size);
        const ReliefAgreement off = CompareWithTraced(view_->ReadPixels(), view_->ReadDistances(),
                                                      traced, picture, backdrop.projection);
        ASSERT_GT(off.compared, 1000);
        const double share = 1.0 * off.elsewhere / off.compared;
        std::printf(
            "relief, %s, %2.0f deg, %4d steps, cells of %d: %5.2f %% of %d pixels elsewhere, the "
            "others off by "
            "at most %.2g mm and %d of 255\n",
            is_equirectangular ? "equirectangular" : "gnomonic", angle, relief.steps, relief.cell,
            100 * share, off.compared, 1e3 * off.worst, off.worst_colour);
        if (relief.cell > 1) {
          // A cell of this small picture is as wide as five of a usual one.
          EXPECT_LT(share, 0.02);
          continue;
        }
        EXPECT_LE(share, share_before + 5e-4);  // a crest through a few pixels
        share_before = share;
        if (relief.steps == 1024) {
          EXPECT_LT(share, 0.01);
        }
      }
    }
  }
}

// A pixel that looks at the steep side of a step ended anywhere on it, so that its height, and with
// it its colour, was random: a comb of light and dark pixels along the foot.
TEST_F(BackdropRelief, SidesOfStepsHaveTheColoursOfASearchOfEveryPixel) {
  const LoadedScene loaded = LoadScene(std::string(ARTHRO_SOURCE_DIR) + "/resources/demo");
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  constexpr int kSize = 512;
  int off = 0;
  for (const double longitude : {-50.0, 35.0, 50.0}) {
    Picture picture = PictureFromPose({0.0, RadiansFromDegrees(longitude), 0.0, 0.015},
                                      loaded.scene.scope.view_angle, 1.5);
    const auto pixels = [&](const app::ReliefSearch& relief) {
      picture.relief = relief;
      view_->Render(picture, kSize);
      return view_->ReadPixels();
    };
    const ColourImage drawn = pixels(app::kUsualRelief), sought = pixels({1024, 1});
    int here = 0;
    for (std::size_t i = 0; i < drawn.rgb.size(); i += 3) {
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c)
        most = std::max(most, std::abs(int{drawn.rgb[i + c]} - int{sought.rgb[i + c]}));
      here += most > 16 ? 1 : 0;
    }
    std::printf("sides at %.0f degrees: %d pixels of another colour\n", longitude, here);
    off += here;
  }
  EXPECT_LT(off, 100);
}

// Occlusion: a lens on the high side of the step sees half of a ball.
TEST_F(BackdropRelief, OcclusionByTheReliefAgreesWithTheReferenceTracer) {
  for (const bool is_equirectangular : {false, true}) {
    const LoadedScene loaded = CliffScene(is_equirectangular);
    const Backdrop& backdrop = loaded.scene.backdrop;
    const Picture usual = [] {
      Picture picture = PictureFromPose({0.0, -0.45, 1.6, 0.032}, RadiansFromDegrees(70), 1.5);
      picture.relief = app::kUsualRelief;
      return picture;
    }();
    SurfaceMesh ball = Ellipsoid(glm::dvec3(0.003));
    for (glm::dvec3& x : ball.vertices) x += glm::dvec3(0.004, 0.0, 0.042);
    Tissue tissue;
    view_->SetBackdrop(*loaded.panorama, *loaded.depth, backdrop);
    view_->SetTissues(std::span(&tissue, 1), std::vector{Share(ball)});
    constexpr int kSize = 256;
    const ReferenceMesh mesh{&ball};
    const TracedPicture traced =
        TraceWindow(backdrop, *loaded.panorama, usual.view, usual.field_of_view, kSize, {&mesh, 1},
                    loaded.depth.get());
    for (const app::ReliefSearch relief : {app::kUsualRelief, app::ReliefSearch{}}) {
      Picture picture = usual;
      picture.relief = relief;
      view_->Render(picture, kSize);
      const std::vector<float> bare = [&] {
        view_->SetTissues({}, {});
        view_->Render(picture, kSize);
        auto distances = view_->ReadDistances();
        view_->SetTissues(std::span(&tissue, 1), std::vector{Share(ball)});
        view_->Render(picture, kSize);
        return distances;
      }();
      const std::vector<float> drawn = view_->ReadDistances();
      int on_ball = 0, hidden = 0, beyond = 0;
      for (int y = 2; y < kSize - 2; ++y)
        for (int x = 2; x < kSize - 2; ++x) {
          const auto at = [&](int u, int v) {
            return static_cast<std::size_t>(v) * kSize + static_cast<std::size_t>(u);
          };
          if (std::hypot(x - 127.5, y - 127.5) > 124 || drawn[at(x, y)] == 0) continue;
          const bool is_ball = drawn[at(x, y)] < bare[at(x, y)];
          on_ball += is_ball ? 1 : 0;
          hidden += !is_ball && traced.what[at(x, y)] == TracedPicture::kBackdrop ? 1 : 0;
          // Every pixel within 1.5 px that differs from the tracer is at most that far off.
          bool agrees = false;
          for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
              agrees = agrees || (traced.what[at(x + i, y + j)] == 1) == is_ball;
          beyond += agrees ? 0 : 1;
        }
      std::printf("occlusion, %s, %d steps: ball on %d pixels, %d of %d more than 1.5 px off\n",
                  is_equirectangular ? "equirectangular" : "gnomonic", relief.steps, on_ball,
                  beyond, on_ball + hidden);
      if (relief == app::kUsualRelief) {
        EXPECT_GT(on_ball, 500);
        EXPECT_EQ(beyond, 0);
      } else {
        EXPECT_GT(beyond, 20) << "without the relief it must not end there";
      }
    }
  }
}

TEST(ReliefCeiling, BoundsTheReliefOfABlockAndItsEightNeighbours) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> any(0.0f, 0.01f);
  for (const bool is_whole_turn : {false, true})
    for (const auto& [width, height] : {std::pair{1, 1}, {37, 5}, {300, 170}, {1500, 40}}) {
      app::ReliefTexture relief{width, height, {}};
      for (int i = 0; i < 4 * width * height; ++i)
        relief.texels.push_back(any(random) + (i % 4 == 0 ? 0.0f : 1.0f));
      const app::ReliefCeiling ceiling = app::MakeReliefCeiling(relief, is_whole_turn);
      ASSERT_EQ(ceiling.relief.size(), static_cast<std::size_t>(ceiling.width * ceiling.height));
      for (int trial = 0; trial < 2000; ++trial) {
        const int x = static_cast<int>(random() % static_cast<unsigned>(width));
        const int y = static_cast<int>(random() % static_cast<unsigned>(height));
        const auto off = [&, block = ceiling.block] {
          return static_cast<int>(random() % static_cast<unsigned>(2 * block + 1)) - block;
        };
        int u = x + off();
        const int v = y + off();
        if (is_whole_turn) u = (u + width) % width;
        if (u < 0 || v < 0 || u >= width || v >= height) continue;
        const float top = ceiling.relief[static_cast<std::size_t>(
            y / ceiling.block * ceiling.width + x / ceiling.block)];
        ASSERT_GE(top, relief.texels[4 * static_cast<std::size_t>(v * width + u)])
            << "at " << x << ", " << y << " of " << u << ", " << v;
      }
    }
}

}  // namespace
}  // namespace arthro::test
