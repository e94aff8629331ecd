// An incision that is calibrated in the window's own way (app/steps/practice), without a window:
// by commands, on simulated and recorded hands, on a rig whose file keeps it.
#include "app/steps/practice/calibrate_incision.h"

#include <cmath>
#include <fstream>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/editor/every_step.h"
#include "app/files/scene_files.h"
#include "app/state/command.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/panorama/panorama_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/practice/practice_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/json/rig_io.h"
#include "tests/app/commands/settle.h"
#include "tests/support/fake_hidapi.h"
#include "tests/support/moved_rig.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using simulation::DeviceRole;
using simulation::PivotStatus;

class CalibrateIncision : public testing::Test {
 protected:
  void SetUp() override {
    StartDocument(state, authoring::OpenDocument(test::WriteSmallScene(temp / "knee", false)),
                  true);
    state.steps.practice->pace = simulation::TissuePace::kInline;
    rig = temp / "rig.json";
    WriteAtomically(rig, test::kMovedRig);
  }
  void Hold(simulation::HandsChoice choice) {
    state.steps.practice->hands = std::make_unique<simulation::Hands>(std::move(choice));
  }
  void Frame() {
    FinishWork(state);
    state.steps.practice->hands->Look();
    if (state.practice && state.dialogs.empty())
      state.practice->Advance(1.0 / 60, state.steps.practice->hands.get());
    KeepPivotFresh(state);
  }
  void Frames(int count) {
    for (int i = 0; i < count; ++i) Frame();
  }
  // Until all work is done.
  void Settle() {
    SettleBy(state, [this] { Frame(); });
  }
  void Begin(const char* command = "calibrate-scope") {
    app::Run(state, command);
    Settle();
    ASSERT_TRUE(state.steps.practice->calibrating) << "in a practice that is begun for it";
  }
  // Swings the scope there within half a second, lets it rest, presses.
  void PressAt(double latitude_deg, double longitude_deg) {
    const simulation::RodPose from = state.practice->scope().pose();
    for (int i = 1; i <= 30; ++i) {
      simulation::RodPose pose = from;
      pose.latitude += (RadiansFromDegrees(latitude_deg) - from.latitude) * i / 30;
      pose.longitude += (RadiansFromDegrees(longitude_deg) - from.longitude) * i / 30;
      state.practice->scope().Set(pose);
      Frame();
    }
    Frames(60);
    app::Run(state, "press-incision");
    Frames(10);
  }
  const simulation::PivotWork& work() const { return state.steps.practice->calibrating->work; }
  DeviceRig Mount() const {
    return state.steps.practice->hands->MountOf(DeviceRole::kScope, state.document().scene);
  }

  test::FakeUsb usb;  // nothing is plugged in
  test::TempFolder temp;
  fs::path rig;
  EditorState state = MakeEditorState(NewDocument());
};

TEST_F(CalibrateIncision, TwoPressesOfASimulatedHandAreUsedAndSavedInTheRigTheyCameFrom) {
  Hold(simulation::ReadHands(rig, "plant"));
  EXPECT_EQ(state.steps.practice->hands->KindOf(DeviceRole::kScope),
            simulation::HandKind::kSimulated);
  Begin();
  EXPECT_FALSE(CommandOf(state, "use-incision").enabled(state));
  PressAt(0, 0);
  EXPECT_EQ(work().poses().size(), 1u) << work().refusal();
  PressAt(10, 35);
  ASSERT_EQ(work().poses().size(), 2u) << work().refusal();
  ASSERT_EQ(work().found().status, PivotStatus::kOk) << work().found().reason;
  const double sigma = work().found().sigma;
  EXPECT_LT(sigma, 0.1e-3);
  EXPECT_LT(glm::distance(*work().found().pivot, test::kMovedPivot), 3 * sigma);
  app::Run(state, "use-incision");
  EXPECT_TRUE(state.dialogs.empty());
  EXPECT_NE(state.steps.practice->calibrating->outcome.find("saved in " + rig.string()),
            std::string::npos);
  Frames(2);
  EXPECT_EQ(Mount().pivot, *work().found().pivot);
  EXPECT_NE(Mount().pivot, test::kMovedPivot) << "what was found, not what was there";
  // Read again by whoever comes next.
  const RigFile saved = ReadRig(rig);
  EXPECT_EQ(saved.scope->mount, Mount());
  EXPECT_NE(ReadWholeFile(rig).find("x-room"), std::string::npos);
  Scene next;
  simulation::Hands(simulation::ReadHands(rig, "plant")).Mount(next);
  EXPECT_EQ(next.rig.scope.pivot, Mount().pivot);

  app::Run(state, "leave-practice");
  EXPECT_FALSE(state.steps.practice->calibrating) << "Esc closes the calibration first";
  EXPECT_FALSE(state.steps.practice->hands->calibrated());
  EXPECT_TRUE(state.practice);
}

TEST_F(CalibrateIncision, WhatIsTooNarrowIsRefusedInWordsAndNothingChanges) {
  Hold(simulation::ReadHands(rig, "plant"));
  Begin();
  PressAt(0, 0);
  PressAt(0, 4);
  ASSERT_EQ(work().poses().size(), 2u) << work().refusal();
  EXPECT_EQ(work().found().status, PivotStatus::kTooNarrow);
  EXPECT_NE(work().found().reason.find("degrees"), std::string::npos);
  EXPECT_FALSE(CommandOf(state, "use-incision").enabled(state));
  app::Run(state, "use-incision");
  EXPECT_EQ(Mount().pivot, test::kMovedPivot);
  EXPECT_EQ(ReadWholeFile(rig), test::kMovedRig);
}

