// The author's view: drawn only after a change, and a box that poses the chosen tissue.
#include "app/view/overview/overview.h"

#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "simulation/core/units.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/compare_pictures.h"
#include "tests/support/shapes.h"

namespace arthro::test {
namespace {

using app::Overview;
using app::PointerEvent;
using Kind = PointerEvent::Kind;
using Button = PointerEvent::Button;

constexpr int kOverviewSize = 400;

class OverviewTest : public ViewTest {
 protected:
  void SetUp() override {
    ViewTest::SetUp();
    if (IsSkipped()) return;
    view_.reset();
    overview_ = std::make_unique<Overview>();
    scene_ = MakeViewScene(512, 384);
    // Centre of the picture: the default camera looks at this point.
    scene_.scene.tissues[0].pose = {{0.0, 0.003, 0.0225}, {1, 0, 0, 0}, 1.0};
    overview_->SetBackdrop(*scene_.panorama, *scene_.depth, scene_.scene.backdrop);
    overview_->SetTissues(scene_.scene.tissues, scene_.surfaces);
    overview_->on_pose = [this](int tissue, const Pose& pose, bool finished) {
      EXPECT_EQ(tissue, 0);
      pose_ = pose;
      ++calls_;
      finished_ += finished ? 1 : 0;
    };
    overview_->Render(kOverviewSize, kOverviewSize);
  }
  void TearDown() override {
    overview_.reset();
    ViewTest::TearDown();
  }
  void Drag(Button button, glm::dvec2 from, glm::dvec2 to) {
    PointerEvent event;
    event.button = button;
    const auto send = [&](Kind kind, glm::dvec2 at) {
      event.kind = kind;
      event.x = at.x;
      event.y = at.y;
      overview_->Handle(event);
      overview_->Render(kOverviewSize, kOverviewSize);
    };
    send(Kind::kMove, from);
    send(Kind::kPress, from);
    for (int i = 1; i <= 4; ++i) send(Kind::kMove, from + (to - from) * (i / 4.0));
    send(Kind::kRelease, to);
  }

  // Rightmost pixel of the tissue in the middle row: the tissue is a ring with a hole there.
  double EdgeOfTissue() const {
    double x = middle_.x + 80;
    while (x > 0 && !overview_->PickTissue(x, middle_.y)) x -= 1;
    return x;
  }

