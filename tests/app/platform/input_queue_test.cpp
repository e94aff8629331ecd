// Part of the queue that one frame may see (app/platform/input_queue.h).
#include "app/platform/input_queue.h"

#include <string>

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

constexpr int kLeft = 0;

// Reads frames like Dear ImGui 1.86: the state of one button and the pointer, once per frame.
struct Reader {
  bool down = false;
  double x = 0, drag_x = 0;
  int clicks = 0;
  std::string text;
  bool control = false, selected_all = false;

  void Read(const std::vector<InputEvent>& frame) {
    const bool was_down = down;
    bool a_pressed = false;
    const double old_x = x;
    std::string typed;
    for (const auto& event : frame) {
      if (const auto* move = std::get_if<PointerMoved>(&event)) x = move->x;
      if (const auto* button = std::get_if<ButtonChanged>(&event)) down = button->down;
      if (const auto* key = std::get_if<KeyChanged>(&event)) {
        if (key->key == 'C') control = key->down;
        if (key->key == 'A' && key->down) a_pressed = true;
      }
      if (const auto* character = std::get_if<CharacterTyped>(&event))
        typed += static_cast<char>(character->character);
    }
    if (!was_down && down) ++clicks;
    if (was_down && down) drag_x += x - old_x;
    if (a_pressed && control) selected_all = true;
    if (!typed.empty() && selected_all) text.clear(), selected_all = false;
    text += typed;
  }
};

Reader ReadAll(InputQueue& queue) {
  Reader reader;
  while (!queue.empty()) reader.Read(queue.TakeFrame());
  return reader;
}

TEST(InputQueue, SixClicksBetweenTwoFramesAreSixClicks) {
  InputQueue queue;
  for (int click = 0; click < 6; ++click) {
    queue.Push(ButtonChanged{kLeft, true});
    queue.Push(ButtonChanged{kLeft, false});
  }
  EXPECT_EQ(ReadAll(queue).clicks, 6);
}

TEST(InputQueue, QuickDragArrivesWhole) {
  InputQueue queue;
  queue.Push(PointerMoved{100, 50});
  queue.Push(ButtonChanged{kLeft, true});
  for (int step = 1; step <= 10; ++step) queue.Push(PointerMoved{100.0 + 8 * step, 50});
  queue.Push(ButtonChanged{kLeft, false});
  EXPECT_DOUBLE_EQ(ReadAll(queue).drag_x, 80.0);
}

TEST(InputQueue, MovesOfOneFrameAreTakenTogether) {
  InputQueue queue;
  for (int step = 0; step < 500; ++step) queue.Push(PointerMoved{1.0 * step, 0});
  EXPECT_EQ(queue.TakeFrame().size(), 500u);
  EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, ButtonUpWaitsForTheFrameAfterAMove) {
  InputQueue queue;
  queue.Push(PointerMoved{1, 1});
  queue.Push(ButtonChanged{kLeft, false});
  EXPECT_EQ(queue.TakeFrame().size(), 1u);
  EXPECT_EQ(queue.TakeFrame().size(), 1u);
}

TEST(InputQueue, ButtonDownComesWithTheMoveThatLedToIt) {
  InputQueue queue;
  queue.Push(PointerMoved{1, 1});
  queue.Push(ButtonChanged{kLeft, true});
  EXPECT_EQ(queue.TakeFrame().size(), 2u);
}

TEST(InputQueue, ControlAThenTextReplacesTheText) {
  InputQueue queue;
  for (const char letter : std::string("old")) queue.Push(CharacterTyped{char32_t(letter)});
  queue.Push(KeyChanged{'C', true});
  queue.Push(KeyChanged{'A', true});
  queue.Push(KeyChanged{'A', false});
  queue.Push(KeyChanged{'C', false});
  for (const char letter : std::string("new")) queue.Push(CharacterTyped{char32_t(letter)});
  EXPECT_EQ(ReadAll(queue).text, "new");
}

TEST(InputQueue, KeyPressAndReleaseAreNeverInOneFrame) {
  InputQueue queue;
  queue.Push(KeyChanged{'A', true});
  queue.Push(CharacterTyped{U'a'});
  queue.Push(KeyChanged{'A', false});
  const auto first = queue.TakeFrame(), second = queue.TakeFrame();
  EXPECT_EQ(first.size(), 2u) << "the key and the text it makes";
  EXPECT_EQ(second.size(), 1u);
}

TEST(InputQueue, NoKeyAfterACharacter) {
  InputQueue queue;
  queue.Push(CharacterTyped{U'a'});
  queue.Push(KeyChanged{'B', true});
  EXPECT_EQ(queue.TakeFrame().size(), 1u);
}

TEST(InputQueue, WheelAfterAMoveTurnsWhereThePointerArrived) {
  InputQueue queue;
  queue.Push(PointerMoved{5, 5});
  queue.Push(WheelTurned{0, 1});
  queue.Push(PointerMoved{500, 5});
  EXPECT_EQ(queue.TakeFrame().size(), 1u);
  EXPECT_TRUE(std::holds_alternative<WheelTurned>(queue.TakeFrame().at(0)));
  EXPECT_EQ(queue.TakeFrame().size(), 1u);
}

TEST(InputQueue, EveryEventIsHandedOutOnceAndInOrder) {
  InputQueue queue;
  // A small fixed mix of everything.
  std::uint32_t random = 12345;
  std::vector<std::size_t> pushed;
  for (int i = 0; i < 2000; ++i) {
    random = random * 1664525u + 1013904223u;
    InputEvent event;
    switch ((random >> 16) % 7) {
      case 0:
        event = PointerMoved{1.0 * i, 0};
        break;
      case 1:
        event = ButtonChanged{i % 3, i % 2 == 0};
        break;
      case 2:
        event = WheelTurned{0, 1};
        break;
      case 3:
        event = KeyChanged{'A' + i % 26, i % 2 == 0};
        break;
      case 4:
        event = CharacterTyped{U'x'};
        break;
      case 5:
        event = FocusLost{};
        break;
      default:
        event = FilesDropped{{"a.png"}};
        break;
    }
    pushed.push_back(event.index());
    queue.Push(event);
  }
  std::vector<std::size_t> taken;
  while (!queue.empty()) {
    const auto frame = queue.TakeFrame();
    ASSERT_FALSE(frame.empty()) << "a frame that takes nothing would never end";
    for (const auto& event : frame) taken.push_back(event.index());
  }
  EXPECT_EQ(taken, pushed);
}

}  // namespace
}  // namespace arthro::app
