// The whole path from footage to panorama, on clips made in code.
#include "authoring/panorama/make_panorama.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "authoring/panorama/report_io.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/process_cost.h"
#include "tests/authoring/panorama/tiny_clip.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

using test::TinyClip;

cv::Matx33d MatrixOf(const FrameReport& frame) {
  return cv::Matx33d(frame.panorama_from_rectified.data());
}

cv::Point2d Through(const cv::Matx33d& h, cv::Point2d p) {
  const cv::Vec3d q = h * cv::Vec3d(p.x, p.y, 1);
  return {q[0] / q[2], q[1] / q[2]};
}

// Largest distance over nine points of a frame between their positions in frame `other` by the
// report and by the truth, px of that frame.
double PairError(const PanoramaReport& report, const std::vector<TinyClip::View>& views, int frame,
                 int other) {
  const cv::Matx33d found = MatrixOf(report.frames[other]).inv() * MatrixOf(report.frames[frame]);
  const cv::Matx33d truth =
      TinyClip::TextureFromRaw(views[other]).inv() * TinyClip::TextureFromRaw(views[frame]);
  double worst = 0;
  for (int i = 0; i < 9; ++i) {
    const double r = i == 0 ? 0 : 0.85 * TinyClip::kRadius, a = i * 0.785398;
    const cv::Point2d p(TinyClip::kCx + r * std::cos(a), TinyClip::kCy + r * std::sin(a));
    worst = std::max(worst, cv::norm(Through(found, p) - Through(truth, p)));
  }
  return worst;
}

PanoramaRequest RequestFor(const std::filesystem::path& footage) {
  PanoramaRequest request;
  request.footage = footage;
  return request;
}

