// Tissues and the instrument in the picture: places through the lens, and occlusion.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

#include "app/view/drawing/loose_body_model.h"
#include "app/view/instruments/probe_mesh.h"
#include "app/view/shaders/constants.h"
#include "simulation/core/units.h"
#include "tests/app/view/lit_scene.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/compare_pictures.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::test {
namespace {

using app::InstrumentView;
using app::Picture;
using app::PictureFromPose;

// Largest distance, in px, between an edge as drawn (a chord) and as the lens bends it, over all
// edges in the window.
double WorstChord(const SurfaceMesh& mesh, const Picture& picture, int size) {
  const simulation::RoundWindow window = simulation::WindowOfSize(picture.field_of_view, size);
  double worst = 0;
  for (const auto& triangle : mesh.triangles)
    for (int side = 0; side < 3; ++side) {
      const glm::dvec3 a =
          mesh.vertices[static_cast<std::size_t>(triangle[side])] - picture.view.tip;
      const glm::dvec3 b =
          mesh.vertices[static_cast<std::size_t>(triangle[(side + 1) % 3])] - picture.view.tip;
      const glm::dvec2 p = PixelFromRay(window, picture.view, a),
                       q = PixelFromRay(window, picture.view, b);
      if (glm::distance(p, window.centre_px) > window.radius_px ||
          glm::distance(q, window.centre_px) > window.radius_px || p == q)
        continue;
      const glm::dvec2 along = glm::normalize(q - p);
      for (const double t : {0.25, 0.5, 0.75}) {
        const glm::dvec2 m = PixelFromRay(window, picture.view, (1 - t) * a + t * b) - p;
        worst = std::max(worst, std::abs(along.x * m.y - along.y * m.x));
      }
    }
  return worst;
}

class ModelsView : public ViewTest {};

TEST(ModelWarp, ChordsOfTissueAndProbeStayUnderHalfAPixel) {
  // At 512 px and 90 degrees: tissue with edges of about a millimetre from 8 mm on, the probe from
  // 5 mm beside the lens.
  const Picture picture =
      PictureFromPose({0, 0, 0, 0.01}, RadiansFromDegrees(30), std::numbers::pi / 2);
  Pose pose;
  pose.position = {0, -0.004, 0.026};
  const double tissue = WorstChord(Moved(Ellipsoid({0.007, 0.006, 0.006}), pose), picture, 512);
  Pose probe_pose;
  probe_pose.position = {-0.012, -0.004, 0.018};
  probe_pose.quaternion = glm::dquat(std::cos(-0.7), 0, std::sin(-0.7), 0);
  const double probe = WorstChord(Moved(app::MakeProbeMesh(), probe_pose), picture, 512);
  std::printf("warped vertices, chord against curve at 512 px: tissue %.3f px, probe %.3f px\n",
              tissue, probe);
  EXPECT_GT(tissue, 0.0);
  EXPECT_GT(probe, 0.0);
  EXPECT_LT(tissue, 0.5);
  EXPECT_LT(probe, 0.5);
}

// A ball on the view's axis at a distance from the portal, and the relief's height there.
struct Occlusion {
  double ball_at, relief;
  bool seen;
};

TEST_F(ModelsView, ReliefHidesOnlyTissueBehindIt) {
  LoadedScene loaded = MakeViewScene(256, 256);
  loaded.scene.backdrop.projection.focal_px = 110;
  const Picture picture = PictureFromPose({0, 0, 0, 0.01}, 0.0, 1.4);
  for (const Occlusion& c : {Occlusion{0.030, 0.010, true}, Occlusion{0.045, 0.010, false},
                             Occlusion{0.045, 0.001, true}, Occlusion{0.036, 0.018, false}}) {
    view_->SetBackdrop(*loaded.panorama, DepthMap(256, 256, static_cast<float>(c.relief)),
                       loaded.scene.backdrop);
    view_->SetTissues({}, {});
    view_->Render(picture, 200);
    const ColourImage without = view_->ReadPixels();
    const SurfaceMesh ball = Ellipsoid(glm::dvec3(0.003));
    Tissue tissue;
    tissue.pose.position = {0, 0, c.ball_at};
    view_->SetTissues(std::span(&tissue, 1), std::vector{Share(ball)});
    view_->Render(picture, 200);
    EXPECT_EQ(view_->ReadPixels().rgb != without.rgb, c.seen)
        << "ball at " << c.ball_at << ", relief " << c.relief;
    const double distance = view_->ReadDistances()[100 * 200 + 100];
    EXPECT_NEAR(distance, c.seen ? c.ball_at - 0.003 - 0.01 : 0.05 - c.relief - 0.01, 30e-6);
  }
}

TEST_F(ModelsView, ALooseBodyIsDrawnInItsBallWhereverItIsCarried) {
  constexpr int kSize = 200;
  const LoadedScene loaded = MakeViewScene(256, 256);
  view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
  const Picture picture = PictureFromPose({0, 0, 0, 0.01}, 0.0, 1.4);
  const auto middle = [&] { return view_->ReadDistances()[100 * kSize + 100]; };
  view_->Render(picture, kSize);
  const ColourImage without = view_->ReadPixels();
  const double bare = middle();
  Ball body{{0, 0, 0.024}, 0.002};
  EXPECT_TRUE(view_->SetLooseBodies(std::span(&body, 1)));
  EXPECT_FALSE(view_->SetLooseBodies(std::span(&body, 1))) << "it is there already";
  // Its surface has dents, which lie in the ball. 0.03 mm: steps of the depth buffer.
  const auto expect_at = [&](double distance) {
    view_->Render(picture, kSize);
    EXPECT_GT(middle(), distance - body.radius - 3e-5);
    EXPECT_LT(middle(), distance - body.radius * (1 - app::kDeepestDent) + 3e-5);
  };
  expect_at(0.014);
  body.centre.z = 0.019;
  EXPECT_TRUE(view_->SetLooseBodies(std::span(&body, 1)));
  expect_at(0.009);
  // Tissues that are shown anew leave it where it is.
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  expect_at(0.009);
  view_->SetTissues({}, {});
  EXPECT_TRUE(view_->SetLooseBodies({}));
  view_->Render(picture, kSize);
  EXPECT_FLOAT_EQ(middle(), bare);
  EXPECT_EQ(view_->ReadPixels().rgb, without.rgb);
}

TEST(LooseBodyModel, IsClosedAndNoTwoAreAlike) {
  const SurfaceMesh body = app::MakeLooseBody(0.002, 0);
  double volume = 0;
  for (const auto& t : body.triangles)
    volume += glm::dot(body.vertices[static_cast<std::size_t>(t[0])],
                       glm::cross(body.vertices[static_cast<std::size_t>(t[1])],
                                  body.vertices[static_cast<std::size_t>(t[2])])) /
              6;
  const double ball = 4.0 / 3 * std::numbers::pi * 8e-9;
  EXPECT_GT(volume, 0.75 * ball);
  EXPECT_LT(volume, ball);
  EXPECT_NE(body.vertices, app::MakeLooseBody(0.002, 1).vertices);
}

// Tissues of edges up to 1 mm, whose distances are interpolated.
TEST_F(ModelsView, DistanceOfAFineTissueIsThatOfItsTriangles) {
  constexpr int kSize = 200;
  LoadedScene loaded = MakeViewScene(256, 256);
  view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
  const SurfaceMesh ball = Ellipsoid(glm::dvec3(0.003), 24, 12);
  Tissue tissue;
  tissue.pose.position = {0, 0, 0.018};
  view_->SetTissues(std::span(&tissue, 1), std::vector{Share(ball)});
  const Picture picture = PictureFromPose({0, 0, 0, 0.01}, 0.0, 1.4);  // 5 mm before the ball
  view_->Render(picture, kSize);
  const std::vector<float> drawn = view_->ReadDistances();
  const SurfaceMesh placed = Moved(ball, tissue.pose);
  const ReferenceMesh mesh{&placed, {}};
  const TracedPicture traced = TraceWindow(loaded.scene.backdrop, *loaded.panorama, picture.view,
                                           picture.field_of_view, kSize, std::span(&mesh, 1));
  double most = 0;
  int compared = 0;
  // At the outline a chord may be drawn a pixel aside.
  for (std::size_t i = 2; i + 2 < drawn.size(); ++i) {
    if (traced.what[i - 2] != 1 || traced.what[i] != 1 || traced.what[i + 2] != 1) continue;
    most = std::max(most, std::abs(drawn[i] - traced.distance[i]));
    ++compared;
  }
  std::printf("distance of a fine tissue: %d px, %.1f um off at most\n", compared, 1e6 * most);
  EXPECT_GT(compared, 2000);
  EXPECT_LT(most, 30e-6);  // (0.8 mm)² / (8 · 5 mm) is 16 um, and the drawn chord
}

// A ball of 4 mm whose centre lies 3 mm below a level relief, seen from above. Where it meets the
// relief its side rises by 0.3 mm over 0.39 mm, which are 9 px; the middle half of a smooth step
// over them is 3 px. Higher up the ball hides the relief wholly.
TEST_F(ModelsView, ATissueFadesIntoTheReliefWhereTheTwoMeet) {
  constexpr int kSize = 512;
  constexpr double kRelief = 0.02;
  for (const ProjectionType type : {ProjectionType::kGnomonic, ProjectionType::kEquirectangular}) {
    Backdrop backdrop;
    backdrop.projection.type = type;
    backdrop.projection.centre_px = {255.5, 255.5};
    backdrop.projection.focal_px = 250;
    backdrop.projection.px_per_deg = 5;
    ColourImage panorama(kSize, kSize);
    for (std::size_t i = 0; i < panorama.rgb.size(); i += 3) panorama.rgb[i + 2] = 200;  // blue
    view_->SetBackdrop(panorama, DepthMap(kSize, kSize, kRelief), backdrop);
    Tissue ball;
    ball.pose.position = {0, 0, backdrop.radius - kRelief + 0.003};
    ball.colour = glm::dvec3(0.8, 0.2, 0.2);
    const std::vector<SharedSurface> surfaces = {Share(Ellipsoid(glm::dvec3(0.004), 96, 48))};
    view_->SetTissues(std::span(&ball, 1), surfaces);
    Picture picture = PictureFromPose({0, 0, 0, 0.018}, 0.0, std::numbers::pi / 2);
    picture.relief = app::kUsualRelief;
    view_->Render(picture, kSize);
    const ColourImage drawn = view_->ReadPixels();
    // Share of the ball, by the blue that its red does not explain.
    const auto* pure = drawn.at(kSize / 2, kSize / 2);
    const double blue_of_ball = pure[2] / double(pure[0]), ground = drawn.at(60, kSize / 2)[2];
    const auto share = [&](int x) {
      const auto* pixel = drawn.at(x, kSize / 2);
      return 1 - (pixel[2] - blue_of_ball * pixel[0]) / ground;
    };
    for (const int way : {-1, 1}) {
      int between = 0;
      for (int x = kSize / 2; x > 80 && x < kSize - 80; x += way) {
        between += share(x) > 0.25 && share(x) < 0.75 ? 1 : 0;
      }
      std::printf("%s: %d px between\n", way < 0 ? "left" : "right", between);
      EXPECT_GE(between, 2);
      EXPECT_LE(between, 6);
    }
  }
}

TEST_F(ModelsView, ProbeAndTissueHideEachOtherByDistance) {
  LoadedScene loaded = MakeViewScene(256, 256);
  loaded.scene.backdrop.projection.focal_px = 110;
  view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
  const SurfaceMesh ball = Ellipsoid(glm::dvec3(0.004));
  Tissue tissue;
  tissue.pose.position = {0, 0, 0.030};
  view_->SetTissues(std::span(&tissue, 1), std::vector{Share(ball)});
  Picture picture = PictureFromPose({0, 0, 0, 0.008}, 0.0, 1.4);
  const int centre = 100 * 200 + 100;
  view_->Render(picture, 200);
  EXPECT_NEAR(view_->ReadDistances()[centre], 0.018, 30e-6);
  const ColourImage ball_only = view_->ReadPixels();
  // The shaft crosses the axis 22 mm from the portal, in front of the ball...
  picture.instrument = InstrumentView{{0.03, 0, 0.0225}, {-0.02, 0, 0.0225}, 0.0};
  view_->Render(picture, 200);
  EXPECT_NEAR(view_->ReadDistances()[centre], 0.013, 0.1e-3);
  const ColourImage probe_front = view_->ReadPixels();
  EXPECT_NE(std::vector(ball_only.at(100, 100), ball_only.at(100, 100) + 3),
            std::vector(probe_front.at(100, 100), probe_front.at(100, 100) + 3));
  // ...or behind it, where the middle shows the ball as if no probe were there. The ambient
  // occlusion of a rod of 1.5 mm, 14 mm behind this place, is 0.5 (1.5 / 14)² of the light, 0.6 %,
  // and half of that in a stored colour: 0.7 of 236, which is 1 when it is rounded.
  picture.instrument = InstrumentView{{0.03, 0, 0.040}, {-0.02, 0, 0.040}, 0.0};
  view_->Render(picture, 200);
  EXPECT_NEAR(view_->ReadDistances()[centre], 0.018, 30e-6);
  const ColourImage probe_behind = view_->ReadPixels();
  // Its contact shade, 0.5 (0.9 mm / 8 mm)² of the light, is less than 2 levels.
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(ball_only.at(100, 100)[c], probe_behind.at(100, 100)[c], 2) << c;
  EXPECT_NE(ball_only.rgb, probe_behind.rgb) << "beside the ball the probe is seen";
}

// Out of focus beside the lens: solid from 2 mm on, gone at 0.5 mm.
TEST_F(ModelsView, ShaftBesideTheLensFades) {
  LoadedScene loaded = MakeViewScene(256, 256);
  loaded.scene.backdrop.projection.focal_px = 110;
  view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
  const SurfaceMesh ball = Ellipsoid(glm::dvec3(0.004));
  Tissue tissue;
  tissue.pose.position = {0, 0, 0.030};
  view_->SetTissues(std::span(&tissue, 1), std::vector{Share(ball)});
  Picture picture = PictureFromPose({0, 0, 0, 0.008}, 0.0, 1.4);
  const auto middle = [&] {
    view_->Render(picture, 200);
    const ColourImage drawn = view_->ReadPixels();
    return glm::ivec3(drawn.at(100, 100)[0], drawn.at(100, 100)[1], drawn.at(100, 100)[2]);
  };
  const glm::ivec3 without = middle();
  constexpr double kRadius = 0.75e-3;  // m, of the probe's shaft
  const auto change = [&](double gap) {
    const double z = 0.008 + gap + kRadius;
    picture.instrument = InstrumentView{{0.03, 0, z}, {-0.02, 0, z}, 0.0};
    const glm::ivec3 off = glm::abs(middle() - without);
    return std::max({off.x, off.y, off.z});
  };
  const int solid = change(2.5e-3), half = change(1.25e-3), gone = change(0.45e-3);
  std::printf("change by a shaft at 2.5, 1.25 and 0.45 mm: %d, %d, %d levels\n", solid, half, gone);
  EXPECT_GT(solid, 30);
  EXPECT_LT(half, solid);
  EXPECT_GT(half, 3);
  // The shaft still shades the tissue behind it.
  EXPECT_LT(gone, half);
}

// A shaft moves across the view by an eighth of a pixel per picture, at several rolls of its sides.
// A pixel at its outline takes an eighth of the step of colour then; a third allows for the slope
// of the light there. Without smooth outlines it takes the whole step at once.
TEST_F(ModelsView, OutlineOfAShaftThatCreepsChangesLittleByLittle) {
  LoadedScene loaded = MakeViewScene(256, 256);
  loaded.scene.backdrop.projection.focal_px = 110;
  view_->SetBackdrop(Grey(256, 256, 240), {}, loaded.scene.backdrop);
  Picture picture = PictureFromPose({0, 0, 0, 0.008}, 0.0, 1.4);
  constexpr double kPixel = 0.0145 * 2 * 0.3429 / 100;  // m, at the shaft
  for (const double roll : {0.0, 0.08, 0.16, 0.24}) {
    ColourImage before;
    int most = 0, step = 0;
    for (int i = 0; i <= 16; ++i) {
      const double y = kPixel * i / 8;
      picture.instrument = InstrumentView{{0.03, y, 0.0225}, {-0.02, y, 0.0225}, roll};
      view_->Render(picture, 200);
      ColourImage now = view_->ReadPixels();
      if (i > 0)
        for (int row = 80; row < 120; ++row)
          for (int column = 80; column < 120; ++column) {
            most = std::max(most, std::abs(now.at(column, row)[1] - before.at(column, row)[1]));
            step = std::max(step, std::abs(now.at(column, row)[1] - now.at(column, row + 1)[1]));
          }
      before = std::move(now);
    }
    std::printf("roll %.2f: %d levels at most, of a step of %d\n", roll, most, step);
    EXPECT_GT(step, 40);
    EXPECT_LT(3 * most, step) << roll;
  }
}

// A ball that faces the lamp shows its highlight in gas; in saline a ninetieth of it is left, which
// is less than one of 255.
TEST_F(ModelsView, HighlightOfTissueIsSeenInGasAndNotInSaline) {
  LoadedScene loaded = MakeViewScene(256, 256);
  Tissue tissue;
  tissue.pose.position = {0, 0, 0.030};
  tissue.colour = {0.3, 0.25, 0.2};
  view_->SetTissues(std::span(&tissue, 1), std::vector{Share(Ellipsoid(glm::dvec3(0.004)))});
  const Picture picture = PictureFromPose({0, 0, 0, 0.008}, 0.0, 1.4);
  const auto drawn = [&](Medium medium) {
    loaded.scene.backdrop.medium = medium;
    view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
    view_->Render(picture, 200);
    return view_->ReadPixels();
  };
  const ColourImage gas = drawn(Medium::kGas), saline = drawn(Medium::kSaline);
  int most = 0, least = 255;
  for (std::size_t i = 0; i < gas.rgb.size(); ++i) {
    most = std::max(most, gas.rgb[i] - saline.rgb[i]);
    least = std::min(least, gas.rgb[i] - saline.rgb[i]);
  }
  EXPECT_GT(most, 40);
  EXPECT_GE(least, 0);
  // Beside the highlight the ball shades evenly: no pixel of its middle stands out.
  for (int x = 85; x < 115; ++x)
    EXPECT_LT(std::abs(saline.at(x, 100)[1] - saline.at(x + 1, 100)[1]), 8) << x;
}

TEST_F(ModelsView, ProbeIsDrawnOnlyFromItsPortalToTheProxy) {
  LoadedScene loaded = MakeViewScene(256, 256);
  loaded.scene.backdrop.projection.focal_px = 110;
  view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
  Picture picture = PictureFromPose({0, 0, 0, 0.0}, 0.0, 2.4);
  picture.instrument = InstrumentView{{0.02, 0, 0.02}, {-0.01, 0, 0.02}, 0.0};
  const int size = 400;
  view_->Render(picture, size);
  const std::vector<float> distances = view_->ReadDistances();
  int drawn = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float distance = distances[static_cast<std::size_t>(y) * size + x];
      const auto ray = ReferenceRay(picture.view, picture.field_of_view, size, {x, y});
      if (!ray || distance == 0.0f || distance > 0.049f) continue;
      const glm::dvec3 point = picture.view.tip + double(distance) * *ray;
      ++drawn;
      EXPECT_GT(point.x, -0.0101);
      EXPECT_LT(point.x, 0.0201);
      EXPECT_LT(std::hypot(point.y, point.z - 0.02), 0.0036) << "within the hook's reach";
    }
  EXPECT_GT(drawn, 1000);
}

