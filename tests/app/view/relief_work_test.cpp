// Relief of a noisy depth map that is made beside the window.
#include "app/view/backdrop/relief_work.h"

#include <chrono>
#include <cstdio>
#include <random>
#include <thread>

#include "simulation/core/process_cost.h"
#include "tests/app/view/lit_scene.h"
#include "tests/app/view/view_scene.h"

namespace arthro::test {
namespace {

using namespace app;

constexpr float kNoise = 4e-4f;  // m

DepthMap NoisyDepth(int width, int height) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0f, kNoise);
  DepthMap depth(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      depth.at(x, y) = (x + y / 3 > width / 2 ? 0.016f : 0.008f) + noise(random);
  return depth;
}

ReliefWork::Source NoisySource(int width, int height) {
  return {std::make_shared<const DepthMap>(NoisyDepth(width, height)),
          std::make_shared<const DepthMap>(width, height, kNoise),
          {width, height},
          PlainBackdrop(width, height)};
}

std::shared_ptr<const DrawnRelief> Await(ReliefWork& work, const ReliefWork::Source& source) {
  while (work.busy()) {
    work.Collect();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return work.Find(source);
}

// A quarter of the real clip's map. Processor time of the calling thread does not depend on what
// else the machine does.
TEST(ReliefWork, TakesNoTimeOfTheCaller) {
  const ReliefWork::Source source = NoisySource(788, 579);
  ReliefWork work;
  const double before = ThreadCpuMs();
  EXPECT_EQ(work.Find(source), nullptr);
  const double asked = ThreadCpuMs() - before;
  EXPECT_TRUE(work.busy());
  const auto made = Await(work, source);
  ASSERT_NE(made, nullptr);
  const double start = ThreadCpuMs();
  const DrawnRelief at_once =
      MakeDrawnRelief(source.panorama_size, *source.depth, *source.sigma, source.backdrop);
  const double at_once_ms = ThreadCpuMs() - start;
  std::printf("asked for in %.2f ms of the caller's processor time; made at once in %.0f ms\n",
              asked, at_once_ms);
  EXPECT_LT(asked, 5);
  EXPECT_EQ(made->texture.texels, at_once.texture.texels) << "the same bytes";
  EXPECT_EQ(made->ceiling.relief, at_once.ceiling.relief);
  EXPECT_EQ(made->slopes.slopes, at_once.slopes.slopes);
  EXPECT_EQ(made->least_side, at_once.least_side);
}

TEST(ReliefWork, MakesTheReliefThatIsAskedForLast) {
  const ReliefWork::Source first = NoisySource(96, 64), second = NoisySource(64, 96);
  ReliefWork work;
  EXPECT_FALSE(work.Collect()) << "nothing is being made";
  EXPECT_EQ(work.Find(first), nullptr);
  EXPECT_EQ(work.Find(second), nullptr) << "while the first is made";
  EXPECT_EQ(Await(work, second), nullptr) << "begins now";
  const auto made = Await(work, second);
  ASSERT_NE(made, nullptr);
  EXPECT_EQ(made->texture.height, 96);
  EXPECT_EQ(work.Find(second), made) << "kept for the next panorama or light";
  EXPECT_EQ(work.Find(first), nullptr) << "not kept";
  EXPECT_NE(Await(work, first), nullptr);
}

// After a stroke of the brush the window drew the moved relief itself, 170 ms at 4096 x 2048.
TEST(ReliefWork, MovesTheLastReliefBesideTheCaller) {
  const ReliefWork::Source before = NoisySource(512, 384);
  const auto shown = std::make_shared<const DrawnRelief>(MakeDrawnRelief(
      before.panorama_size, *before.depth, *before.sigma, before.backdrop, NoiseRemoval::kRough));
  DepthMap raised = *before.depth;
  for (int y = 100; y < 130; ++y)
    for (int x = 200; x < 260; ++x) raised.at(x, y) += 1e-3f;
  ReliefWork::Source after = before;
  after.depth = std::make_shared<const DepthMap>(raised);
  ReliefWork work;
  const double begin = ThreadCpuMs();
  EXPECT_EQ(work.FindShifted(after, before, shown), nullptr);
  const double asked = ThreadCpuMs() - begin;
  EXPECT_TRUE(work.busy());
  while (work.busy()) {
    work.Collect();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const auto moved = work.FindShifted(after, before, shown);
  ASSERT_NE(moved, nullptr);
  const ReliefMaps from{*before.depth, *before.sigma}, to{*after.depth, *after.sigma};
  const DrawnRelief at_once = WithShift(*shown, after.panorama_size, from, to, after.backdrop,
                                        SmallChange(from, to).value());
  std::printf("asked for in %.2f ms of the caller's processor time\n", asked);
  EXPECT_LT(asked, 5);
  EXPECT_EQ(moved->texture.texels, at_once.texture.texels) << "the same bytes";
  EXPECT_EQ(moved->slopes.slopes, at_once.slopes.slopes);

  // A change of the whole map is no small one, and is not asked for again in every frame.
  ReliefWork::Source other = before;
  other.depth = std::make_shared<const DepthMap>(DepthMap(512, 384, 0.01f));
  work.FindShifted(other, before, shown);
  while (work.busy()) work.Collect();
  EXPECT_EQ(work.FindShifted(other, before, shown), nullptr);
  EXPECT_FALSE(work.busy());
}

class ReliefOfNoise : public ViewTest {};

// The picture is the same whoever made the relief; until then it shows a rough one.
TEST_F(ReliefOfNoise, MadeBesideTheWindowGivesTheSamePicture) {
  constexpr int kTexels = 512, kSize = 128;  // more than the rough relief keeps
  ReliefWork::Source source = NoisySource(kTexels, kTexels);
  source.backdrop.relight = 0.6;
  const ColourImage grey = Grey(kTexels, kTexels, 110);
  Picture picture;
  picture.field_of_view = 1.4;
  const glm::dvec3 ahead(0, 0.6, 0.8), right(1, 0, 0);
  picture.view = {{0, 0, 0.012}, ahead, glm::cross(right, ahead), right};
  picture.relief = kUsualRelief;
  const auto drawn = [&](const DrawnRelief* made) {
    view_->SetBackdrop(grey, *source.depth, source.backdrop, *source.sigma, made);
    view_->Render(picture, kSize);
    return view_->ReadPixels().rgb;
  };
  const auto at_once = drawn(nullptr);
  ReliefWork work;
  work.Find(source);
  const auto made = Await(work, source);
  ASSERT_NE(made, nullptr);
  EXPECT_EQ(drawn(made.get()), at_once);
  const DrawnRelief rough = MakeDrawnRelief(source.panorama_size, *source.depth, *source.sigma,
                                            source.backdrop, NoiseRemoval::kRough);
  EXPECT_NE(drawn(&rough), at_once);
  view_->SetDepth(*source.depth, *source.sigma, made.get());
  view_->Render(picture, kSize);
  EXPECT_EQ(view_->ReadPixels().rgb, at_once);
}

}  // namespace
}  // namespace arthro::test
