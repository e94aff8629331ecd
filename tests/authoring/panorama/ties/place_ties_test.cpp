// Frames placed by tie points in a whole run, on clips made in code with known places.
#include "authoring/panorama/ties/place_ties.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "authoring/panorama/make_panorama.h"
#include "authoring/panorama/report_io.h"
#include "authoring/panorama/ties/clicked_tie.h"
#include "simulation/core/error.h"
#include "tests/authoring/panorama/tiny_clip.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

using test::TinyClip;

cv::Point2d Through(const cv::Matx33d& h, cv::Point2d p) {
  const cv::Vec3d q = h * cv::Vec3d(p.x, p.y, 1);
  return {q[0] / q[2], q[1] / q[2]};
}

// A clip of five views along an arc; the last lies so far away that it does not register.
class TiedClip : public ::testing::Test {
 protected:
  void SetUp() override {
    views_ = TinyClip::Arc(4);
    views_.push_back({{views_[3].at.x + 165, views_[3].at.y - 20}, 0.05});
    clip_.WriteAll(folder_ / "clip", views_);
    request_.footage = folder_ / "clip";
  }

  // The same point of the texture in two views.
  FrameTie Tie(int frame, int other, cv::Point2d in_frame, cv::Point2d off = {0, 0}) const {
    const cv::Matx33d other_from_frame =
        TinyClip::TextureFromRaw(views_[static_cast<std::size_t>(other)]).inv() *
        TinyClip::TextureFromRaw(views_[static_cast<std::size_t>(frame)]);
    const cv::Point2d q = Through(other_from_frame, in_frame) + off;
    FrameTie tie;
    tie.frame = frame;
    tie.pixel = {in_frame.x, in_frame.y};
    tie.other = TieInFrame{other, {q.x, q.y}};
    return tie;
  }

  // Worst of the window's points in the places of two frames by the report and by the truth, px.
  double PairError(const PanoramaReport& report, int frame, int other) const {
    const auto at = [&](int i) {
      return cv::Matx33d(report.frames[static_cast<std::size_t>(i)].panorama_from_rectified.data());
    };
    const auto truth_at = [&](int i) {
      return TinyClip::TextureFromRaw(views_[static_cast<std::size_t>(i)]);
    };
    const cv::Matx33d found = at(other).inv() * at(frame),
                      truth = truth_at(other).inv() * truth_at(frame);
    double worst = 0;
    for (const double x : {60.0, 140.0, 220.0})
      for (const double y : {60.0, 119.0, 180.0})
        worst = std::max(worst, cv::norm(Through(found, {x, y}) - Through(truth, {x, y})));
    return worst;
  }

  std::string SentenceOf(std::vector<FrameTie> ties) {
    request_.ties = std::move(ties);
    try {
      session_.Run(request_, {}, {});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::kBadData);
      return error.sentence();
    }
    return "";
  }

  TinyClip clip_;
  test::TempFolder folder_;
  std::vector<TinyClip::View> views_;
  PanoramaRequest request_;
  PanoramaSession session_;
};

TEST_F(TiedClip, TwoPairsAddTheFrameAndLeaveAllOtherPlaces) {
  const PanoramaResult before = session_.Run(request_, {}, {});
  ASSERT_FALSE(before.report.frames[4].is_placed) << "the clip must have a frame to tie";
  request_.ties = {Tie(4, 3, {45, 90}), Tie(4, 3, {60, 170})};
  EXPECT_EQ(session_.NextStage(request_), "tie");
  const PanoramaResult after = session_.Run(request_, {}, {});
  ASSERT_TRUE(after.report.frames[4].is_placed);
  ASSERT_EQ(after.report.tied.size(), 1u);
  EXPECT_EQ(after.report.tied[0].index, 4);
  EXPECT_EQ(after.report.tied[0].pairs, 2);
  // The error that the report states for the worst of nine points holds here.
  EXPECT_LE(PairError(after.report, 4, 3), after.report.tied[0].expected_error_px);
  // Between themselves the others lie as before, bit by bit: only the origin of the panorama moves.
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(PairError(after.report, i, 0), PairError(before.report, i, 0), 1e-9);
  EXPECT_GT(after.picture.width, before.picture.width);
  // The same request again does nothing, and the same ties from the start give the same bytes.
  EXPECT_EQ(session_.NextStage(request_), "");
  EXPECT_EQ(MakePanorama(request_, {}).picture.rgba, after.picture.rgba);
}

