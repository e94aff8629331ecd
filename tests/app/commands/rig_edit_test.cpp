// Rigs and the instruments of a scene, without a window.
#include "app/steps/practice/rig_edit.h"

#include <chrono>
#include <thread>

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
#include "simulation/scene/json/rig_io.h"
#include "tests/support/fake_hidapi.h"
#include "tests/support/moved_rig.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

class RigEdit : public testing::Test {
 protected:
  void SetUp() override {
    StartDocument(state, authoring::OpenDocument(test::WriteSmallScene(temp / "knee", false)),
                  true);
    state.steps.practice->pace = simulation::TissuePace::kInline;
  }
  RigEditing& Editing() { return *state.steps.practice->rig; }
  void Settle() {
    const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(10);
    do {
      FinishWork(state);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ASSERT_LT(std::chrono::steady_clock::now(), limit) << "work does not end";
    } while (state.jobs.busy() || state.steps.depth->preview_jobs.busy());
  }
  test::FakeUsb usb;  // outlives the devices of `state`
  test::TempFolder temp;
  EditorState state = MakeEditorState({});
};

TEST_F(RigEdit, ARigComesBackFromItsFileAsItWasOnThePage) {
  WriteAtomically(temp / "given.json", test::kMovedRig);
  OpenRig(state, temp / "given.json");
  ASSERT_TRUE(Editing().rig.scope || Editing().rig.instrument);
  Editing().rig.title = "Room 2";
  Editing().rig.instrument = PlainRig().instrument;
  Editing().rig.instrument->mount.rod_length = 0.23;
  Editing().rig.instrument->device.serial = "B7";
  SaveRigTo(state, temp / "mine.json");
  EXPECT_FALSE(Editing().is_changed);
  const RigFile back = ReadRig(temp / "mine.json");
  EXPECT_EQ(back.title, "Room 2");
  EXPECT_EQ(back.instrument->mount.rod_length, 0.23);
  EXPECT_EQ(back.instrument->device.serial, "B7");
  EXPECT_EQ(RigText(back), RigText(Editing().rig));
}

TEST_F(RigEdit, ARigThatCannotBeReadAgainIsNotSaved) {
  app::Run(state, "new-rig");
  Editing().rig.instrument->hand_to_incision = 0.4;  // longer than the rod
  EXPECT_THROW(SaveRigTo(state, temp / "bad.json"), Error);
  EXPECT_FALSE(std::filesystem::exists(temp / "bad.json"));
  EXPECT_TRUE(Editing().is_changed);
}

TEST_F(RigEdit, OnlyASavedRigIsPutToUse) {
  app::Run(state, "new-rig");
  EXPECT_FALSE(MayUseRig(state)) << "not saved yet";
  SaveRigTo(state, temp / "mine.json");
  ASSERT_TRUE(MayUseRig(state));
  app::Run(state, "use-rig");
  EXPECT_FALSE(Editing().is_fault) << Editing().outcome;
  EXPECT_TRUE(state.steps.practice->hands->IsInRig(simulation::DeviceRole::kInstrument));
  app::Run(state, "use-no-rig");
  EXPECT_FALSE(state.steps.practice->hands->IsInRig(simulation::DeviceRole::kInstrument));
}

TEST_F(RigEdit, AFileOfTheProgramStaysAsItIs) {
  state.steps.practice->rig_preset_folder = temp.path();
  app::Run(state, "new-rig");
  EXPECT_THROW(SaveRigTo(state, temp / "shipped.json"), Error);
}

TEST_F(RigEdit, DevicesAreLookedForBesideTheWindow) {
  app::Run(state, "find-devices");
  Settle();
  EXPECT_TRUE(Editing().devices.empty());
  EXPECT_NE(Editing().outcome.find("No known device"), std::string::npos);
  usb.Plug({});
  app::Run(state, "find-devices");
  Settle();
  ASSERT_EQ(Editing().devices.size(), 1u);
  EXPECT_EQ(Editing().devices[0].device.node.serial, "A");
  EXPECT_FALSE(Editing().devices[0].sentence.empty());
}

TEST_F(RigEdit, APracticeGivesOnlyTheInstrumentsOfTheScene) {
  const auto is_enabled = [&](const char* id) { return CommandOf(state, id).enabled(state); };
  app::Run(state, "offer-punch");
  app::Run(state, "offer-grasper");
  EXPECT_EQ(state.document().scene.instruments.size(), 2u);
  app::Run(state, "practise");
  Settle();
  ASSERT_TRUE(state.practice);
  EXPECT_TRUE(is_enabled("instrument-probe"));
  EXPECT_TRUE(is_enabled("instrument-shaver"));
  EXPECT_FALSE(is_enabled("instrument-punch"));
  EXPECT_FALSE(is_enabled("instrument-grasper"));
  app::Run(state, "leave-practice");
  EXPECT_NE(state.message.find("largest force"), std::string::npos) << state.message;
  app::Run(state, "undo");
  app::Run(state, "undo");
  app::Run(state, "practise");
  Settle();
  EXPECT_TRUE(is_enabled("instrument-punch"));
}

TEST_F(RigEdit, TheLastInstrumentStays) {
  for (const char* id : {"offer-punch", "offer-grasper", "offer-shaver"}) app::Run(state, id);
  app::Run(state, "offer-probe");
  EXPECT_EQ(state.document().scene.instruments.size(), 1u);
  EXPECT_TRUE(Editing().is_fault);
}

}  // namespace
}  // namespace arthro::app