std::string SentenceOf(const PanoramaRequest& request) {
  try {
    MakePanorama(request, {});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(MakePanorama, PlacesEveryFrameOfASmallClipWithoutALens) {
  const test::TempFolder folder;
  const auto views = TinyClip::Arc(6);
  TinyClip().WriteAll(folder / "clip", views);
  const PanoramaResult result = MakePanorama(RequestFor(folder / "clip"), {});
  const PanoramaReport& report = result.report;
  ASSERT_EQ(report.frames.size(), 6u);
  for (const FrameReport& frame : report.frames) EXPECT_TRUE(frame.is_placed) << frame.reason;
  EXPECT_FALSE(report.is_partial) << report.summary;
  // Neighbours share three quarters of a window of 224 px with 1 grey level of noise. Half a pixel
  // at the rim is the accuracy of larger clips too.
  for (int i = 1; i < 6; ++i) EXPECT_LT(PairError(report, views, i, i - 1), 0.5) << i;
  EXPECT_LT(PairError(report, views, 5, 0), 2.5);  // five steps on, no loop

  EXPECT_TRUE(report.is_lens_guessed);
  EXPECT_EQ(report.lens.model, LensModel::kPinhole);
  EXPECT_NEAR(report.lens.circle.r, TinyClip::kRadius, 1.0);
  EXPECT_EQ(report.rectified.width, TinyClip::kWidth);  // raw pixels equal rectified ones
  EXPECT_EQ(report.panorama.width, result.picture.width);
  EXPECT_EQ(report.panorama.height, result.picture.height);
  EXPECT_GT(report.panorama.focal_px, 0);
  EXPECT_EQ(result.picture.rgba.size(),
            static_cast<std::size_t>(result.picture.width) * result.picture.height * 4);
  // The middle of each frame is imaged, with the frames' colour.
  for (const FrameReport& frame : report.frames) {
    const cv::Point2d p = Through(MatrixOf(frame), {TinyClip::kCx, TinyClip::kCy});
    const std::size_t at = (static_cast<std::size_t>(std::lround(p.y)) * result.picture.width +
                            static_cast<std::size_t>(std::lround(p.x))) *
                           4;
    ASSERT_LT(at, result.picture.rgba.size());
    EXPECT_EQ(result.picture.rgba[at + 3], 255);
    EXPECT_GT(result.picture.rgba[at], 60);
  }
}

// Bars along the edges of a film or a sensor are neither tissue nor its edge.
TEST(MakePanorama, BlackBarsDoNotReachThePanorama) {
  const test::TempFolder folder;
  const TinyClip clip;
  const auto views = TinyClip::Arc(3);
  for (int i = 0; i < 3; ++i) {
    cv::Mat frame = clip.Frame(views[static_cast<std::size_t>(i)], 1u + static_cast<unsigned>(i));
    frame.rowRange(0, 30) = cv::Scalar(2, 2, 2);
    frame.rowRange(TinyClip::kHeight - 30, TinyClip::kHeight) = cv::Scalar(2, 2, 2);
    TinyClip::Write(folder / fmt::format("{}.png", i), frame);
  }
  const PanoramaResult result = MakePanorama(RequestFor(folder.path()), {});
  const PanoramaReport& report = result.report;
  EXPECT_EQ(report.lens.height, TinyClip::kHeight);  // refers to the raw picture nevertheless
  EXPECT_NEAR(report.lens.circle.cy, TinyClip::kCy, 1.0);
  for (int i = 1; i < 3; ++i) EXPECT_LT(PairError(report, views, i, i - 1), 0.5) << i;
  int dark = 0;
  for (std::size_t i = 0; i < result.picture.rgba.size(); i += 4)
    dark += result.picture.rgba[i + 3] == 255 && result.picture.rgba[i] < 30;
  EXPECT_EQ(dark, 0);
}

// PAN-02, PAN-13.
TEST(MakePanorama, EveryFrameThatIsNotUsedSaysWhy) {
  const test::TempFolder folder;
  const TinyClip clip;
  const auto views = TinyClip::Arc(8);
  clip.WriteAll(folder.path(), views);
  cv::Mat red(TinyClip::kHeight, TinyClip::kWidth, CV_8UC3, cv::Scalar(130, 40, 36));
  TinyClip::Write(folder / "003.png", red);
  WriteAtomically(folder / "005.png", "not a picture");
  TinyClip::Write(folder / "006.png", cv::Mat(60, 80, CV_8UC3, cv::Scalar(90, 90, 90)));
  PanoramaRequest request = RequestFor(folder.path());
  request.excluded = {7};
  const PanoramaReport report = MakePanorama(request, {}).report;
  ASSERT_EQ(report.frames.size(), 8u);
  const auto says = [&](int frame, const char* words) {
    EXPECT_FALSE(report.frames[frame].is_placed);
    EXPECT_FALSE(report.frames[frame].is_usable);
    EXPECT_NE(report.frames[frame].reason.find(words), std::string::npos)
        << report.frames[frame].reason;
  };
  says(3, "blank: it is red");
  says(5, "unreadable: ");
  says(6, "80 x 60 px");
  says(7, "by hand");
  for (const int i : {0, 1, 2, 4}) EXPECT_TRUE(report.frames[i].is_placed) << i;
  EXPECT_NE(report.summary.find("4 of the clip's 8 frames were not used"), std::string::npos)
      << report.summary;
}

// PAN-13 and other footage without a panorama.
TEST(MakePanorama, RefusesInOneSentence) {
  const test::TempFolder folder;
  const TinyClip clip;
  clip.WriteAll(folder / "one", TinyClip::Arc(1));
  EXPECT_NE(SentenceOf(RequestFor(folder / "one")).find("only one of its 1 frame can be used"),
            std::string::npos)
      << SentenceOf(RequestFor(folder / "one"));
  std::filesystem::create_directories(folder / "none");
  EXPECT_NE(SentenceOf(RequestFor(folder / "none")).find("empty"), std::string::npos);

  std::filesystem::create_directories(folder / "blank");
  for (const char* name : {"1.png", "2.png", "3.png"})
    TinyClip::Write(folder / "blank" / name, cv::Mat(90, 120, CV_8UC3, cv::Scalar(3, 3, 3)));
  EXPECT_NE(SentenceOf(RequestFor(folder / "blank")).find("3 blank"), std::string::npos)
      << SentenceOf(RequestFor(folder / "blank"));

  // A lens for another size.
  clip.WriteAll(folder / "two", TinyClip::Arc(2));
  PanoramaRequest request = RequestFor(folder / "two");
  request.lens = Lens{};
  request.lens->width = 1920;
  request.lens->height = 1080;
  request.lens->focal_px = 900;
  EXPECT_NE(SentenceOf(request).find("1920 x 1080"), std::string::npos) << SentenceOf(request);

  // No overlap: three pieces of tissue far apart.
  std::filesystem::create_directories(folder / "apart");
  for (int i = 0; i < 3; ++i)
    TinyClip::Write(folder / "apart" / fmt::format("{}.png", i),
                    TinyClip(10u + static_cast<unsigned>(i)).Frame({{350, 300}, 0.0}));
  const std::string apart = SentenceOf(RequestFor(folder / "apart"));
  EXPECT_NE(apart.find("no two of its 3 usable frames"), std::string::npos) << apart;

  PanoramaOptions options;
  options.choose.every = 0;
  request = RequestFor(folder / "two");
  request.options = options;
  EXPECT_NE(SentenceOf(request).find("every"), std::string::npos);
}

// PAN-13: two frames are the least number.
TEST(MakePanorama, TwoFramesAreEnough) {
  const test::TempFolder folder;
  const auto views = TinyClip::Arc(2);
  TinyClip().WriteAll(folder.path(), views);
  const PanoramaReport report = MakePanorama(RequestFor(folder.path()), {}).report;
  EXPECT_TRUE(report.frames[0].is_placed && report.frames[1].is_placed);
  EXPECT_LT(PairError(report, views, 1, 0), 0.5);
}

// PAN-03: a piece that is not joined is reported and drawn by itself, never merged.
TEST(MakePanorama, PiecesThatDoNotJoinAreReported) {
  const test::TempFolder folder;
  const TinyClip here(1), there(2);
  const auto views = TinyClip::Arc(5);
  here.WriteAll(folder.path(), views);
  for (int i = 0; i < 3; ++i)
    TinyClip::Write(
        folder / fmt::format("{:03}.png", 5 + i),
        there.Frame(views[static_cast<std::size_t>(i)], 50u + static_cast<unsigned>(i)));
  const PanoramaResult result = MakePanorama(RequestFor(folder.path()), {});
  const PanoramaReport& report = result.report;
  EXPECT_TRUE(report.is_partial);
  EXPECT_NE(report.summary.find("partial: 5 of 8 usable frames"), std::string::npos)
      << report.summary;
  for (int i = 0; i < 8; ++i) EXPECT_EQ(report.frames[i].is_placed, i < 5) << i;
  ASSERT_EQ(report.pieces.size(), 1u);
  EXPECT_EQ(report.pieces[0].frames, 3);
  ASSERT_EQ(result.pieces.size(), 1u);
  EXPECT_FALSE(result.pieces[0].empty());
  EXPECT_EQ(report.frames[6].component, report.pieces[0].component);
  EXPECT_NE(report.frames[6].reason.find("does not join"), std::string::npos);
}

TEST(MakePanorama, OnlyWhatChangedIsDoneAgain) {
  const test::TempFolder folder;
  TinyClip().WriteAll(folder.path(), TinyClip::Arc(5));
  PanoramaSession session;
  PanoramaRequest request = RequestFor(folder.path());
  int pictures = 0, rows = 0, mosaics = 0;
  PanoramaObserver observer;
  observer.frame = [&](const FrameReport&, const ColourImage& small) {
    small.empty() ? ++rows : ++pictures;
  };
  observer.mosaic = [&](const RgbaPicture& mosaic) { mosaics += !mosaic.empty(); };
  std::vector<std::string> stages;
  Progress progress;
  progress.report = [&](std::string_view words, double) { stages.emplace_back(words); };
  const auto has = [&](const char* words) {
    return std::any_of(stages.begin(), stages.end(),
                       [&](const std::string& stage) { return stage.find(words) == 0; });
  };

  const PanoramaResult first = session.Run(request, observer, progress);
  EXPECT_EQ(pictures, 5);
  EXPECT_EQ(rows, 10);  // each frame when its position is known, and at the end
  EXPECT_GT(mosaics, 0);
  EXPECT_TRUE(has("reading frame 1 of 5"));

  stages.clear();
  const PanoramaResult again = session.Run(request, observer, progress);  // nothing changed
  EXPECT_TRUE(stages.empty());
  EXPECT_EQ(again.picture.rgba, first.picture.rgba);

  request.options.compose.feather = 20;  // only the last stage
  session.Run(request, observer, progress);
  EXPECT_FALSE(stages.empty());
  EXPECT_FALSE(has("reading frame"));

  stages.clear();
  request.excluded = {4};  // registration and what follows
  const PanoramaResult fewer = session.Run(request, observer, progress);
  EXPECT_FALSE(has("reading frame"));
  EXPECT_EQ(fewer.report.frames[4].reason, "left out by hand");
  EXPECT_TRUE(fewer.report.frames[3].is_placed);
  EXPECT_EQ(pictures, 5);

  request.excluded.clear();
  request.options.compose.feather = ComposeOptions().feather;
  EXPECT_EQ(session.Run(request, observer, progress).picture.rgba, first.picture.rgba);

  // Before and after, for the window.
  const auto raw = session.PictureOf(2, FrameStage::kRaw);
  ASSERT_TRUE(raw);
  EXPECT_EQ(raw->width, TinyClip::kWidth);
  ASSERT_TRUE(session.PictureOf(2, FrameStage::kRectified));
  ASSERT_TRUE(session.PictureOf(2, FrameStage::kEvenLight));
  EXPECT_FALSE(session.PictureOf(99, FrameStage::kRaw));
  EXPECT_FALSE(session.PictureOf(-1, FrameStage::kEvenLight));
}

// PAN-20.
TEST(MakePanorama, StopsWithinHalfASecondInEveryStage) {
  const test::TempFolder folder;
  TinyClip().WriteAll(folder.path(), TinyClip::Arc(6));
  // The stages' own words, recorded in a complete run.
  std::vector<std::string> stages;
  Progress listen;
  const auto stage_of = [](std::string_view words) {
    return std::string(words.substr(0, words.find_first_of("0123456789,")));
  };
  listen.report = [&](std::string_view words, double) {
    if (const std::string stage = stage_of(words); stages.empty() || stages.back() != stage)
      stages.push_back(stage);
  };
  MakePanorama(RequestFor(folder.path()), listen);
  std::sort(stages.begin(), stages.end());
  stages.erase(std::unique(stages.begin(), stages.end()), stages.end());
  ASSERT_GE(stages.size(), 4u);
  PanoramaSession session;
  for (const std::string& stage : stages) {
    std::atomic<bool> stop{false};
    double told_ms = 0;
    Progress progress;
    progress.stop = &stop;
    progress.report = [&](std::string_view words, double) {
      if (stop || stage_of(words) != stage) return;
      told_ms = ProcessCpuMs();
      stop = true;
    };
    try {
      PanoramaSession().Run(RequestFor(folder.path()), {}, progress);
      ADD_FAILURE() << stage << " did not stop";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::kCancelled) << stage << ": " << error.what();
    }
    // Processor time of all threads, so that a busy machine has no effect.
    EXPECT_LT(ProcessCpuMs() - told_ms, 500) << stage;
  }
  // A session that was stopped continues from its completed stages.
  EXPECT_FALSE(session.Run(RequestFor(folder.path()), {}, {}).picture.empty());
}

TEST(MakePanorama, SameInputSameBytesAtAnyNumberOfThreads) {
  const test::TempFolder folder;
  TinyClip().WriteAll(folder.path(), TinyClip::Arc(5));
  const auto run = [&](int threads) {
    cv::setNumThreads(threads);
    PanoramaRequest request = RequestFor(folder.path());
    request.options.registration.threads = threads;
    PanoramaResult result = MakePanorama(request, {});
    result.report.stages.clear();  // costs may differ
    result.report.peak_memory_mb = 0;
    result.report.options.clear();
    return std::pair(JsonFromReport(result.report), result.picture.rgba);
  };
  const auto one = run(1), three = run(3);
  cv::setNumThreads(-1);
  EXPECT_EQ(one.first, three.first);
  EXPECT_EQ(one.second, three.second);
}

// The drawing is nearly half of the work: a bar that stood at its end before it told nothing.
TEST(MakePanorama, TheEndIsNotReportedBeforeThePanoramaIsDrawn) {
  const test::TempFolder folder;
  TinyClip().WriteAll(folder / "clip", TinyClip::Arc(4));
  std::map<std::string, double> first;  // share done when a stage begins
  Progress progress;
  progress.report = [&](std::string_view words, double done) {
    first.emplace(words.substr(0, words.find(',')), done);
  };
  MakePanorama(RequestFor(folder / "clip"), progress);
  ASSERT_TRUE(first.contains("blend detail") && first.contains("finish"));
  EXPECT_LT(first.at("even light"), first.at("blend detail"));
  EXPECT_LT(first.at("blend detail"), 0.85);
  EXPECT_LT(first.at("finish"), 0.985) << "0.99 is the last that is shown";
}

TEST(MakePanorama, ProgressOnlyGoesForward) {
  const test::TempFolder folder;
  TinyClip().WriteAll(folder.path(), TinyClip::Arc(4));
  double last = 0;
  Progress progress;
  progress.report = [&](std::string_view words, double done) {
    EXPECT_GE(done, last) << words;
    EXPECT_LT(done, 1.0) << words;  // the end belongs to the writer
    last = done;
  };
  MakePanorama(RequestFor(folder.path()), progress);
  EXPECT_GT(last, 0.9);
}

}  // namespace
}  // namespace arthro::authoring