TEST_F(TiedClip, APairWithThePanoramaIsThatWithItsFrame) {
  const PanoramaResult before = session_.Run(request_, {}, {});
  const FrameTie first = Tie(4, 3, {45, 90}), second = Tie(4, 3, {60, 170});
  request_.ties = {first, second};
  const PanoramaResult by_frame = session_.Run(request_, {}, {});
  request_.ties.clear();
  for (const FrameTie& tie : {first, second}) {
    const auto pixel = PanoramaPixelOf(before.report, *tie.other);
    ASSERT_TRUE(pixel);
    const auto back = FrameAt(before.report, *pixel);
    ASSERT_TRUE(back);
    EXPECT_LT(glm::distance(*PanoramaPixelOf(before.report, *back), *pixel), 1e-6);
    FrameTie& on_panorama = request_.ties.emplace_back(tie);
    on_panorama.other.reset();
    on_panorama.panorama = TieInPanorama{*pixel};
  }
  const PanoramaResult by_panorama = session_.Run(request_, {}, {});
  EXPECT_NEAR(PairError(by_panorama.report, 4, 3), PairError(by_frame.report, 4, 3), 0.01);
}

// The report alone, as a job reads it from a file, stands for the registration.
TEST_F(TiedClip, KnownPlacesTakeTheTiedFrameWithoutMatchingAnyPair) {
  const PanoramaResult before = MakePanorama(request_, {});
  request_.known =
      std::make_shared<const PanoramaReport>(ReportFromJson(JsonFromReport(before.report)));
  const PanoramaResult again = MakePanorama(request_, {});
  EXPECT_EQ(again.picture.width, before.picture.width);
  EXPECT_EQ(again.picture.height, before.picture.height);
  EXPECT_NEAR(again.report.panorama.focal_px, before.report.panorama.focal_px, 1e-9);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(PairError(again.report, i, 0), PairError(before.report, i, 0), 1e-9);
  EXPECT_FALSE(again.report.frames[4].is_placed);

  request_.ties = {Tie(4, 3, {45, 90}), Tie(4, 3, {60, 170})};
  const PanoramaResult after = MakePanorama(request_, {});
  ASSERT_TRUE(after.report.frames[4].is_placed);
  EXPECT_LE(PairError(after.report, 4, 3), after.report.tied[0].expected_error_px);
  for (const StageCost& stage : after.report.stages) EXPECT_NE(stage.name, "pairs");
  request_.known = nullptr;
  const PanoramaResult whole = MakePanorama(request_, {});
  EXPECT_NEAR(PairError(after.report, 4, 3), PairError(whole.report, 4, 3), 0.02);
  // A frame that was tied before has its place by ties, which are given again.
  request_.known = std::make_shared<const PanoramaReport>(after.report);
  EXPECT_TRUE(MakePanorama(request_, {}).report.frames[4].is_placed);
  request_.ties.clear();
  EXPECT_FALSE(MakePanorama(request_, {}).report.frames[4].is_placed);
}

TEST_F(TiedClip, PlacesOfAnotherClipAreRefused) {
  PanoramaReport other = MakePanorama(request_, {}).report;
  other.frames.pop_back();
  request_.known = std::make_shared<const PanoramaReport>(other);
  try {
    MakePanorama(request_, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("the report has 4 frames and the footage 5"), std::string::npos)
        << error.sentence();
  }
}

TEST_F(TiedClip, TiesThatCannotBeUsedAreRefusedAndNamed) {
  EXPECT_NE(SentenceOf({Tie(4, 3, {45, 90})}).find("frame 4 was not placed by its pairs"),
            std::string::npos);
  EXPECT_NE(SentenceOf({Tie(2, 3, {45, 90}), Tie(2, 3, {60, 170})}).find("in the panorama already"),
            std::string::npos);
  EXPECT_NE(SentenceOf({Tie(4, 3, {45, 90}), Tie(4, 3, {60, 170}), Tie(4, 3, {30, 130}),
                        Tie(4, 3, {70, 120}, {-30, -45})})
                .find("pair 4 of frame 4 misses"),
            std::string::npos);
  FrameTie beyond = Tie(4, 3, {45, 90});
  beyond.frame = 9;
  EXPECT_NE(SentenceOf({beyond, beyond}).find("the clip has 5 frames"), std::string::npos);
  FrameTie outside = Tie(4, 3, {45, 90});
  outside.pixel = {900, 20};
  EXPECT_NE(SentenceOf({outside, Tie(4, 3, {60, 170})}).find("outside of what the lens shows"),
            std::string::npos);
  // Nothing of this changed the panorama that the session keeps.
  request_.ties.clear();
  EXPECT_FALSE(session_.Run(request_, {}, {}).report.frames[4].is_placed);
}