TEST_F(ModelsView, GeometryBehindTheLensIsNotDrawn) {
  LoadedScene loaded = MakeViewScene(256, 256);
  loaded.scene.backdrop.projection.focal_px = 110;
  view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
  // Few, long triangles wrapped all round the back of the lens, none in front.
  const SurfaceMesh shell = Ellipsoid(glm::dvec3(0.006), 6, 4);
  Tissue tissue;
  tissue.pose.position = {0, 0, -0.0005};
  const Picture picture = PictureFromPose({0, 0, 0, 0.012}, 0.0, std::numbers::pi / 2);
  view_->Render(picture, 200);
  const ColourImage without = view_->ReadPixels();
  view_->SetTissues(std::span(&tissue, 1), std::vector{Share(shell)});
  view_->Render(picture, 200);
  EXPECT_EQ(view_->ReadPixels().rgb, without.rgb);
}

TEST_F(ModelsView, MovedVerticesAreDrawnInTheirNewPlaces) {
  LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  const Picture picture = PictureFromPose({-0.1, 0, 0, 0.012}, 0.3, 1.5);
  view_->Render(picture, 200);
  const ColourImage before = view_->ReadPixels();
  SurfaceMesh pressed = *loaded.surfaces[0];
  for (glm::dvec3& vertex : pressed.vertices)
    vertex.z -= 0.0015 * std::exp(-1e5 * vertex.x * vertex.x);
  EXPECT_TRUE(view_->SetTissueShape(0, pressed.vertices));
  EXPECT_FALSE(view_->SetTissueShape(0, pressed.vertices)) << "where it was: nothing is uploaded";
  view_->Render(picture, 200);
  EXPECT_NE(before.rgb, view_->ReadPixels().rgb);
  const std::vector<float> after = view_->ReadDistances();
  // A new surface has the same places, with its pattern where it lies now.
  view_->SetTissueSurface(0, pressed);
  view_->Render(picture, 200);
  EXPECT_EQ(after, view_->ReadDistances());
  EXPECT_THROW(view_->SetTissueShape(0, std::span(pressed.vertices).first(3)), Error);
  EXPECT_THROW(view_->SetTissueShape(1, pressed.vertices), Error);
}

