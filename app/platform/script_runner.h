// Runs a script (script.h) against the items that the last frame showed, by putting events into the
// queue that the window's callbacks use. Called once a frame, after it was drawn.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/platform/crawler.h"
#include "app/platform/input_queue.h"
#include "app/platform/script.h"
#include "app/platform/widget_registry.h"

namespace arthro::app {

enum class ScriptState { kRunning, kFinished, kFailed };

class ScriptRunner {
 public:
  // `scale`: content scale, by which a drag's pixels are multiplied.
  explicit ScriptRunner(std::vector<ScriptLine> lines, double scale = 1.0);

  // Writes the frame that was just drawn, of the window or of the trainee's screen.
  using SavePicture = std::function<void(const std::filesystem::path&, bool of_trainee)>;

  // `busy`: a background job runs.
  ScriptState AfterFrame(const WidgetRegistry& widgets, bool busy, InputQueue& input,
                         const SavePicture& save_picture);

  ScriptState state() const { return state_; }
  const std::string& failure() const { return failure_; }  // a sentence with the line's number
  int line_number() const;                                 // line that runs next, or the last
  bool at_end() const { return next_ == lines_.size(); }
  const std::string& mark() const { return mark_; }
  // Keys that a crawl presses.
  void SetCrawlKeys(std::vector<CrawlKeys> keys) { crawl_keys_ = std::move(keys); }

 private:
  void Run(const ScriptLine& line, const WidgetRegistry& widgets, bool busy, InputQueue& input,
           const SavePicture& save_picture);
  const WidgetRecord* Target(const ScriptLine& line, const WidgetRegistry& widgets);
  void Crawl(const WidgetRegistry& widgets, InputQueue& input);
  void Fail(const ScriptLine& line, const std::string& sentence);

  std::vector<ScriptLine> lines_;
  double scale_;
  std::size_t next_ = 0;
  int frames_to_wait_;
  std::vector<int> held_keys_;
  std::chrono::steady_clock::time_point waiting_since_{};
  ScriptState state_ = ScriptState::kRunning;
  std::string failure_, mark_;
  std::vector<CrawlKeys> crawl_keys_;
  std::optional<Crawler> crawler_;  // while a crawl runs
  int crawl_steps_ = 0, crawl_steps_done_ = 0;
  std::chrono::steady_clock::time_point crawled_at_{};
};

}  // namespace arthro::app
