// The controls of the footage: clip, lens, options, run and result.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/options_panel.h"
#include "app/state/command.h"
#include "app/steps/panorama/board/footage_words.h"
#include "app/steps/panorama/board/panorama_run.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/pages/footage_panels.h"
#include "authoring/panorama/clip/panorama_options.h"

namespace arthro::app {
namespace {

// How pairs of frames are found is there for everybody; the rest is folded away, by stage.
bool IsInFront(std::string_view name) { return name == "method" || name == "detector"; }

struct Part {
  const char* prefix;
  const char* words;
};
constexpr Part kParts[] = {{"rectify_", "Straightening"},
                           {"prepare_", "Evening out the light"},
                           {"features_", "Features"},
                           {"direct_", "Direct alignment"},
                           {"graph_", "Which frames are compared"},
                           {"cycles_", "Loops that must close"},
                           {"refine_", "Placing all frames at once"},
                           {"compose_", "Drawing the panorama"}};

struct InFront {
  OptionsPanelVisitor& panel;
  template <class T, class R>
  void operator()(const char* name, T& field, const R& range, const char* unit, const char* help) {
    if (IsInFront(name)) panel(name, field, range, unit, help);
  }
};

struct Folded {
  OptionsPanelVisitor& panel;
  const Part* part = nullptr;
  bool is_open = true;
  template <class T, class R>
  void operator()(const char* name, T& field, const R& range, const char* unit, const char* help) {
    if (IsInFront(name)) return;
    const Part* now = nullptr;
    for (const Part& candidate : kParts)
      if (std::string_view(name).starts_with(candidate.prefix)) now = &candidate;
    if (now != part) {
      part = now;
      is_open = now == nullptr || Fold(panel.ui, now->words);
    }
    if (is_open) panel(name, field, range, unit, help);
  }
  static bool Fold(Ui& ui, const char* words) {
    const bool open =
        ImGui::TreeNodeEx(ui.translation.Label(words).c_str(),
                          ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_SpanAvailWidth);
    RecordItem(ui, words, true, open ? "on" : "off");
    return open;
  }
};

void Clip(Ui& ui, EditorState& state) {
  const FootageBoard& board = *state.steps.panorama->footage;
  ImGui::PushFont(ui.fonts.heading);
  ShortenedText(ui, board.name, board.file.c_str());
  ImGui::PopFont();
  QuietText(ui, WordsOfClip(board));
  // Widths of the words, plus equal shares of the remaining space.
  constexpr const char* kWords[] = {"Another video…", "Add a clip…", "Close it"};
  const float gap = ui.Px(6);
  float share = ImGui::GetContentRegionAvail().x - 2 * gap;
  for (const char* words : kWords) share -= ui.WidthOf(words);
  const auto width = [&](int i) { return ui.WidthOf(kWords[i]) + share / 3; };
  if (Button(ui, kWords[0], CommandOf(state, "make-panorama").enabled(state), {width(0), 0}))
    Run(state, "make-panorama");
  ImGui::SameLine(0, gap);
  const bool joins = CommandOf(state, "make-panorama").enabled(state) && board.missing.empty();
  if (Button(ui, kWords[1], joins, {width(1), 0},
             "Join a further clip of the same joint, filmed through the same lens."))
    BrowseForJoined(state);
  ImGui::SameLine(0, gap);
  if (Button(ui, kWords[2], !FootageIsUnderWay(state), {width(2), 0},
             "Close the clip. The scene stays as it is."))
    return CloseFootage(state);
  if (!board.missing.empty()) {
    ColouredText(ui, board.missing, kWarning);
    if (Button(ui, "Find the clip…", !FootageIsUnderWay(state), {-FLT_MIN, 0},
               "Choose where the clip lies now. It must be the same clip."))
      BrowseForMissing(state);
  }
}

void ClipLensChooser(Ui& ui, EditorState& state) {
  const FootageBoard& board = *state.steps.panorama->footage;
  std::vector<std::string> words;
  for (const LensChoice& lens : board.lenses) words.push_back(lens.words);
  words.emplace_back("from a file…");
  int chosen = board.lens;
  const std::string help = board.lenses.at(static_cast<std::size_t>(board.lens)).help;
  if (!Combo(ui, "Lens of the scope", chosen, words, help.c_str())) return;
  if (chosen < static_cast<int>(board.lenses.size()))
    SetFootageLens(state, chosen);
  else
    BrowseForLens(state);
}

// Whether the next run measures; grey where no lens is chosen.
void ReliefChooser(Ui& ui, EditorState& state) {
  const FootageBoard& board = *state.steps.panorama->footage;
  const auto lens = static_cast<std::size_t>(board.lens);
  const bool has_lens = lens < board.lenses.size() && board.lenses[lens].lens;
  int chosen = board.measures_relief ? 0 : 1;
  ImGui::BeginDisabled(!has_lens);
  if (Combo(ui, "Measure relief from motion", chosen, {"automatic", "no"},
            "Automatic: while the scope moves, near tissue shifts against far tissue, and that "
            "measures "
            "the depth. "
            "Where the clip does not show that, the panorama is made as usual and its depth is "
            "estimated from brightness."))
    SetMeasuresRelief(state, chosen == 0);
  ImGui::EndDisabled();
  if (!has_lens) QuietText(ui, "Only with the lens of the scope can relief be measured.");
}

// Finding of a measurement that did not succeed, and what follows from it.
void NotMeasured(Ui& ui, EditorState& state, const MadeRelief& relief) {
  for (const std::string& line : WordsOfRelief(relief)) ColouredText(ui, line, kWarning);
  if (const std::string test = WordsOfTest(relief.report.verdict); !test.empty())
    QuietText(ui, test + ".");
  Text(ui, "The panorama was made as usual. Its depth is estimated, not measured.");
  if (relief.is_partial()) CommandButton(ui, state, "use-measured-part", {-FLT_MIN, 0});
}

// The one that goes on from here.
bool MainButton(Ui& ui, const std::string& name, bool enabled) {
  ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImGui::GetStyleColorVec4(ImGuiCol_HeaderHovered));
  const bool pressed = Button(ui, name, enabled, {-FLT_MIN, ui.Px(36)});
  ImGui::PopStyleColor(2);
  return pressed;
}

void RunAndStop(Ui& ui, EditorState& state) {
  const FootageBoard& board = *state.steps.panorama->footage;
  if (FootageIsUnderWay(state)) {
    ImGui::ProgressBar(static_cast<float>(state.jobs.done()), {-FLT_MIN, 0});
    Text(ui, WordsOfStage(state.jobs.stage()));
    if (Button(ui, "Stop", true, {-FLT_MIN, ui.Px(36)}, "Stop. The last panorama is kept."))
      state.jobs.Stop();
    return;
  }
  const Command& run = CommandOf(state, "run-footage");
  const bool again = board.session != nullptr;
  const bool pressed = again ? Button(ui, "Run again", run.enabled(state), {-FLT_MIN, ui.Px(36)})
                             : MainButton(ui, "Run", run.enabled(state));
  CommandTip(ui, state, run);
  if (pressed) Run(state, run);
  if (const std::string next = WordsOfNextRun(board); !next.empty()) QuietText(ui, next);
}

void Result(Ui& ui, EditorState& state) {
  const FootageBoard& board = *state.steps.panorama->footage;
  if (!board.made) return;
  Gap(ui, 2);
  const std::vector<std::string> lines = WordsOfResult(board);
  Heading(ui, lines.front());
  const Command& use = CommandOf(state, "use-panorama");
  const bool is_used = MainButton(ui, use.words, use.enabled(state));
  CommandTip(ui, state, use);
  if (is_used) Run(state, use);
  Gap(ui, 1);
  if (board.made->relief && !board.made->is_measured()) {
    NotMeasured(ui, state, *board.made->relief);
    Gap(ui, 1);
  }
  for (std::size_t i = 1; i < lines.size(); ++i) Text(ui, lines[i]);
  for (const std::string& warning : WarningsOfResult(board)) ColouredText(ui, warning, kWarning);
}

}  // namespace

void FootagePanel(Ui& ui, EditorState& state) {
  Clip(ui, state);
  if (!state.steps.panorama->footage) return;
  Gap(ui, 2);
  ClipLensChooser(ui, state);
  ReliefChooser(ui, state);
  authoring::PanoramaOptions options = *state.steps.panorama->footage->options;
  OptionsPanelVisitor panel{ui};
  InFront in_front{panel};
  options.Visit(in_front);
  Gap(ui, 2);
  RunAndStop(ui, state);
  if (!state.steps.panorama->footage) return;
  Result(ui, state);
  MendFields(ui, state);

  Gap(ui, 2);
  if (Folded::Fold(ui, "More options")) {
    ImGui::Indent(ui.Px(8));
    Folded folded{panel};
    options.Visit(folded);
    ImGui::Unindent(ui.Px(8));
    if (Button(ui, "Back to the defaults", true, {-FLT_MIN, 0})) {
      options = {};
      panel.changed_field = "defaults";
    }
  }
  if (!panel.changed_field.empty()) SetPanoramaOptions(state, options);
}

}  // namespace arthro::app