// A pattern lies on the tissue: moved as a whole, with the scope, it is drawn as before.
TEST_F(ModelsView, PatternMovesWithTheTissue) {
  LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
  const SurfaceMesh ring = Ring(0.007, 0.0024, 80, 40);
  Tissue tissue;
  tissue.pose.position = {0, 0, 0.030};
  simulation::TissueLook look;
  look.structure = simulation::TissueStructure::kFibres;
  look.fibres = look.vessels = 1;
  view_->SetTissues(std::span(&tissue, 1), std::vector{Share(ring)}, std::span(&look, 1));
  const Picture picture = PictureFromPose({0, 0, 0, 0.008}, 0.0, 1.4);
  view_->Render(picture, 200);
  const ColourImage before = view_->ReadPixels();
  const glm::dvec3 way(0.0, 0.0, 0.0013);
  SurfaceMesh moved = ring;
  for (glm::dvec3& x : moved.vertices) x += way;
  view_->SetTissueShape(0, moved.vertices);
  view_->SetTissuePose(0, {tissue.pose.position - way, tissue.pose.quaternion, 1.0});
  view_->Render(picture, 200);
  const ColourImage after = view_->ReadPixels();
  int worst = 0;
  for (std::size_t i = 0; i < before.rgb.size(); ++i)
    worst = std::max(worst, std::abs(int(before.rgb[i]) - int(after.rgb[i])));
  EXPECT_LE(worst, 2) << "rounding of places";
}

