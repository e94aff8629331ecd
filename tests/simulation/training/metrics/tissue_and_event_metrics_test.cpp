// Metrics of tissue and counts of events, from frames that are made up, against numbers that follow
// by hand.
#include <gtest/gtest.h>

#include "tests/simulation/training/metrics/measured_value.h"

namespace arthro::simulation {
namespace {

using test::IsMissingIn;
using test::MeasuredAttempt;
using test::ValueIn;

// Touches a line of 4 mm along x with a tool: dabs of 0.5 mm, five frames in each, at the height y.
void TouchLine(std::vector<AttemptFrame>& frames, DeviceRole role, double y, float force) {
  for (int k = 0; k < 40; ++k) {
    AttemptFrame frame = test::QuietFrame();
    ToolFrame& tool = frame.tool[Index(role)];
    tool.drawn_tip = glm::vec3(5e-5 + 1e-4 * k, y, 0.02025);
    tool.peak_force = tool.mean_force = force;
    tool.contact = kBackdropContact;
    tool.contact_share = 1;
    frames.push_back(frame);
  }
}

// A rectangle of 4 mm × 3 mm, in rows 0.25 mm apart, is covered by its 8 × 6 dabs, 12 mm² in all.
TEST(TissueMetrics, MarkedAreaOfASweptRectangle) {
  const Exercise exercise = test::ExerciseOf({});
  std::vector<AttemptFrame> frames;
  for (int row = 0; row < 12; ++row)
    TouchLine(frames, DeviceRole::kInstrument, 2.5e-4 * row + 1.25e-4, 9.0F);
  const double rectangle = 0.004 * 0.003;
  EXPECT_NEAR(ValueIn(MeasuredAttempt(exercise, frames), "marked_area", "both"), rectangle, 1e-12);
  // Places that are touched again, and those touched with the safe force of 8.5 N, add nothing.
  TouchLine(frames, DeviceRole::kScope, 1.25e-4, 20.0F);
  TouchLine(frames, DeviceRole::kInstrument, 0.0101, 8.5F);
  // Neither do places without a contact, without a known hand or in a pause.
  const auto leave_out = [&](double y, const auto& change) {
    const std::size_t begin = frames.size();
    TouchLine(frames, DeviceRole::kInstrument, y, 20.0F);
    for (std::size_t k = begin; k < frames.size(); ++k) change(frames[k]);
  };
  leave_out(0.0201, [](AttemptFrame& frame) { frame.tool[1].contact = kNoContact; });
  leave_out(0.0301, [](AttemptFrame& frame) { frame.tool[1].is_valid = false; });
  leave_out(0.0401, [](AttemptFrame& frame) { frame.is_paused = true; });
  EXPECT_NEAR(ValueIn(MeasuredAttempt(exercise, frames), "marked_area", "both"), rectangle, 1e-12);
  // Dabs of both tools are added: a further line has 4 mm × 0.5 mm.
  TouchLine(frames, DeviceRole::kScope, 0.0501, 8.6F);
  EXPECT_NEAR(ValueIn(MeasuredAttempt(exercise, frames), "marked_area", "both"),
              rectangle + 0.004 * 0.0005, 1e-12);
}

// Two targets with regions, and a ball without any.
Exercise TrimOfTwoRegions() {
  Exercise exercise = test::ExerciseOf({}, 3);
  for (std::size_t i : {0U, 1U}) {
    exercise.targets[i].ball.reset();
    exercise.targets[i].regions = {"flap"};
  }
  return exercise;
}

TEST(TissueMetrics, TakenShareIsTheLeastOfTheTargetsAtTheEnd) {
  std::vector<AttemptFrame> frames(20, test::QuietFrame(3));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    frames[k].sight.target[0].taken_share = k < 10 ? 0.25F : 0.5F;
    frames[k].sight.target[1].taken_share = 0.75F;
  }
  EXPECT_EQ(ValueIn(MeasuredAttempt(TrimOfTwoRegions(), frames), "taken_share", "instrument"), 0.5);
  const auto none = MeasuredAttempt(test::ExerciseOf({}, 3), frames);
  EXPECT_TRUE(IsMissingIn(none, "taken_share", "instrument"));
}

TEST(TissueMetrics, VolumeOutsideIsTheSumOverTheFrames) {
  std::vector<AttemptFrame> frames(100, test::QuietFrame(3));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    frames[k].taken = 3e-9F;
    frames[k].taken_outside = k % 4 == 0 ? 2e-9F : 0.0F;
  }
  const auto values = MeasuredAttempt(TrimOfTwoRegions(), frames);
  EXPECT_NEAR(ValueIn(values, "taken_outside", "instrument"), 25 * 2e-9, 1e-14);
}