  LoadedScene scene_;
  std::unique_ptr<Overview> overview_;
  Pose pose_;
  int calls_ = 0, finished_ = 0;
  const glm::dvec2 middle_{kOverviewSize / 2.0, kOverviewSize / 2.0};
};

TEST_F(OverviewTest, DrawsOnlyWhenSomethingChanged) {
  EXPECT_FALSE(overview_->Render(kOverviewSize, kOverviewSize));
  EXPECT_TRUE(overview_->Render(kOverviewSize, kOverviewSize - 1)) << "another size";
  EXPECT_FALSE(overview_->Render(kOverviewSize, kOverviewSize - 1));
  overview_->SetIncisionSpacing(-0.02);
  EXPECT_TRUE(overview_->Render(kOverviewSize, kOverviewSize - 1));
  overview_->ChooseTissue(0);
  EXPECT_TRUE(overview_->Render(kOverviewSize, kOverviewSize - 1));
  overview_->ChooseTissue(0);
  EXPECT_FALSE(overview_->Render(kOverviewSize, kOverviewSize - 1)) << "chosen already";
  overview_->ChooseTissue(17);
  EXPECT_TRUE(overview_->Render(kOverviewSize, kOverviewSize - 1))
      << "no such tissue: none is chosen";
}

TEST_F(OverviewTest, ShowsALooseBodyWhereItIs) {
  const auto pixel = [&] {
    const ColourImage picture = overview_->ReadPixels();
    const glm::ivec2 at = *overview_->PixelOf({0.0, 0.003, 0.0105});
    return std::array{picture.at(at.x, at.y)[0], picture.at(at.x, at.y)[1],
                      picture.at(at.x, at.y)[2]};
  };
  const auto before = pixel();
  const Ball body{{0.0, 0.003, 0.0105}, 0.002};
  overview_->ShowLooseBodies(std::span(&body, 1));
  EXPECT_TRUE(overview_->Render(kOverviewSize, kOverviewSize));
  EXPECT_NE(pixel(), before);
  overview_->ShowLooseBodies(std::span(&body, 1));
  EXPECT_FALSE(overview_->Render(kOverviewSize, kOverviewSize)) << "it is there already";
  overview_->ShowLooseBodies({});
  EXPECT_TRUE(overview_->Render(kOverviewSize, kOverviewSize));
  EXPECT_EQ(pixel(), before);
}

// The relief as it is drawn has fewer pixels than the panorama and lies at the same place: of a
// bare level relief, which has no detail to lose, the same picture.
TEST_F(OverviewTest, AMapOfLargerPixelsLiesAtThePlaceOfThePanorama) {
  overview_->SetTissues({}, {});
  const int width = scene_.panorama->width, height = scene_.panorama->height;
  const auto drawn = [&](int factor) {
    overview_->SetRelief(DepthMap(width / factor, height / factor, 0.006f), scene_.scene.backdrop);
    overview_->Render(kOverviewSize, kOverviewSize);
    return overview_->ReadPixels();
  };
  const ColourImage fine = drawn(1);
  for (const int factor : {2, 4}) {
    const PictureDifference difference = ComparePictures(drawn(factor), fine);
    std::printf("pixels of %d: %.2f %% off\n", factor, 100 * difference.share_off);
    EXPECT_LT(difference.share_off, 0.02) << "pixels of " << factor;
  }
}

// On a screen with an interface scale of 2 the labels were half as large as all other text.
TEST_F(OverviewTest, LabelsGrowWithTheInterfaceScale) {
  // Pixels of the background of the labels. The background of the view is a gradient that begins
  // with that colour: the rows in which both are alike are left out.
  const auto is_label = [](const std::uint8_t* rgb, int off) {
    return std::abs(rgb[0] - 24) < off && std::abs(rgb[1] - 26) < off &&
           std::abs(rgb[2] - 31) < off;
  };
  const auto label_pixels = [&] {
    const ColourImage picture = overview_->ReadPixels();
    int count = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        count += !is_label(picture.at(0, y), 8) && is_label(picture.at(x, y), 2);
    return count;
  };
  constexpr int kLarge = 900;
  overview_->Render(kLarge, kLarge);
  const int at_1 = label_pixels();
  ASSERT_GT(at_1, 100);
  overview_->handle_scale = 2;
  EXPECT_TRUE(overview_->Render(kLarge, kLarge));
  EXPECT_GT(label_pixels(), 2.5 * at_1);
  EXPECT_FALSE(overview_->Render(kLarge, kLarge));
}

TEST_F(OverviewTest, LabelsAreWrittenInTheWordsOfTheLanguage) {
  overview_->Render(kOverviewSize, kOverviewSize);
  const ColourImage english = overview_->ReadPixels();
  overview_->SetLabels({"Optik", "Instrument", "x rechts", "y unten", "z innen"});
  EXPECT_TRUE(overview_->Render(kOverviewSize, kOverviewSize)) << "drawn anew";
  EXPECT_NE(overview_->ReadPixels().rgb, english.rgb);
  std::array<std::string, Overview::kLabels.size()> words;
  std::copy(Overview::kLabels.begin(), Overview::kLabels.end(), words.begin());
  overview_->SetLabels(words);
  overview_->Render(kOverviewSize, kOverviewSize);
  EXPECT_EQ(overview_->ReadPixels().rgb, english.rgb);
}

TEST_F(OverviewTest, DraggingTheCentreOfTheBoxMovesOnlyTheTissue) {
  overview_->ChooseTissue(0);
  overview_->Render(kOverviewSize, kOverviewSize);
  Drag(Button::kLeft, middle_, middle_ + glm::dvec2(40, 0));
  ASSERT_GE(calls_, 2);
  EXPECT_EQ(finished_, 1);
  const glm::dvec3 moved = pose_.position - scene_.scene.tissues[0].pose.position;
  // The camera stands to the right, above and behind the portal: the picture's right is mostly +x.
  EXPECT_GT(moved.x, 0.003);
  EXPECT_NEAR(pose_.scale, 1.0, 1e-9);
  EXPECT_NEAR(std::abs(pose_.quaternion.w), 1.0, 1e-9);
  // The drawn box follows: the same drag again continues from there.
  const glm::dvec3 first = pose_.position;
  Drag(Button::kLeft, middle_ + glm::dvec2(40, 0), middle_);
  EXPECT_LT(glm::distance(pose_.position, scene_.scene.tissues[0].pose.position), 0.5e-3);
  EXPECT_GT(glm::distance(pose_.position, first), 0.003);
}

TEST_F(OverviewTest, RightDragScalesUniformly) {
  overview_->ChooseTissue(0);
  overview_->Render(kOverviewSize, kOverviewSize);
  Drag(Button::kRight, middle_, middle_ - glm::dvec2(0, 50));
  ASSERT_GE(calls_, 1);
  EXPECT_GT(std::abs(pose_.scale - 1.0), 0.05);
  EXPECT_GT(pose_.scale, 0.0);
  EXPECT_NEAR(std::abs(pose_.quaternion.w), 1.0, 1e-6);
}

TEST_F(OverviewTest, PickingAPixelReturnsAPlaceOnTheTissueSurface) {
  const auto place = overview_->PickTissue(middle_.x, middle_.y);
  EXPECT_FALSE(overview_->PickTissue(2, 2));
  // The ring has a hole; somewhere near the centre it is hit.
  std::optional<Overview::TissuePlace> met = place;
  for (double dx = -60; !met && dx <= 60; dx += 4)
    met = overview_->PickTissue(middle_.x + dx, middle_.y);
  ASSERT_TRUE(met);
  EXPECT_EQ(met->tissue, 0);
  double nearest = 1;
  for (const glm::dvec3& x : scene_.surfaces[0]->vertices)
    nearest = std::min(nearest, glm::distance(x, met->x_in_tissue));
  EXPECT_LT(nearest, 0.5e-3);  // its triangles are smaller than a millimetre
}

TEST_F(OverviewTest, ADragOnAnArmMovesAlongItsAxisAlone) {
  overview_->ChooseTissue(0);
  overview_->Render(kOverviewSize, kOverviewSize);
  const Pose start = scene_.scene.tissues[0].pose;
  for (const auto arms : {Overview::Arms::kPortal, Overview::Arms::kOwn}) {
    Pose turned = start;
    turned.quaternion = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    overview_->SetTissuePose(0, turned);
    overview_->ShowArms(arms);
    overview_->Render(kOverviewSize, kOverviewSize);
    const auto ends = overview_->ArmPlaces();
    ASSERT_EQ(ends.size(), 3u);
    const glm::dvec2 way = ends[0] - *overview_->HandlePlace();
    Drag(Button::kLeft, ends[0], ends[0] + way);
    const glm::dvec3 axis = arms == Overview::Arms::kOwn ? turned.quaternion * glm::dvec3(1, 0, 0)
                                                         : glm::dvec3(1, 0, 0);
    const glm::dvec3 moved = pose_.position - turned.position;
    EXPECT_GT(glm::dot(moved, axis), 2e-3);
    EXPECT_LT(glm::length(moved - glm::dot(moved, axis) * axis), 1e-12);
    EXPECT_EQ(pose_.quaternion, turned.quaternion);
  }
  overview_->ChooseTissue(-1);
  EXPECT_TRUE(overview_->ArmPlaces().empty());
}

// Seen along an axis, the ring about it is a circle on which an angle is seen as it is.
TEST_F(OverviewTest, ADragOnARingTurnsAboutItsAxisAlone) {
  overview_->ChooseTissue(0);
  overview_->LookFrom(Overview::Side::kFront);
  overview_->Render(kOverviewSize, kOverviewSize);
  const Pose before = scene_.scene.tissues[0].pose;
  const auto ring = overview_->RingPlaces(2);
  ASSERT_EQ(ring.size(), 65u);
  // A sixteenth of a turn is four of its points.
  Drag(Button::kLeft, ring[8], ring[12]);
  EXPECT_EQ(finished_, 1);
  EXPECT_NEAR(glm::angle(pose_.quaternion), std::numbers::pi / 8, 0.01);
  EXPECT_NEAR(std::abs(glm::axis(pose_.quaternion).z), 1, 1e-6);
  EXPECT_EQ(pose_.scale, before.scale);
  // The middle of the tissue stays.
  const auto middle_of = [&](const Pose& pose) {
    glm::dvec3 low(1), high(-1);
    for (const glm::dvec3& x : scene_.surfaces[0]->vertices)
      low = glm::min(low, x), high = glm::max(high, x);
    return pose * (0.5 * (low + high));
  };
  EXPECT_LT(glm::distance(middle_of(pose_), middle_of(before)), 1e-6);
  // The ring about x is seen edge-on from the front; a drag along it turns all the same.
  calls_ = finished_ = 0;
  overview_->SetTissuePose(0, before);
  const auto edge = overview_->RingPlaces(0);
  Drag(Button::kLeft, edge[40], edge[40] + glm::dvec2(0, 6));
  EXPECT_EQ(finished_, 1);
  EXPECT_NEAR(std::abs(glm::axis(pose_.quaternion).x), 1, 1e-6);
}

TEST_F(OverviewTest, DragsOnArmsAndRingsSnapToTheSteps) {
  overview_->ChooseTissue(0);
  overview_->LookFrom(Overview::Side::kFront);
  overview_->Render(kOverviewSize, kOverviewSize);
  overview_->snap_step = 1e-3;
  overview_->snap_turn = RadiansFromDegrees(15);
  const Pose before = scene_.scene.tissues[0].pose;
  const auto ring = overview_->RingPlaces(2);
  Drag(Button::kLeft, ring[8], ring[12]);  // 22.5 degrees
  const double degrees = DegreesFromRadians(glm::angle(pose_.quaternion));
  EXPECT_NEAR(std::remainder(degrees, 15), 0, 1e-6) << degrees;
  EXPECT_GT(degrees, 1);
  overview_->SetTissuePose(0, before);
  overview_->Render(kOverviewSize, kOverviewSize);
  const auto arm = overview_->ArmPlaces()[0];
  Drag(Button::kLeft, arm, arm + glm::dvec2(11, 2));
  const double mm = MmFromMetres(pose_.position.x - before.position.x);
  EXPECT_NEAR(mm, std::round(mm), 1e-6) << mm;
  EXPECT_GT(mm, 0.5);
}

TEST_F(OverviewTest, LooksAlongTheAxesOfThePortalFrame) {
  const glm::dvec3 middle(0.0, 0.003, 0.0225);
  const auto way = [&](const glm::dvec3& along) {
    const auto from = overview_->PixelOf(middle), to = overview_->PixelOf(middle + 1e-3 * along);
    return to && from ? *to - *from : glm::dvec2(1e6);
  };
  const glm::dvec3 right(1, 0, 0), down(0, 1, 0), in(0, 0, 1);
  const auto look = [&](Overview::Side side) {
    overview_->LookFrom(side);
    overview_->Render(kOverviewSize, kOverviewSize);
  };
  look(Overview::Side::kFront);
  EXPECT_GT(way(right).x, 1);
  EXPECT_GT(way(down).y, 1);
  EXPECT_LT(glm::length(way(in)), 0.1);
  look(Overview::Side::kTop);
  EXPECT_GT(way(right).x, 1);
  EXPECT_LT(way(in).y, -1);
  EXPECT_LT(glm::length(way(down)), 0.1);
  look(Overview::Side::kRight);
  EXPECT_GT(way(in).x, 1);
  EXPECT_GT(way(down).y, 1);
  EXPECT_LT(glm::length(way(right)), 0.1);
}

TEST_F(OverviewTest, AHiddenTissueIsNeitherDrawnNorPicked) {
  const ColourImage with = overview_->ReadPixels();
  const double edge = EdgeOfTissue();
  ASSERT_GT(edge, 0);
  overview_->ShowTissue(0, false);
  EXPECT_TRUE(overview_->Render(kOverviewSize, kOverviewSize));
  EXPECT_FALSE(overview_->PickTissue(edge, middle_.y));
  EXPECT_NE(overview_->ReadPixels().rgb, with.rgb);
  overview_->ChooseTissue(0);
  EXPECT_FALSE(overview_->HandlePlace());
  overview_->ChooseTissue(-1);
  overview_->ShowTissue(0, true);
  overview_->Render(kOverviewSize, kOverviewSize);
  EXPECT_EQ(overview_->ReadPixels().rgb, with.rgb);
}

TEST_F(OverviewTest, WithoutToolsRodsAndLabelsAreGoneUntilTheyAreShownAgain) {
  overview_->SetTools({{{0.0, 0.0, 0.02}, {0, 0, 1}, {0, -1, 0}}, 1.5, std::nullopt});
  overview_->Render(kOverviewSize, kOverviewSize);
  const ColourImage with = overview_->ReadPixels();
  overview_->ShowTools(false);
  EXPECT_TRUE(overview_->Render(kOverviewSize, kOverviewSize));
  const ColourImage without = overview_->ReadPixels();
  EXPECT_NE(without.rgb, with.rgb);
  // A scope that moves stays hidden.
  overview_->SetTools({{{0.0, 0.01, 0.03}, {0, 0, 1}, {0, -1, 0}}, 1.5, std::nullopt});
  overview_->Render(kOverviewSize, kOverviewSize);
  EXPECT_EQ(overview_->ReadPixels().rgb, without.rgb);
  overview_->SetTools({{{0.0, 0.0, 0.02}, {0, 0, 1}, {0, -1, 0}}, 1.5, std::nullopt});
  overview_->ShowTools(true);
  overview_->Render(kOverviewSize, kOverviewSize);
  EXPECT_EQ(overview_->ReadPixels().rgb, with.rgb);
}

// The tissue is a few pixels wide in a small overview.
TEST_F(OverviewTest, AClickBesideATissueTakesItsNearestPlace) {
  const double x = EdgeOfTissue();
  ASSERT_GT(x, 0);
  EXPECT_FALSE(overview_->PickTissue(x + 5, middle_.y));
  const auto place = overview_->PickTissueNear(x + 5, middle_.y, 10);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->tissue, 0);
  EXPECT_FALSE(overview_->PickTissueNear(x + 25, middle_.y, 10));
}

TEST_F(OverviewTest, APartHasTheHandleInsteadOfItsTissue) {
  overview_->ChooseTissue(0);
  const Pose tissue = scene_.scene.tissues[0].pose;
  Pose at = tissue;
  at.position += glm::dvec3(0.004, 0, 0);
  const SharedSurface ball = Share(test::Sphere({0, 0, 0}, 0.002, 3));
  overview_->ShowPart(ball, at);
  Pose moved;
  int calls = 0;
  overview_->on_part = [&](const Pose& pose, bool) {
    moved = pose;
    ++calls;
  };
  overview_->Render(kOverviewSize, kOverviewSize);
  EXPECT_LT(glm::distance(*overview_->HandlePlace(), *overview_->PixelOf(at.position)), 1.0);
  calls_ = 0;
  const auto ends = overview_->ArmPlaces();
  ASSERT_EQ(ends.size(), 3u);
  Drag(Button::kLeft, ends[0], ends[0] + (ends[0] - *overview_->HandlePlace()));
  EXPECT_GT(calls, 0);
  EXPECT_EQ(calls_, 0) << "the tissue stays";
  EXPECT_GT(moved.position.x - at.position.x, 2e-3);
  const glm::dvec2 middle = *overview_->HandlePlace();
  calls = 0;
  Drag(Button::kRight, middle, middle - glm::dvec2(0, 50));
  EXPECT_GT(calls, 0);
  EXPECT_GT(std::abs(moved.scale / at.scale - 1.0), 0.05);
  overview_->ShowPart(nullptr, {});
  calls_ = 0;
  overview_->Render(kOverviewSize, kOverviewSize);
  const glm::dvec2 of_tissue = *overview_->HandlePlace();
  Drag(Button::kLeft, of_tissue, of_tissue + glm::dvec2(20, 0));
  EXPECT_GT(calls_, 0) << "it has its handle back";
}

TEST_F(OverviewTest, MarksAndColoursAreDrawnOnATissueAndGoAgain) {
  const auto drawn = [&] {
    overview_->Render(kOverviewSize, kOverviewSize);
    return overview_->ReadPixels().rgb;
  };
  const auto before = drawn();
  const SurfaceMesh& surface = *scene_.surfaces[0];
  const auto [a, b, c] = surface.triangles[0];
  app::SurfaceMark mark;
  mark.edges = {{surface.vertices[a], surface.vertices[b]}};
  for (const auto& [i, j, k] : surface.triangles)
    mark.triangles.push_back({surface.vertices[i], surface.vertices[j], surface.vertices[k]});
  mark.colour = {1, 0, 0};
  overview_->ShowMarks(0, std::vector{mark});
  EXPECT_NE(drawn(), before);
  overview_->ShowMarks(-1, {});
  EXPECT_EQ(drawn(), before);
  const std::vector<glm::dvec3> blue(surface.vertices.size(), glm::dvec3(0, 0, 1));
  overview_->SetTissueColours(0, blue);
  EXPECT_NE(drawn(), before);
  overview_->SetTissueSurface(0, surface);
  EXPECT_EQ(drawn(), before);
}

TEST_F(OverviewTest, BallsAreDrawnWhereATissueIsHeldWithTheChosenOneHighlighted) {
  const auto drawn = [&] {
    overview_->Render(kOverviewSize, kOverviewSize);
    return overview_->ReadPixels().rgb;
  };
  const auto before = drawn();
  const std::vector<Ball> balls = {{{0.007, 0, 0.002}, 0.003}, {{-0.007, 0, 0.002}, 0.003}};
  overview_->ShowBalls(0, balls, -1);
  const auto held = drawn();
  EXPECT_NE(held, before);
  overview_->ShowBalls(0, balls, -1);
  EXPECT_FALSE(overview_->Render(kOverviewSize, kOverviewSize)) << "nothing changed";
  overview_->ShowBalls(0, balls, 1);
  EXPECT_NE(drawn(), held);
  overview_->ShowBalls(-1, {}, -1);
  EXPECT_EQ(drawn(), before);
}

TEST_F(OverviewTest, WithoutAChosenTissueADragOnlyTurnsTheView) {
  const ColourImage before = overview_->ReadPixels();
  Drag(Button::kLeft, middle_, middle_ + glm::dvec2(60, 20));
  EXPECT_EQ(calls_, 0);
  EXPECT_NE(overview_->ReadPixels().rgb, before.rgb);
  overview_->ResetCamera();
  overview_->Render(kOverviewSize, kOverviewSize);
  EXPECT_EQ(overview_->ReadPixels().rgb, before.rgb);
}

TEST_F(OverviewTest, APoseSetElsewhereMovesTheBox) {
  overview_->ChooseTissue(0);
  Pose pose = scene_.scene.tissues[0].pose;
  pose.scale = 1.5;
  pose.quaternion = glm::dquat(std::cos(0.4), 0, 0, std::sin(0.4));
  overview_->SetTissuePose(0, pose);
  overview_->Render(kOverviewSize, kOverviewSize);
  Drag(Button::kLeft, middle_, middle_ + glm::dvec2(20, 10));
  ASSERT_GE(calls_, 1);
  EXPECT_NEAR(pose_.scale, 1.5, 1e-6);
  EXPECT_NEAR(std::abs(glm::dot(pose_.quaternion, pose.quaternion)), 1.0, 1e-6);
}

TEST_F(OverviewTest, SharesAContextWithTheArthroscopicViewWithoutInterference) {
  app::ArthroscopicView view;
  view.SetBackdrop(*scene_.panorama, *scene_.depth, scene_.scene.backdrop);
  view.SetTissues(scene_.scene.tissues, scene_.surfaces);
  app::Picture picture = app::PictureFromPose({-0.1, 0.05, 0.2, 0.008}, 0.5, 1.5);
  picture.instrument = ProbeInFront();
  view.Render(picture, 200);
  const ColourImage inside = view.ReadPixels(), outside = overview_->ReadPixels();
  overview_->ResetCamera();
  EXPECT_TRUE(overview_->Render(kOverviewSize, kOverviewSize));
  EXPECT_EQ(overview_->ReadPixels().rgb, outside.rgb);
  view.Render(picture, 200);
  EXPECT_EQ(view.ReadPixels().rgb, inside.rgb);
}

TEST_F(OverviewTest, WholeSceneFromOutside) {
  app::OverviewTools tools;
  tools.scope = app::PictureFromPose({-0.1, 0.05, 0.2, 0.008}, RadiansFromDegrees(30), 1.2).view;
  tools.field_of_view = 1.2;
  tools.instrument = ProbeInFront();
  overview_->SetTissuePose(0, MakeViewScene(64, 64).scene.tissues[0].pose);
  overview_->SetTools(tools);
  overview_->ChooseTissue(0);
  overview_->Render(kOverviewSize, kOverviewSize);
  EXPECT_TRUE(MatchesBaseline(overview_->ReadPixels(), "overview"));
}

}  // namespace
}  // namespace arthro::test