// Text is burned into the same place of every frame while the tissue moves.
TEST_F(TiedClip, BurnedInTextIsFoundAndNotDrawnWhereItIsMasked) {
  const cv::Rect text(120, 60, 42, 12);  // four letters of 6 px, 12 px apart
  const std::vector<TinyClip::View> views = TinyClip::Arc(9);
  std::filesystem::create_directory(folder_ / "text");
  for (std::size_t i = 0; i < views.size(); ++i) {
    cv::Mat frame = clip_.Frame(views[i], static_cast<unsigned>(i) + 1);
    for (int letter = 0; letter < 4; ++letter)
      cv::rectangle(frame, {text.x + 12 * letter, text.y, 6, text.height}, {255, 255, 255},
                    cv::FILLED);
    TinyClip::Write(folder_ / "text" / fmt::format("{:03}.png", i), frame);
  }
  const auto white = [](const RgbaPicture& picture) {
    int count = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
      count += picture.rgba[i] > 235 && picture.rgba[i + 1] > 235 && picture.rgba[i + 2] > 235;
    return count;
  };
  request_.footage = folder_ / "text";
  const PanoramaResult as_filmed = session_.Run(request_, {}, {});
  ASSERT_GE(as_filmed.report.text_boxes.size(), 1u);
  const PixelBox& box = as_filmed.report.text_boxes[0];
  const cv::Rect found(box.x, box.y, box.width, box.height);
  EXPECT_EQ((found & text), text) << "the proposal covers the text";
  // Two working pixels of two raw pixels each: the blur of a stroke, and its last pixel.
  const cv::Rect near(text.x - 4, text.y - 4, text.width + 8, text.height + 8);
  EXPECT_EQ((found | near), near) << "the proposal is no larger than the text asks for: "
                                  << found.area() << " px² for " << text.area();
  EXPECT_EQ(as_filmed.report.text_boxes.size(), 1u);
  // The automatic proposal, then a rectangle of a person.
  request_.options.mask_text = true;
  const PanoramaResult proposed = session_.Run(request_, {}, {});
  request_.options.mask_text = false;
  request_.masked = {{text.x - 3, text.y - 3, text.width + 6, text.height + 6}};
  const PanoramaResult painted = session_.Run(request_, {}, {});
  EXPECT_LE(white(proposed.picture), white(as_filmed.picture));
  EXPECT_EQ(white(proposed.picture), 0);
  EXPECT_EQ(white(painted.picture), 0);
  for (const FrameReport& frame : painted.report.frames) EXPECT_TRUE(frame.is_placed);
}

TEST_F(TiedClip, SeveralClipsAreOnePanoramaAndTellWhichFrameIsWhose) {
  clip_.WriteAll(folder_ / "a", {views_[0], views_[1]});
  clip_.WriteAll(folder_ / "b", {views_[2], views_[3]});
  request_.footage = folder_ / "a";
  request_.joined = {folder_ / "b"};
  const PanoramaResult result = session_.Run(request_, {}, {});
  ASSERT_EQ(result.report.frames.size(), 4u);
  EXPECT_EQ(result.report.frames[2].source, "b:0");
  EXPECT_EQ(result.report.frames[2].clip, 1);
  for (const FrameReport& frame : result.report.frames)
    EXPECT_TRUE(frame.is_placed) << frame.reason;
  ASSERT_EQ(result.report.clips.size(), 2u);
  EXPECT_EQ(result.report.clips[1].first_frame, 2);
  EXPECT_EQ(result.report.clips[1].placed, 2);
  EXPECT_LT(PairError(result.report, 2, 1), 1.0) << "as MakePanorama asks of neighbours";
}

TEST_F(TiedClip, AClipThatDoesNotJoinIsNamed) {
  clip_.WriteAll(folder_ / "far", {{{700, 120}, 0.0}, {{752, 120}, 0.0}});
  request_.footage = folder_ / "clip";
  request_.joined = {folder_ / "far"};
  request_.excluded = {4};
  const PanoramaResult result = session_.Run(request_, {}, {});
  bool is_named = false;
  for (const std::string& warning : result.report.warnings)
    is_named = is_named || warning.starts_with("far: none of its 2 frames");
  EXPECT_TRUE(is_named);
}

}  // namespace
}  // namespace arthro::authoring
