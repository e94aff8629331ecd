// Scripts that drive the window (app/platform/script/script.h, script_runner.h).
#include "app/platform/script/script.h"

#include <algorithm>
#include <map>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/platform/script/crawler.h"
#include "app/platform/script/script_runner.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

TEST(Script, QuotedNamesCommentsAndNumbersAreRead) {
  const auto lines =
      ParseScript("# a comment\n\nclick \"Save as\"\ndrag Red 40 -2.5 right # more\n");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].number, 3);
  EXPECT_EQ(lines[0].name, "Save as");
  EXPECT_EQ(lines[1].verb, ScriptVerb::kDrag);
  EXPECT_DOUBLE_EQ(lines[1].x, 40);
  EXPECT_DOUBLE_EQ(lines[1].y, -2.5);
  EXPECT_TRUE(lines[1].right_button);
}

TEST(Script, AMistakeIsToldWithItsLine) {
  for (const char* text : {"quit\nfly away", "quit\nclick", "quit\nclick \"open",
                           "quit\ndrag A x 2", "quit\nkey hyper+q", "quit\nexpect maybe X"}) {
    try {
      ParseScript(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what())
                    .find(text == std::string("quit\nkey hyper+q") ? "hyper" : "line 2"),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(Script, NamesOfDataThatNeedNoTranslationAreRead) {
  const auto lines = ParseScript("expect translated\nexpect translated \"my knee\" probe\n");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].verb, ScriptVerb::kExpectTranslated);
  EXPECT_EQ(lines[1].text, "my knee\nprobe\n");
}

TEST(Script, AWordThatIsWrittenIsReadAgain) {
  for (const std::string word : {"Save", "Save as…", "a \"b\" \\ c", "x#2", "", " "}) {
    const auto lines = ParseScript("set Title " + ScriptWord(word));
    ASSERT_EQ(lines.size(), 1u) << word;
    EXPECT_EQ(lines[0].text, word);
  }
}

TEST(Script, StrokesPosesAndCommandsAreRead) {
  const auto lines = ParseScript(
      "stroke Overview right ctrl 1 2 -3.5 4\npose scope 0.02 0.1 0 -1e-3\n"
      "do save-as \"my knee\"\nchoose a.png\nwheel Overview 2 10 -4 shift");
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0].numbers, (std::vector<double>{1, 2, -3.5, 4}));
  EXPECT_EQ(lines[0].button, 1);
  EXPECT_TRUE(lines[0].ctrl && !lines[0].shift);
  EXPECT_EQ(lines[1].numbers, (std::vector<double>{0.02, 0.1, 0, -1e-3}));
  EXPECT_EQ(lines[2].name, "save-as");
  EXPECT_EQ(lines[2].arguments, std::vector<std::string>{"my knee"});
  EXPECT_EQ(lines[3].text, "a.png");
  EXPECT_TRUE(lines[4].shift);
  for (const char* wrong : {"stroke A", "stroke A 1", "stroke A 1 x", "pose hand 1 2 3 4",
                            "pose scope 1 2 3", "do", "wheel A 1 2"})
    EXPECT_THROW(ParseScript(wrong), Error) << wrong;
}

TEST(Script, KeysAreGlfwCodesModifiersFirst) {
  EXPECT_EQ(KeysFromWords("ctrl+shift+z"),
            (std::vector<int>{GLFW_KEY_LEFT_CONTROL, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_Z}));
  EXPECT_EQ(KeysFromWords("f5"), (std::vector<int>{GLFW_KEY_F5}));
}

class RunScript : public testing::Test {
 protected:
  // Runs until it ends; every event is taken as if a frame had seen it.
  ScriptState Run(const std::string& text) {
    ScriptRunner runner(ParseScript(text));
    for (int frame = 0; frame < 1000 && runner.state() == ScriptState::kRunning; ++frame) {
      runner.AfterFrame(widgets, busy, input,
                        [&](const auto& file, bool) { shots.push_back(file); });
      for (const auto& event : input.TakeFrame()) events.push_back(event);
      if (frame == 500) busy = false;
    }
    failure = runner.failure();
    return runner.state();
  }
  WidgetRegistry widgets;
  InputQueue input;
  std::vector<InputEvent> events;
  std::vector<std::filesystem::path> shots;
  std::string failure;
  bool busy = false;
};

