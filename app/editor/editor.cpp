#include "app/editor/editor.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>
#include <utility>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "app/editor/editor_input.h"
#include "app/editor/editor_settings.h"
#include "app/editor/every_step.h"
#include "app/editor/lookback_view.h"
#include "app/editor/marks/cue_marks.h"
#include "app/editor/panels/panels.h"
#include "app/editor/panorama_clicks.h"
#include "app/editor/pictures/footage_textures.h"
#include "app/editor/pictures/frame_times.h"
#include "app/editor/pictures/pictures.h"
#include "app/editor/scene_views.h"
#include "app/editor/script_end.h"
#include "app/editor/script_recorder.h"
#include "app/editor/tab_walk.h"
#include "app/files/recovery_copy.h"
#include "app/files/scene_files.h"
#include "app/files/start_page.h"
#include "app/files/step_pictures.h"
#include "app/platform/ending_signals.h"
#include "app/platform/picture_window.h"
#include "app/platform/script/script_runner.h"
#include "app/platform/window.h"
#include "app/platform/x_display.h"
#include "app/recording/unfinished_film.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/budget/frame_budget.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/depth/pages/depth_panels.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/panorama/footage_work.h"
#include "app/steps/panorama/pages/footage_panels.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/practice/calibrate_incision.h"
#include "app/steps/practice/film.h"
#include "app/steps/practice/hand_motion.h"
#include "app/steps/practice/start_practice.h"
#include "app/steps/tissue/cut/tissue_cut.h"
#include "app/steps/tissue/fault_board.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/project/document_io.h"
#include "simulation/core/atomic_file.h"
#include "simulation/device/live/release_devices.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kFrame = 1.0 / 60.0;       // s, shortest time between two frames that time drives
constexpr double kLivelyAfter = 0.8;        // s after the last event: tips and hover settle
constexpr double kDrawAtLeastEvery = 0.05;  // s, while events stream in

class Editor {
 public:
  Editor(const EditorOptions& options, const EndingSignals& signals)
      : options_(options),
        signals_(signals),
        window_(WindowFrom(options, kFrame)),
        pictures_(options.script.has_value()),
        state_(MakeEditorState(NewDocument(), Window::WakeUp,
                               options.recent   ? *options.recent
                               : options.script ? std::filesystem::path()
                                                : RecentScenesFile())),
        recovery_(FolderOfCopies(options), Window::WakeUp) {
    if (options.script) {
      script_.emplace(ParseScript(ReadWholeFile(*options.script), *options.script),
                      window_.scale());
      script_->SetCrawlKeys(KeysOfCrawl(state_));
      ScriptActions actions = ActionsOf(state_);
      actions.translated = [this](const std::string& names) {
        return WordsOfMissing(translation_, names);
      };
      script_->SetActions(std::move(actions));
      script_->SetJobLimit(std::chrono::minutes(options.job_minutes));
    }
    BeginFrom(options_, state_);
    recovery_.Offer(state_);
  }

  void Run() {
    while (!state_.quit) {
      Wait();
      if (signals_.HasCome()) {
        recovery_.WriteNow(state_);  // nobody was asked
        return;
      }
      Frame();
      if (options_.frames > 0 && frames_ >= options_.frames) break;
      if (!script_ || script_->state() == ScriptState::kRunning) continue;
      if (script_->state() == ScriptState::kFailed)
        throw Error(Code::kBadData, script_->failure(), *options_.script);
      if (options_.is_unattended && Busy()) continue;
      break;
    }
    recovery_.Remove();
    if (!FileOfViews(options_).empty()) WriteViewLayout(FileOfViews(options_), state_.views);
    if (script_) RefuseUnfinishedScript(state_, options_, *script_);
  }

  // The display is gone: nothing may draw. Returns the end of a sentence.
  std::string EndWithoutDisplay() {
    const bool is_kept = recovery_.WriteNow(state_);
    End();
    return is_kept ? "; the unsaved work is kept, and is offered at the next start"
                   : "; start the program again on a display that works";
  }

  void End() {
    EndLessons(state_);
    state_.practice.reset();
    EndFilm();
    if (const std::string missing = state_.steps.practice->hands->End(); !missing.empty())
      std::fprintf(stderr, "warning: %s\n", missing.c_str());
  }

 private:
  // Waits until it is written.
  void EndFilm() {
    while (state_.steps.practice->film)
      if (!FinishFilm(state_)) std::this_thread::sleep_for(Seconds(kFrame));
    if (state_.steps.practice->is_film_lost)
      std::fprintf(stderr, "warning: %s\n", state_.steps.practice->film_words.c_str());
  }

