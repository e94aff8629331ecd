// Runs a script (script.h) against the items that the last frame showed, by putting events into the
// queue that the window's callbacks use. Called once a frame, after it was drawn.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/platform/input_queue.h"
#include "app/platform/script/crawler.h"
#include "app/platform/script/script.h"
#include "app/platform/widget_registry.h"

namespace arthro::app {

enum class ScriptState { kRunning, kFinished, kFailed };

// Acts of lines that go past the window's items. Each gives back why it failed, or "".
struct ScriptActions {
  std::function<std::string(const std::string& command, const std::vector<std::string>& arguments)>
      run;
  std::function<std::string(const std::filesystem::path& file)> choose;
  // Depth in m, latitude, longitude and roll in rad.
  std::function<std::string(bool of_scope, const std::vector<double>& pose)> pose;
  // `names`: names of the data, one per line, which need no translation.
  std::function<std::string(const std::string& names)> translated = {};
};

class ScriptRunner {
 public:
  // `scale`: content scale, by which a drag's pixels are multiplied.
  explicit ScriptRunner(std::vector<ScriptLine> lines, double scale = 1.0);

  // Writes the frame that was just drawn, of the window or of the trainee's screen.
  using SavePicture = std::function<void(const std::filesystem::path&, bool of_trainee)>;

  // `busy`: a background job runs.
  ScriptState AfterFrame(WidgetRegistry& widgets, bool busy, InputQueue& input,
                         const SavePicture& save_picture);

  ScriptState state() const { return state_; }
  const std::string& failure() const { return failure_; }  // a sentence with the line's number
  int line_number() const;                                 // line that runs next, or the last
  bool at_end() const { return next_ == lines_.size(); }
  const std::string& mark() const { return mark_; }
  void SetActions(ScriptActions actions) { actions_ = std::move(actions); }
  void SetJobLimit(std::chrono::seconds limit) { job_limit_ = limit; }
  // Keys that a crawl presses.
  void SetCrawlKeys(std::vector<CrawlKeys> keys) { crawl_keys_ = std::move(keys); }

 private:
  void Run(const ScriptLine& line, WidgetRegistry& widgets, bool busy, InputQueue& input,
           const SavePicture& save_picture);
  bool IsScrolledTo(const ScriptLine& line, WidgetRegistry& widgets);
  void GoOnWithStroke(InputQueue& input);
  void Act(const ScriptLine& line);
  void Walk(const WidgetRegistry& widgets, InputQueue& input);
  void ExpectLayout(const ScriptLine& line, const WidgetRegistry& widgets);
  void ExpectTips(const ScriptLine& line, const WidgetRegistry& widgets);
  const WidgetRecord* Target(const ScriptLine& line, const WidgetRegistry& widgets);
  void Crawl(const WidgetRegistry& widgets, InputQueue& input);
  void Fail(const ScriptLine& line, const std::string& sentence);

  std::vector<ScriptLine> lines_;
  double scale_;
  std::size_t next_ = 0;
  int frames_to_wait_;
  std::vector<int> held_keys_;
  std::vector<PointerMoved> stroke_;  // points that are still to come
  int stroke_button_ = -1;            // -1: no stroke is under way
  std::set<unsigned> walked_;         // items that had the focus
  bool walks_ = false;
  bool is_scrolled_ = false;  // for the next line
  ScriptActions actions_;
  std::chrono::seconds job_limit_{120};
  std::chrono::steady_clock::time_point waiting_since_{};
  ScriptState state_ = ScriptState::kRunning;
  std::string failure_, mark_;
  std::vector<CrawlKeys> crawl_keys_;
  std::optional<Crawler> crawler_;  // while a crawl runs
  int crawl_steps_ = 0, crawl_steps_done_ = 0;
  std::chrono::steady_clock::time_point crawled_at_{};
};

}  // namespace arthro::app