TEST_F(ModelsView, GivenNormalsAreUsedAndCutFacesAreDrawnPaler) {
  LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  const Picture picture = PictureFromPose({-0.1, 0, 0, 0.012}, 0.3, 1.5);
  const auto drawn = [&] {
    view_->Render(picture, 200);
    return view_->ReadPixels().rgb;
  };
  const auto before = drawn();
  const std::vector<glm::dvec3>& places = loaded.surfaces[0]->vertices;
  const std::vector<glm::dvec3> turned(places.size(), glm::dvec3(1, 0, 0));
  EXPECT_TRUE(view_->SetTissueShape(0, places, turned));
  EXPECT_NE(drawn(), before);
  EXPECT_THROW(view_->SetTissueShape(0, places, std::span(turned).first(2)), Error);
  // The remaining half of the ring, with another number of vertices.
  const SurfaceMesh half = Ring(0.007, 0.0024, 40, 20);
  view_->SetTissueSurface(0, half);
  const auto plain = drawn();
  EXPECT_NE(plain, before);
  std::vector<std::uint8_t> fresh(half.vertices.size(), 0);
  view_->SetTissueSurface(0, half, fresh);
  EXPECT_EQ(drawn(), plain);
  fresh.assign(fresh.size(), 1);
  view_->SetTissueSurface(0, half, fresh);
  EXPECT_NE(drawn(), plain);
  EXPECT_NO_THROW(view_->SetTissueShape(0, half.vertices));
  EXPECT_THROW(view_->SetTissueShape(0, places), Error);
}