  // Scale, colours and language as they are set; kept where they were changed in the window.
  void FollowSettings() {
    if (applied_settings_ == state_.settings) return;
    if (applied_settings_) WriteWindowSettings(FileOfSettings(options_), state_.settings);
    const bool is_other_language =
        !applied_settings_ || applied_settings_->language != state_.settings.language;
    applied_settings_ = state_.settings;
    window_.SetLook(ScaleFrom(options_, state_.settings, window_.monitor()),
                    state_.settings.theme == ThemeChoice::kLight ? Theme::kLight : Theme::kDark);
    if (is_other_language) {
      translation_ = TranslationFrom(options_, state_.settings);
      pictures_.SetOverviewLabels(translation_);
    }
    unsettled_ = std::max(unsettled_, 3);
  }
  // Notes the acts of this frame for the script that is recorded.
  void FollowByRecord() {
    const ImGuiIO& io = ImGui::GetIO();
    const FramePointer pointer{{io.MousePos.x, io.MousePos.y},
                               {io.MouseDown[0], io.MouseDown[1], io.MouseDown[2]},
                               io.MouseWheel,
                               io.KeyShift,
                               io.KeyCtrl,
                               ImGui::IsKeyPressed(GLFW_KEY_ENTER, false),
                               ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)};
    const double scale = window_.scale();
    recorder_.Follow(
        state_, widgets_, pointer, scale, static_cast<int>(std::lround(window_.width() / scale)),
        static_cast<int>(std::lround(window_.height() / scale)), Busy(), LaysOnRelief(state_));
  }

  // Sleeps until there is something to draw.
  void Wait() {
    const double since = Seconds(Clock::now() - last_draw_).count();
    const bool busy = Busy();
    if (!window_.input().empty() || script_ || options_.frames > 0) {
      window_.WaitEvents(0);
    } else if (LiveSession(state_) || window_.AnythingHeld()) {
      window_.WaitEvents(0);
      if (since < kFrame) std::this_thread::sleep_for(Seconds(kFrame - since));
    } else if (Seconds(Clock::now() - last_event_).count() < kLivelyAfter || unsettled_ > 0) {
      window_.WaitEvents(1.0 / 30.0);
    } else if (busy || ImGui::GetIO().WantTextInput ||
               (state_.steps.practice->shows_devices &&
                state_.steps.practice->hands->HasDevices())) {
      window_.WaitEvents(0.1);
    } else {
      window_.WaitEvents(std::clamp(recovery_.SecondsUntilDue(Now()), 0.05, 10.0));
    }
    if (!window_.input().empty()) last_event_ = Clock::now();
  }

  static double Now() { return Seconds(Clock::now().time_since_epoch()).count(); }

  bool Busy() const {
    return HasWork(state_) || pictures_.busy() ||
           (state_.steps.practice->film && state_.steps.practice->film->is_ending());
  }

  void Frame() {
    const auto now = Clock::now();
    FollowSettings();
    const FrameNews news = window_.BeginFrame();
    const double step = ImGui::GetIO().DeltaTime;
    TakeNews(state_, news);
    if (FinishWork(state_)) last_event_ = now;
    if (pictures_.Collect()) last_event_ = now;
    RunShortcuts(state_);
    if (state_.dialogs.empty() && !ShowsStartPage(state_) && !ShowsPanoramaBoard(state_) &&
        !ShowsDepthBoard(state_))
      ApplyHeldKeys(state_, picture_focused_, step);
    if (state_.steps.practice->hands->Look()) last_event_ = now;
    if (state_.practice && state_.dialogs.empty()) {
      state_.practice->SetCameraHead(state_.steps.practice->head);
      state_.practice->SetDisturbances(state_.steps.practice->disturbing.now);
      state_.practice->Advance(step, state_.steps.practice->hands.get());
    }
    Guarded(state_, "Attempt", [&] {
      if (FollowAttempt(state_)) last_event_ = now;
    });
    PlayDebrief(state_, step);
    KeepPivotFresh(state_);
    recovery_.Follow(state_, Now());
    if (state_.steps.practice->poke && state_.dialogs.empty())
      state_.steps.practice->poke->Advance(step);
    window_.SetTitle(TitleOf(state_));
    window_.SetFullScreen(state_.full_screen);

    // A stream of events is worked off faster than it could be drawn.
    will_draw_ = window_.input().empty() || Seconds(now - last_draw_).count() > kDrawAtLeastEvery;
    widgets_.BeginFrame();
    Ui ui{widgets_, window_.fonts(), translation_, static_cast<float>(window_.scale())};
    Panels(ui);
    FollowByRecord();
    if (ImGui::IsKeyPressed(GLFW_KEY_TAB) && !state_.practice)
      WalkByTab(widgets_, ImGui::GetIO().KeyShift);

    if (!will_draw_) {
      ImGui::EndFrame();
      return;
    }
    window_.EndFrame();
    if (script_)
      script_->AfterFrame(widgets_, Busy(), window_.input(),
                          [&](const std::filesystem::path& file, bool of_trainee) {
                            if (of_trainee && !trainee_screen_) return;
                            WriteColourImage(file, of_trainee ? trainee_screen_->ReadPicture()
                                                              : window_.ReadPicture());
                          });
    window_.Present();
    ShowTraineeScreen();
    last_draw_ = Clock::now();
    pictures_.NoteFrame(Seconds(last_draw_ - now).count());
    if (auto cost = pictures_.TakeCost()) {
      cost->whole = Seconds(last_draw_ - now).count();
      NoteFrame(*state_.steps.practice->budget, *cost);
    }
    if (options_.timing)
      frame_times_.Note(script_ ? script_->mark() : "", Seconds(last_draw_ - now).count());
    ++frames_;
    if (unsettled_ > 0) --unsettled_;
  }

  void ShowTraineeScreen() {
    TraineeScreen& screen = state_.steps.practice->trainee_screen;
    if (trainee_screen_ && trainee_screen_->IsLost()) {
      screen.is_wanted = false;
      screen.words = "The trainee's screen was closed, or its monitor is gone.";
      trainee_screen_.reset();
      Redraw();
    } else if (!screen.is_wanted) {
      if (trainee_screen_) screen.words.clear();
      trainee_screen_.reset();
    } else if (!trainee_screen_) {
      screen.is_wanted = false;
      Guarded(state_, "Trainee's screen", [&] {
        trainee_screen_.emplace(window_, "Trainee's screen — Arthroscene", screen.monitor,
                                !options_.hidden);
        screen.is_wanted = true;
        screen.words = trainee_screen_->notice();
      });
      Redraw();
    }
    if (trainee_screen_)
      trainee_screen_->Show(pictures_.scope_texture(), pictures_.scope_edge(),
                            pictures_.scope_version(), state_.steps.practice->frame_shape);
  }
  void Redraw() {
    state_.message = state_.steps.practice->trainee_screen.words;
    unsettled_ = std::max(unsettled_, 2);
  }

  void Panels(Ui& ui) {
    const float width = static_cast<float>(window_.width()),
                height = static_cast<float>(window_.height());
    if (state_.practice) {
      const Layout layout = PracticeLayout(width, height, ui.scale);
      picture_focused_ = true;
      DrawPictures(ui, layout);
      const PictureInput input =
          ScopePicture(ui, state_, layout.picture, pictures_.scope_texture());
      MarkTargets(ui, state_, layout.picture, input.area, pictures_.view(), pictures_.optics());
      ApplyPictureInput(state_, input, pictures_.view(),
                        state_.document().scene.scope.field_of_view);
      if (state_.steps.practice->shows_outside)
        pictures_.HandleOverview(state_,
                                 InsetOverview(ui, layout.overview, pictures_.overview_texture()));
      if (state_.steps.practice->calibrating)
        IncisionPage(ui, state_, layout.side);
      else if (state_.steps.practice->shows_devices)
        DevicesPage(ui, state_, layout.side);
      else if (state_.steps.practice->disturbing.shows_panel)
        DisturbancesPage(ui, state_, layout.side);
      else if (state_.steps.lessons->running)
        LessonPanel(ui, layout.side);
      else if (state_.steps.practice->budget->is_shown)
        BudgetPage(ui, state_, layout.side);
      else
        PracticePanel(ui, state_, layout.side);
    } else {
      const Layout layout = EditorLayout(width, height, ui.scale, state_.views);
      TopBar(ui, state_, layout.top);
      if (ShowsStartPage(state_)) {
        Board(ui, layout, StartBoard);
        StatusBar(ui, state_, layout.status, "");
        ShowDialogs(ui);
        return;
      }
      if (state_.steps.lessons->page != LessonPage::kNone) {
        Lesson(ui);
        StatusBar(ui, state_, layout.status, pictures_.notice());
        ShowDialogs(ui);
        return;
      }
      StepsPanel(ui, state_, layout.side);
      if (ShowsPanoramaBoard(state_)) {
        Board(ui, layout, FootageBoardPage);
      } else if (ShowsDepthBoard(state_)) {
        Board(ui, layout, DepthBoardPage);
      } else {
        Scene(ui, layout);
      }
      StatusBar(ui, state_, layout.status, pictures_.notice());
    }
    ShowDialogs(ui);
  }

  // Picture and overview together.
  static Area BoardArea(const Layout& layout) {
    return {layout.picture.x, layout.picture.y,
            layout.overview.x + layout.overview.width - layout.picture.x, layout.picture.height};
  }

  // The start page takes the room of the steps as well.
  static void StartBoard(Ui& ui, EditorState& state, const Area& area,
                         const PictureTextureOf& texture_of) {
    StartPagePanel(ui, state, {0, area.y, area.x + area.width, area.height}, texture_of);
  }

  void ShowDialogs(Ui& ui) {
    dialog_textures_.BeginFrame();
    Dialogs(ui, state_,
            [&](const SharedPicture& picture) { return dialog_textures_.IdOf(picture); });
    dialog_textures_.EndFrame();
  }

  template <class Page>
  void Board(Ui& ui, const Layout& layout, const Page& page) {
    picture_focused_ = false;
    footage_textures_.BeginFrame();
    page(ui, state_, BoardArea(layout),
         [&](const SharedPicture& picture) { return footage_textures_.IdOf(picture); });
    footage_textures_.EndFrame();
  }

  void LessonPanel(Ui& ui, const Area& area) {
    footage_textures_.BeginFrame();
    LessonPagePanel(ui, state_, area,
                    [&](const SharedPicture& picture) { return footage_textures_.IdOf(picture); });
    footage_textures_.EndFrame();
  }

  // Briefing and result take the whole page; the look back stands about the scope's picture.
  void Lesson(Ui& ui) {
    const Layout layout = EditorLayout(static_cast<float>(window_.width()),
                                       static_cast<float>(window_.height()), ui.scale);
    picture_focused_ = false;
    if (state_.steps.lessons->page != LessonPage::kDebrief)
      return LessonPanel(ui, {0, layout.picture.y, layout.overview.x + layout.overview.width,
                              layout.picture.height});
    Layout drawn = layout;
    drawn.picture = LookbackAreasOf(layout, ExpertFrame(state_) != nullptr, ui.scale).own;
    drawn.shows_overview = false;
    DrawPictures(ui, drawn);
    LookbackView(ui, state_, pictures_, layout);
  }

  void Scene(Ui& ui, const Layout& layout) {
    DrawPictures(ui, layout);
    picture_focused_ = ShowSceneViews(
        ui, layout, {state_, pictures_, panorama_clicks_, footage_textures_, target_marks_});
  }

  void DrawPictures(const Ui& ui, const Layout& layout) {
    if (!will_draw_) return;
    const bool is_moving =
        pictures_.DrawScope(state_, ScopePictureSize(ui, state_, layout.picture), ImGui::GetTime());
    if (is_moving && unsettled_ < 2) unsettled_ = 2;
    // The picture of the step is read once it rests.
    if (!is_moving && pictures_.scope_texture() != 0 && WantsStepPicture(state_))
      KeepStepPicture(state_, pictures_.ReadScope());
    if (state_.steps.practice->film && state_.practice) {
      if (std::exchange(noted_film_, state_.steps.practice->film.get()) !=
          state_.steps.practice->film.get())
        NoteRecordingFolder(state_.steps.practice->film->file().parent_path());
      pictures_.Record(*state_.steps.practice->film, FilmSeconds(state_));
    }
    if (state_.practice && !state_.steps.practice->shows_outside) return;
    if (!layout.shows_overview) return;
    if (pictures_.DrawOverview(state_, static_cast<int>(layout.overview.width),
                               static_cast<int>(layout.overview.height)) &&
        unsettled_ < 2)
      unsettled_ = 2;
  }

  const EditorOptions options_;
  const EndingSignals& signals_;
  Window window_;
  Pictures pictures_;
  std::optional<PictureWindow> trainee_screen_;
  FootageTextures footage_textures_, dialog_textures_;
  PanoramaClicks panorama_clicks_;
  TargetMarks target_marks_;
  EditorState state_;
  RecoveryCopy recovery_;  // ends before the state that it writes
  WidgetRegistry widgets_;
  std::optional<ScriptRunner> script_;
  ScriptRecorder recorder_;
  Translation translation_;
  std::optional<WindowSettings> applied_settings_;
  Clock::time_point last_draw_{}, last_event_ = Clock::now();
  int frames_ = 0, unsettled_ = 3;
  FrameTimes frame_times_;
  bool picture_focused_ = true, will_draw_ = true;
  const LiveFilm* noted_film_ = nullptr;  // the folder of which is remembered
};

}  // namespace

void RunEditor(const EditorOptions& options) {
  // Devices let go before the window has finished what it is at. Ends last: it may end the program.
  const EndingSignals signals([] {
    simulation::ReleaseDevices();
    Window::WakeUp();
  });
  Editor editor(options, signals);
  const DisplayWatch watch(simulation::ReleaseDevices);
  const DisplayRescue rescue([&editor] { return editor.EndWithoutDisplay(); });
  editor.Run();
  editor.End();
}

}  // namespace arthro::app
