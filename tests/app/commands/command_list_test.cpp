// The list of commands: words, keys, and what a script is told of each.
#include <set>
#include <tuple>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/steps/budget/frame_budget.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/practice/hand_motion.h"
#include "app/steps/practice/practice_step.h"
#include "app/steps/practice/rig_edit.h"
#include "app/steps/tissue/library/tissue_library.h"
#include "app/steps/tissue/tissue_step.h"
#include "tests/app/commands/command_test.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// Said what the command does, which is no reason.
TEST_F(Commands, ACommandThatCannotBeCalledByNameSaysWhy) {
  const auto why = [&](const char* id, const fs::path& file = {}) {
    return RunByName(state, id,
                     file.empty() ? CommandArguments{} : CommandArguments{file.string()});
  };
  EXPECT_NE(why("depth-map").find("the scene has no picture"), std::string::npos)
      << why("depth-map");
  Open();
  EXPECT_NE(why("head-left").find("No practice is under way."), std::string::npos);
  SetTitle(state, "another");
  EXPECT_NE(why("open", temp / "knee").find("the scene has changes that are not saved"),
            std::string::npos);
  EXPECT_NE(why("new").find("save it before you open another scene"), std::string::npos);
  state.dialogs.clear();
  app::Run(state, "save");
  ASSERT_TRUE(state.jobs.busy());
  EXPECT_NE(why("open", temp / "knee").find("put \"wait job\" on the line before"),
            std::string::npos);
  Settle(state);
  app::Run(state, "practise");
  Settle(state);
  ASSERT_TRUE(state.practice);
  EXPECT_NE(why("save").find("a practice is under way"), std::string::npos);
}

TEST_F(Commands, APageOfACommandThatIsCalledByNameIsOpened) {
  Open();
  EXPECT_EQ(RunByName(state, "touch-preview", {}), "");
  EXPECT_TRUE(TouchesRelief(state));
  EXPECT_EQ(RunByName(state, "touch-preview", {}), "");
  EXPECT_FALSE(TouchesRelief(state));
  EXPECT_EQ(RunByName(state, "library", {}), "");
  EXPECT_EQ(state.step, Step::kTissue);
  EXPECT_TRUE(state.steps.tissue->shelf->is_open);
  EXPECT_EQ(RunByName(state, "depth-scope", {}), "");
  EXPECT_EQ(state.step, Step::kDepth);
  EXPECT_EQ(RunByName(state, "budget", {}), "");
  EXPECT_EQ(state.step, Step::kPractice);
  EXPECT_TRUE(state.steps.practice->budget->is_shown);
  EXPECT_EQ(RunByName(state, "step-depth", {}), "");
  EXPECT_EQ(RunByName(state, "new-rig", {}), "");
  EXPECT_EQ(state.step, Step::kPractice);
  EXPECT_TRUE(state.steps.practice->rig->is_shown);
  EXPECT_NE(RunByName(state, "forget-lengths", {}), "") << "there are none";
}

// Work that the mouse alone could do before, by name and with arguments.
TEST_F(Commands, AScriptNamesACommandWithItsArguments) {
  Open();
  EXPECT_EQ(RunByName(state, "show-reach", {"on"}), "");
  EXPECT_EQ(state.step, Step::kPortals);
  EXPECT_TRUE(state.steps.portals->reach.is_shown);
  EXPECT_EQ(RunByName(state, "show-reach", {"off"}), "");
  EXPECT_FALSE(state.steps.portals->reach.is_shown);
  Settle(state);
  EXPECT_NE(RunByName(state, "suggest-spacing", {"hip"}).find("name some of: relief, octahedron"),
            std::string::npos);
  EXPECT_EQ(RunByName(state, "suggest-spacing", {"octahedron", "relief"}), "");
  Settle(state);
  EXPECT_NE(state.message.find("suits octahedron, relief best"), std::string::npos)
      << state.message;

  EXPECT_NE(RunByName(state, "this-is-medial", {"10", "20", "60", "20"}), "") << "no side yet";
  EXPECT_EQ(RunByName(state, "side", {"left"}), "");
  EXPECT_EQ(state.document().scene.side, BodySide::kLeft);
  EXPECT_EQ(RunByName(state, "this-is-medial", {"10", "20", "60", "20"}), "");
  EXPECT_EQ(RunByName(state, "this-is-up", {"10", "60", "10", "20"}), "");
  const double radius = state.document().scene.backdrop.radius;
  EXPECT_EQ(RunByName(state, "known-length", {"12", "100", "100", "180", "120"}), "");
  EXPECT_NE(state.document().scene.backdrop.radius, radius);
  Settle(state);
  EXPECT_EQ(RunByName(state, "crop", {"20", "30", "219", "179"}), "");
  EXPECT_EQ(state.document().panorama->width, 200);
  EXPECT_EQ(state.document().panorama->height, 150);
  Settle(state);
  EXPECT_NE(RunByName(state, "crop", {"20", "30", "x", "179"}).find("\"x\" is not a number"),
            std::string::npos);
  EXPECT_NE(RunByName(state, "crop", {"20", "30"}).find("2 numbers are given"), std::string::npos);
  EXPECT_TRUE(state.dialogs.empty());
  EXPECT_NE(RunByName(state, "undo", {"a", "b"}), "") << "it takes none";
  EXPECT_NE(RunByName(state, "mask", {"1", "1", "20", "20"}), "") << "no footage";
  EXPECT_EQ(RunByName(state, "keep-snapshot", {"before the tear"}), "");
  Settle(state);
  EXPECT_NE(state.message.find("before the tear"), std::string::npos) << state.message;
}