TEST_F(CalibrateIncision, WhatCannotBeSavedIsUsedAllTheSameAndNothingIsOverwritten) {
  Hold(simulation::ReadHands(rig, "plant"));
  state.steps.practice->rig_preset_folder =
      temp.path();  // the rig now counts as shipped with the program
  Begin();
  PressAt(0, 0);
  PressAt(0, 40);
  ASSERT_TRUE(work().MayBeUsed()) << work().found().reason;
  app::Run(state, "use-incision");
  EXPECT_TRUE(state.steps.practice->calibrating->is_unsaved);
  EXPECT_NE(state.steps.practice->calibrating->outcome.find("came with the program"),
            std::string::npos)
      << state.steps.practice->calibrating->outcome;
  EXPECT_EQ(Mount().pivot, *work().found().pivot);
  EXPECT_EQ(ReadWholeFile(rig), test::kMovedRig);

  // Elsewhere, by the browser: first where there is no folder, then where there is one.
  const auto save = [&](const fs::path& file) {
    app::Run(state, "save-rig-as");
    const auto browse = std::get<BrowseDialog>(std::move(state.dialogs.back()));
    state.dialogs.pop_back();
    Guarded(state, "Save", [&] { browse.then(state, file); });
  };
  save(temp / "nowhere" / "mine.json");
  ASSERT_EQ(state.dialogs.size(), 1u) << "in a sentence";
  state.dialogs.clear();
  EXPECT_TRUE(state.steps.practice->calibrating->is_unsaved);
  fs::create_directory(temp / "own");
  save(temp / "own" / "mine.json");
  EXPECT_TRUE(state.dialogs.empty());
  EXPECT_FALSE(state.steps.practice->calibrating->is_unsaved);
  EXPECT_EQ(ReadRig(temp / "own" / "mine.json").scope->mount.pivot, Mount().pivot);
  EXPECT_EQ(ReadWholeFile(rig), test::kMovedRig);
}

TEST_F(CalibrateIncision, OfAHandWithoutARigLastsUntilTheProgramEnds) {
  Hold(simulation::ReadHands({}, "plant"));
  Begin();
  PressAt(0, 0);
  PressAt(0, 40);
  ASSERT_TRUE(work().MayBeUsed()) << work().found().reason;
  app::Run(state, "use-incision");
  EXPECT_NE(state.steps.practice->calibrating->outcome.find("until the program ends"),
            std::string::npos);
  EXPECT_FALSE(CommandOf(state, "save-rig-as").enabled(state));
  EXPECT_EQ(Mount().pivot, *work().found().pivot);
  // Also of the practice after this one.
  app::Run(state, "leave-practice");
  app::Run(state, "leave-practice");
  EXPECT_FALSE(state.practice);
  Scene scene = state.document().scene;
  state.steps.practice->hands->Mount(scene);
  EXPECT_EQ(scene.rig.scope.pivot, Mount().pivot);
}

// The recorded hand's incision is 30 mm beside the one that the rig names.
TEST_F(CalibrateIncision, ARecordedHandThatKeepsSwingingMendsAWrongRig) {
  simulation::HandsChoice choice = simulation::ReadHands(rig, "");
  DeviceRig truth = choice.rig->scope->mount;
  truth.pivot += glm::dvec3(0.03, 0, 0.01);
  for (int i = 0; i < 9000; ++i) {
    const double t = 1e-3 * i;
    const simulation::RodPose pose{0.35 * std::sin(2.1 * t), 0.35 * std::sin(1.3 * t), 0, 0.06};
    simulation::TraceRow& row = choice.trace.emplace_back();
    row.sample = {t, simulation::HipFromRodPose(pose, truth),
                  simulation::HandleFromRodPose(pose, truth), 0, true};
  }
  Hold(std::move(choice));
  EXPECT_EQ(state.steps.practice->hands->KindOf(DeviceRole::kScope),
            simulation::HandKind::kRecorded);
  EXPECT_FALSE(CommandOf(state, "calibrate-instrument").enabled(state)) << "mouse and keys have it";
  Begin();
  state.steps.practice->calibrating->work.Begin(simulation::PivotSource::kSwing);
  const auto off = [&] { return glm::distance(state.practice->snapshot().scope.pose.depth, 0.06); };
  Frames(60);
  EXPECT_GT(off(), 1e-3) << "the rig is wrong";
  Frames(180);
  Settle();
  ASSERT_EQ(work().found().status, PivotStatus::kOk) << work().found().reason;
  EXPECT_GT(work().poses().size(), 100u);
  EXPECT_LT(glm::distance(*work().found().pivot, truth.pivot), 3 * work().found().sigma);
  // The swing goes on in these frames, and a later fit may find another pivot than the one in use.
  const glm::dvec3 used = *work().found().pivot;
  app::Run(state, "use-incision");
  Frames(3);
  EXPECT_LT(off(), 3 * work().found().sigma) << "the practice goes on with it";
  EXPECT_EQ(Mount().pivot, used);
  EXPECT_EQ(ReadRig(rig).scope->mount.pivot, used);
}

TEST_F(CalibrateIncision, OfADeviceWithoutARodIsNotOffered) {
  simulation::HandsChoice choice;
  choice.rig.emplace().scope.emplace().device.family = "space_mouse";
  Hold(std::move(choice));
  EXPECT_FALSE(CommandOf(state, "calibrate-scope").enabled(state));
  EXPECT_NE(state.steps.practice->hands->WhyNotCalibrated(DeviceRole::kScope).find("no rod"),
            std::string::npos);
  EXPECT_NE(state.steps.practice->hands->WhyNotCalibrated(DeviceRole::kInstrument).find("Mouse"),
            std::string::npos);
}

}  // namespace
}  // namespace arthro::app