TEST_F(ModelsView, EachInstrumentHasItsOwnShapeAndItsJawMoves) {
  LoadedScene loaded = MakeViewScene(256, 256);
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  Picture picture = PictureFromPose({0, 0, 0, 0.008}, 0.3, 1.5);
  picture.instrument = ProbeInFront();
  using simulation::ToolKind;
  std::vector<std::vector<std::uint8_t>> seen;
  const auto drawn = [&](ToolKind kind, double opening, double turn) {
    picture.instrument->kind = kind;
    picture.instrument->opening = opening;
    picture.instrument->turn = turn;
    view_->Render(picture, 200);
    return view_->ReadPixels().rgb;
  };
  for (const ToolKind kind :
       {ToolKind::kProbe, ToolKind::kPunch, ToolKind::kShaver, ToolKind::kGrasper}) {
    const auto closed = drawn(kind, 0, 0);
    for (const auto& other : seen) EXPECT_NE(closed, other);
    seen.push_back(closed);
    const bool has_jaw = kind == ToolKind::kPunch || kind == ToolKind::kGrasper;
    EXPECT_EQ(drawn(kind, 1, 0) != closed, has_jaw) << static_cast<int>(kind);
    EXPECT_EQ(drawn(kind, 0, 2) != closed, kind == ToolKind::kShaver) << static_cast<int>(kind);
    EXPECT_EQ(drawn(kind, 0, 0), closed);
  }
}

}  // namespace
}  // namespace arthro::test