// The manual said LEFT TOP RIGHT BOTTOM, and the refusal FROM_X FROM_Y TO_X TO_Y.
TEST_F(Commands, ARefusalNamesTheFormThatTheManualNames) {
  int numbers = 0;
  for (const char* id : {"crop", "known-length", "this-is-up", "this-is-medial", "tie", "mask"})
    for (const Command& command : AllCommands())
      if (command.id == std::string_view(id)) {
        ++numbers;
        try {
          command.run_with(state, {"wide"});
          ADD_FAILURE() << id << " takes a word";
        } catch (const Error& refused) {
          EXPECT_NE(std::string(refused.what()).find(std::string("; write ") + command.arguments),
                    std::string::npos)
              << id << ": " << refused.what();
        }
      }
  EXPECT_EQ(numbers, 6);
}

TEST_F(Commands, ACommandWithArgumentsIsRecordedInPlaceOfTheClickOnItsItem) {
  Open();
  state.record.is_on = true;
  app::Run(state, "suggest-spacing", {"relief", "my tissue"});
  app::Run(state, "side", {"right"}, "Side of the knee");
  EXPECT_EQ(state.record.pending,
            (std::vector<std::string>{"do suggest-spacing relief \"my tissue\"", "do side right"}));
  EXPECT_EQ(state.record.command_words,
            (std::vector<std::string>{"Suggest spacing", "Side of the knee"}));
}

// A grey button that does not say why is a dead end.
TEST_F(Commands, ACommandThatIsGreySaysWhyInASentence) {
  const auto expect_reasons = [&](const std::string& when) {
    for (const Command& command : AllCommands()) {
      const std::string why = WhyDisabled(state, command);
      EXPECT_EQ(why.empty(), command.enabled(state)) << command.id << " " << when;
      EXPECT_TRUE(why.empty() || why.ends_with('.')) << command.id << ": " << why;
    }
  };
  const auto why = [&](const char* id) {
    return std::string(WhyDisabled(state, CommandOf(state, id)));
  };
  expect_reasons("without a scene");
  EXPECT_EQ(why("depth-map"), "First begin a scene from footage or from a picture.");
  Open();
  expect_reasons("with a scene");
  EXPECT_EQ(why("undo"), "There is nothing to undo.");
  app::Run(state, "practise");
  ASSERT_TRUE(state.jobs.busy());
  expect_reasons("during work");
  EXPECT_EQ(why("save"), "Wait until the work that is under way has ended, or stop it.");
  Settle(state);
  expect_reasons("in practice");
  EXPECT_EQ(why("save"), "First leave the practice.");
}

TEST(CommandList, EveryCommandHasItsOwnIdWordsAndHelp) {
  const EditorState state = MakeEditorState(NewDocument());
  std::set<std::string> ids;
  for (const Command& command : AllCommands()) {
    EXPECT_TRUE(ids.insert(command.id).second) << command.id;
    EXPECT_STRNE(command.words, "");
    EXPECT_STREQ(std::string(command.help).substr(std::string(command.help).size() - 1).c_str(),
                 ".")
        << command.id << ": the help is a sentence";
    EXPECT_EQ(&CommandOf(state, command.id), &command);
  }
}

// Held keys count with Shift too, and not with Ctrl.
TEST(CommandList, NoTwoCommandsOrHeldKeysShareAKey) {
  std::set<std::tuple<int, bool, bool>> called;
  std::set<int> bare;
  for (const Command& command : AllCommands())
    for (const Shortcut& shortcut : {command.shortcut, command.other_shortcut}) {
      if (shortcut.key == 0) continue;
      EXPECT_TRUE(called.insert({shortcut.key, shortcut.ctrl, shortcut.shift}).second)
          << command.id << ": " << WordsOf(shortcut);
      if (!shortcut.ctrl) bare.insert(shortcut.key);
    }
  std::vector<std::pair<std::string, int>> held{{"jaws", kActKey}, {"dead-man", kDeadManKey}};
  for (const HandMotion& motion : HandMotions()) held.emplace_back(motion.words, motion.key);
  std::set<int> keys;
  for (const auto& [words, key] : held) {
    EXPECT_TRUE(keys.insert(key).second) << words;
    EXPECT_EQ(bare.count(key), 0u) << words;
  }
  EXPECT_EQ(kActKey, GLFW_KEY_C);
  EXPECT_EQ(kDeadManKey, GLFW_KEY_V);
}

}  // namespace
}  // namespace arthro::app