TEST(TissueMetrics, RimAndContourAreThoseOfTheCutFacesAtTheEnd) {
  std::vector<AttemptFrame> frames(3, test::QuietFrame(3));
  const auto uncut = MeasuredAttempt(TrimOfTwoRegions(), frames);
  EXPECT_TRUE(IsMissingIn(uncut, "rim_min", "instrument"));
  EXPECT_TRUE(IsMissingIn(uncut, "contour_rms", "instrument"));
  frames[1].rim = 0.25F;
  frames[1].contour = 0.5F;
  frames[2].rim = 0.0F;
  frames[2].contour = 0.125F;
  const auto values = MeasuredAttempt(TrimOfTwoRegions(), frames);
  EXPECT_EQ(ValueIn(values, "rim_min", "instrument"), 0) << "cut down to the wall";
  EXPECT_EQ(ValueIn(values, "contour_rms", "instrument"), 0.125);
}

// Frames of a punch or a shaver.
AttemptFrame CutFrame(ToolKind kind, float opening, float taken, float outside = 0) {
  AttemptFrame frame = test::QuietFrame();
  frame.instrument = kind;
  frame.opening = opening;
  frame.taken = taken;
  frame.taken_outside = outside;
  return frame;
}

TEST(TissueMetrics, BitesOfAPunch) {
  const AttemptFrame open = CutFrame(ToolKind::kPunch, 1, 0);
  const auto bite = [&](std::vector<AttemptFrame>& frames, float taken, float outside) {
    test::Append(frames, 1, CutFrame(ToolKind::kPunch, 0.2F, taken, outside));
    test::Append(frames, 5, CutFrame(ToolKind::kPunch, 0, 0));
    test::Append(frames, 20, open);
  };
  std::vector<AttemptFrame> frames(10, open);
  for (int i = 0; i < 4; ++i) bite(frames, 2e-9F, 0);
  for (int i = 0; i < 3; ++i) bite(frames, 0, 0);
  for (int i = 0; i < 2; ++i) bite(frames, 2e-9F, 1e-9F);
  test::Append(frames, 20, CutFrame(ToolKind::kPunch, 0.3F, 0));  // not closed
  test::Append(frames, 20, CutFrame(ToolKind::kProbe, 0, 0));     // no jaws
  const auto values = MeasuredAttempt(TrimOfTwoRegions(), frames);
  EXPECT_EQ(ValueIn(values, "bites", "instrument"), 6);
  EXPECT_EQ(ValueIn(values, "empty_bites", "instrument"), 3);
  EXPECT_EQ(ValueIn(values, "bites_outside", "instrument"), 2);
}

// A pass of a shaver goes on over 10 frames in which nothing is taken, and ends with the eleventh.
TEST(TissueMetrics, PassesOfAShaverArePartedByATenthOfASecond) {
  const AttemptFrame taking = CutFrame(ToolKind::kShaver, 1, 1e-10F),
                     quiet = CutFrame(ToolKind::kShaver, 1, 0);
  std::vector<AttemptFrame> frames;
  for (const int gap : {10, 11, 10, 20}) {
    test::Append(frames, 30, taking);
    test::Append(frames, gap, quiet);
  }
  const auto values = MeasuredAttempt(TrimOfTwoRegions(), frames);
  EXPECT_EQ(ValueIn(values, "bites", "instrument"), 2);
  EXPECT_EQ(ValueIn(values, "empty_bites", "instrument"), 0);
  EXPECT_EQ(ValueIn(values, "bites_outside", "instrument"), 0);
}

// An attempt that ends within a bite has that bite, as it has its volume.
TEST(TissueMetrics, TheBiteInWhichAnAttemptEndsCounts) {
  std::vector<AttemptFrame> frames(10, CutFrame(ToolKind::kPunch, 1, 0));
  test::Append(frames, 1, CutFrame(ToolKind::kPunch, 0, 2e-9F, 1e-9F));
  const auto stopped = MeasuredAttempt(TrimOfTwoRegions(), frames);
  frames.back().tool[1].is_valid = true;
  frames.back().tool[1].peak_force = 20;
  Exercise limited = TrimOfTwoRegions();
  limited.limits.force = 15;
  for (const auto& values : {stopped, MeasuredAttempt(limited, frames)}) {
    EXPECT_EQ(ValueIn(values, "bites", "instrument"), 1);
    EXPECT_EQ(ValueIn(values, "bites_outside", "instrument"), 1);
    EXPECT_NEAR(ValueIn(values, "taken_outside", "instrument"), 1e-9, 1e-16);
  }
}