TEST_F(RunScript, ClickPointsAtTheMiddleOfTheItem) {
  widgets.Record({"Save", 10, 20, 30, 40, true});
  EXPECT_EQ(Run("click Save"), ScriptState::kFinished);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_DOUBLE_EQ(std::get<PointerMoved>(events[0]).x, 20);
  EXPECT_DOUBLE_EQ(std::get<PointerMoved>(events[0]).y, 30);
}

TEST_F(RunScript, AnItemThatIsNotThereFailsAndSaysWhatIs) {
  widgets.Record({"Save", 10, 20, 30, 40, true});
  EXPECT_EQ(Run("quit\n"), ScriptState::kFinished);
  EXPECT_EQ(Run("click Load"), ScriptState::kFailed);
  EXPECT_NE(failure.find("line 1"), std::string::npos) << failure;
  EXPECT_NE(failure.find("Save"), std::string::npos) << failure;
}

TEST_F(RunScript, AnItemOutOfSightCannotBeClicked) {
  widgets.Record({"Save", 10, 20, 30, 40, false});
  EXPECT_EQ(Run("click Save"), ScriptState::kFailed);
}

TEST_F(RunScript, OneOfSeveralItemsOfANameIsNumbered) {
  widgets.Record({"Remove", 0, 0, 10, 10, true});
  widgets.Record({"Remove", 0, 20, 10, 30, true});
  widgets.Record({"Remove", 0, 40, 10, 50, true});
  EXPECT_EQ(widgets.NameOf(widgets.widgets()[1]), "Remove#2");
  EXPECT_EQ(widgets.NameOf(widgets.widgets()[2]), "Remove");
  EXPECT_EQ(Run("click Remove#2"), ScriptState::kFinished);
  EXPECT_DOUBLE_EQ(std::get<PointerMoved>(events[0]).y, 25);
}

TEST_F(RunScript, AStrokeGivesOnePointPerFrame) {
  widgets.Record({"Overview", 0, 0, 100, 100, true});
  ScriptRunner runner(ParseScript("stroke Overview 0 0 5 6 7 8"));
  int frames_with_moves = 0;
  for (int frame = 0; frame < 100 && runner.state() == ScriptState::kRunning; ++frame) {
    runner.AfterFrame(widgets, false, input, {});
    int moves = 0;
    for (const auto& event : input.TakeFrame()) moves += event.index() == 0 ? 1 : 0;
    EXPECT_LE(moves, 1);
    frames_with_moves += moves;
  }
  EXPECT_EQ(frames_with_moves, 3);
}

TEST_F(RunScript, CommandsAreHandedToTheWindow) {
  ScriptRunner runner(ParseScript("do crop 1 2 30 40"));
  std::string done;
  runner.SetActions({[&](const auto& id, const auto& arguments) {
                       done = id;
                       for (const std::string& argument : arguments) done += " " + argument;
                       return std::string();
                     },
                     {},
                     {}});
  for (int frame = 0; frame < 20 && runner.state() == ScriptState::kRunning; ++frame)
    runner.AfterFrame(widgets, false, input, {});
  EXPECT_EQ(runner.state(), ScriptState::kFinished);
  EXPECT_EQ(done, "crop 1 2 30 40");
}

TEST_F(RunScript, ControlsThatAreCutOffOrLieOverEachOtherFail) {
  EXPECT_EQ(Run("expect layout"), ScriptState::kFailed) << "there are none";
  widgets.Record({"Left", 10, 10, 60, 30, true});
  widgets.Record({"Right", 61, 10, 100, 30, true});
  widgets.Record({"Picture", 0, 0, 200, 200, true, true, "", WidgetKind::kPicture});
  EXPECT_EQ(Run("expect layout"), ScriptState::kFinished);
  widgets.Record({"Below", 10, 25, 100, 50, true});
  EXPECT_EQ(Run("expect layout"), ScriptState::kFailed);
  widgets.BeginFrame();
  widgets.Record({"Wide", 10, 10, 60, 30, true});
  EXPECT_EQ(Run("expect layout"), ScriptState::kFinished);
  WidgetRecord cut{"Cut", 10, 40, 60, 60, true};
  cut.is_cut = true;
  widgets.Record(cut);
  EXPECT_EQ(Run("expect layout"), ScriptState::kFailed);
}

