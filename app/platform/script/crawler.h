// Uses a window as a careless user would: of the items that the last frame showed
// (widget_registry.h) it takes the one that was used least, and clicks it, moves it to both ends,
// or types nonsense into it; in between it presses keys and scrolls. One action per call. Pure: no
// window. The same seed and the same frames give the same actions.
#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "app/platform/input_queue.h"
#include "app/platform/widget_registry.h"

namespace arthro::app {

// A key combination and what it is called.
struct CrawlKeys {
  std::string name;
  std::vector<int> keys;  // GLFW_KEY_…, modifiers first
};

struct CrawlOptions {
  unsigned seed = 1;
  std::vector<CrawlKeys> keys;
  // Items that are left alone: they end the program, or lead out of the test's folder.
  std::vector<std::string> avoided = {"Quit", "Up", "Open in the browser"};
};

class Crawler {
 public:
  explicit Crawler(CrawlOptions options);

  // Appends the events of one action, and returns its words: "type \"nan\" into Seed".
  std::string Act(const WidgetRegistry& widgets, InputQueue& input);

  // How many different things were done.
  int distinct_actions() const { return distinct_actions_; }

 private:
  struct Action {
    const WidgetRecord* widget = nullptr;  // null: of the keyboard
    std::string item, key;                 // keys of `counts_`: the widget, and this action on it
    int index = 0;                         // index among the actions of its kind
  };
  std::vector<Action> ActionsOf(const WidgetRegistry& widgets) const;
  std::size_t Below(std::size_t count);  // a random index
  const Action& LeastUsed(const std::vector<Action>& actions);
  std::string PressKeys(InputQueue& input);
  std::string Scroll(const WidgetRegistry& widgets, InputQueue& input);

  CrawlOptions options_;
  std::mt19937 random_;
  std::map<std::string, int> counts_;
  int distinct_actions_ = 0;
};

}  // namespace arthro::app