// A body is let go three times on its way, and then in its goal.
TEST(EventMetrics, DropsAreThoseBesideTheGoal) {
  TransferStep step;
  step.bodies = {"t0"};
  step.to = "t1";
  Exercise exercise = test::ExerciseOf({step}, 2);
  exercise.targets[0].is_loose = true;
  std::vector<AttemptFrame> frames;
  for (const float x : {0.002F, 0.004F, 0.007F, 0.0095F})
    for (const float opening : {0.0F, 1.0F}) {
      AttemptFrame frame = test::QuietFrame(2);
      frame.instrument = ToolKind::kGrasper;
      frame.opening = opening;
      frame.sight.target[0].place.x = x;
      frame.tool[1].drawn_tip = frame.sight.target[0].place;
      test::Append(frames, 10, frame);
    }
  const auto values = MeasuredAttempt(exercise, frames);
  EXPECT_EQ(ValueIn(values, "drops", "instrument"), 3);
}

// Two zones of 2 mm. An absence of 10 frames is forgiven, and a touch with too little force is
// none.
TEST(EventMetrics, ZoneEntriesAreThoseOfBothTools) {
  Exercise exercise = test::ExerciseOf({}, 2);
  exercise.avoid = {{"t0", AvoidBy::kBoth, 0}, {"t1", AvoidBy::kInstrument, 2}};
  const auto touch = [](DeviceRole role, int target, float force) {
    AttemptFrame frame = test::QuietFrame(2);
    ToolFrame& tool = frame.tool[Index(role)];
    tool.drawn_tip = frame.sight.target[static_cast<std::size_t>(target)].place;
    tool.peak_force = force;
    return frame;
  };
  const AttemptFrame away = test::QuietFrame(2);
  std::vector<AttemptFrame> frames;
  const auto enter = [&](DeviceRole role, int target, float force, int gap) {
    test::Append(frames, 15, touch(role, target, force));
    test::Append(frames, gap, away);
  };
  enter(DeviceRole::kInstrument, 0, 0, 10);
  enter(DeviceRole::kInstrument, 0, 0, 11);  // forgiven: the same entry
  enter(DeviceRole::kInstrument, 0, 0, 20);
  enter(DeviceRole::kScope, 0, 0, 20);
  enter(DeviceRole::kInstrument, 1, 1.5F, 20);  // less than 2 N
  enter(DeviceRole::kInstrument, 1, 2.5F, 20);
  enter(DeviceRole::kScope, 1, 2.5F, 20);  // free for the scope
  const auto values = MeasuredAttempt(exercise, frames);
  EXPECT_EQ(ValueIn(values, "zone_entries", "both"), 4);
}

// No frames: counts are 0 and shares are missing.
TEST(EventMetrics, AnAttemptWithoutFramesHasNoEvents) {
  const auto values = MeasuredAttempt(TrimOfTwoRegions(), {});
  for (const char* id : {"taken_outside", "bites", "empty_bites", "bites_outside", "drops"})
    EXPECT_EQ(ValueIn(values, id, "instrument"), 0) << id;
  for (const char* id : {"look_downs", "zone_entries", "marked_area"})
    EXPECT_EQ(ValueIn(values, id, "both"), 0) << id;
  for (const char* id : {"taken_share", "rim_min", "contour_rms", "band_share", "measure_error",
                         "probed_share", "path_efficiency", "tool_loss", "triangulation"})
    EXPECT_TRUE(IsMissingIn(values, id, "instrument")) << id;
  for (const char* id : {"seen_share", "centring", "distance_error", "horizon", "disturbed_share"})
    EXPECT_TRUE(IsMissingIn(values, id, "scope")) << id;
  for (const char* id : {"track_error", "line_error", "lens_near"})
    EXPECT_TRUE(IsMissingIn(values, id, "both")) << id;
}

}  // namespace
}  // namespace arthro::simulation