TEST_F(RunScript, ExpectationsThatDoNotHoldFail) {
  widgets.Record({"Spacing", 10, 20, 30, 40, true, false, "30.0 mm"});
  widgets.RecordText("All is well");
  EXPECT_EQ(Run("expect \"is well\"\nexpect not fire\nexpect value Spacing \"30.0 mm\"\n"
                "expect disabled Spacing"),
            ScriptState::kFinished)
      << failure;
  for (const char* wrong : {"expect fire", "expect not well", "expect value Spacing \"31.0 mm\"",
                            "expect enabled Spacing"})
    EXPECT_EQ(Run(wrong), ScriptState::kFailed) << wrong;
}

TEST_F(RunScript, WaitJobWaitsUntilTheJobEnds) {
  busy = true;
  EXPECT_EQ(Run("wait job\nshot a.png"), ScriptState::kFinished);
  EXPECT_FALSE(busy);
  EXPECT_EQ(shots.size(), 1u);
}

TEST_F(RunScript, TextIsTypedAsCodePoints) {
  EXPECT_EQ(Run("type \"aß→\""), ScriptState::kFinished);
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(std::get<CharacterTyped>(events[1]).character, U'ß');
  EXPECT_EQ(std::get<CharacterTyped>(events[2]).character, U'→');
}

TEST(Script, FramesAreMarkedFromTheLineOn) {
  ScriptRunner runner(ParseScript("mark \"at rest\"\nwait frames 5\nmark \"\"\n"));
  WidgetRegistry widgets;
  InputQueue input;
  int marked = 0;
  for (int frame = 0; frame < 100 && runner.state() == ScriptState::kRunning; ++frame) {
    runner.AfterFrame(widgets, false, input, {});
    marked += runner.mark() == "at rest";
  }
  EXPECT_GE(marked, 5);
  EXPECT_LT(marked, 15) << "and the frames in which a line settles";
  EXPECT_EQ(runner.mark(), "");
}

WidgetRecord Shown(const std::string& name, WidgetKind kind) {
  WidgetRecord record;
  record.name = name, record.kind = kind;
  record.x1 = record.y1 = 10;
  record.visible = true;
  return record;
}

TEST(Crawler, UsesEveryReachableItemBeforeItUsesOneAgain) {
  WidgetRegistry widgets;
  for (const char* name : {"Save", "Open", "New", "Undo", "Redo"})
    widgets.Record(Shown(name, WidgetKind::kButton));
  widgets.Record(Shown("Quit", WidgetKind::kButton));
  WidgetRecord hidden = Shown("Below a dialog", WidgetKind::kButton);
  hidden.reachable = false;
  widgets.Record(hidden);
  WidgetRecord disabled = Shown("Disabled", WidgetKind::kSlider);
  disabled.enabled = false;
  widgets.Record(disabled);
  Crawler crawler(CrawlOptions{3, {}});
  std::map<std::string, int> clicks;
  for (int i = 0; i < 60; ++i) {
    InputQueue input;
    const std::string words = crawler.Act(widgets, input);
    EXPECT_FALSE(input.empty()) << words;
    if (words.starts_with("click ")) ++clicks[words.substr(6)];
  }
  ASSERT_EQ(clicks.size(), 5u);
  int least = 1000, most = 0;
  for (const auto& [name, count] : clicks)
    least = std::min(least, count), most = std::max(most, count);
  EXPECT_LE(most - least, 1);
}

TEST(Crawler, ASeedGivesTheSameActionsAndMovesASliderToBothEndsFirst) {
  WidgetRegistry widgets;
  widgets.Record(Shown("Near relief", WidgetKind::kSlider));
  widgets.Record(Shown("Title", WidgetKind::kText));
  widgets.Record(Shown("Picture", WidgetKind::kPicture));
  const auto actions = [&](unsigned seed) {
    Crawler crawler(CrawlOptions{seed, {{"ctrl+z", {GLFW_KEY_LEFT_CONTROL, GLFW_KEY_Z}}}});
    std::vector<std::string> words;
    for (int i = 0; i < 100; ++i) {
      InputQueue input;
      words.push_back(crawler.Act(widgets, input));
    }
    return words;
  };
  const auto words = actions(1);
  EXPECT_EQ(words, actions(1));
  EXPECT_NE(words, actions(2));
  const auto at = [&](const std::string& text) {
    return std::find(words.begin(), words.end(), text) - words.begin();
  };
  const auto drag = at("drag Near relief to both ends"),
             typed = at("type -1e30 and 1e30 into Near relief"),
             nonsense = at("type \"nan\" into Near relief");
  EXPECT_LT(drag, typed);
  EXPECT_LT(typed, nonsense);
  EXPECT_LT(nonsense, 100);
}

}  // namespace
}  // namespace arthro::app
