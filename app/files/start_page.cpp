#include "app/files/start_page.h"

#include <algorithm>
#include <chrono>
#include <ctime>

#include "app/files/scene_files.h"
#include "app/platform/resource_folder.h"
#include "app/state/command.h"
#include "app/steps/tissue/library/tissue_library.h"
#include "authoring/footage/resized_picture.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using State = EditorState;

// The middle of the picture in the shape of the page's pictures.
std::shared_ptr<const ColourImage> SmallPicture(const ColourImage& picture) {
  const double scale = std::max(static_cast<double>(StartPage::kPictureWidth) / picture.width,
                                static_cast<double>(StartPage::kPictureHeight) / picture.height);
  const int width =
                std::clamp(static_cast<int>(StartPage::kPictureWidth / scale), 1, picture.width),
            height =
                std::clamp(static_cast<int>(StartPage::kPictureHeight / scale), 1, picture.height);
  const int left = (picture.width - width) / 2, top = (picture.height - height) / 2;
  return Share(authoring::Resized(picture, {left, top, left + width, top + height},
                                  StartPage::kPictureWidth, StartPage::kPictureHeight));
}

std::string SavedAt(const fs::path& place) {
  std::error_code ignored;
  const fs::path file = fs::is_directory(place, ignored) ? place / "scene.json" : place;
  const auto written = fs::last_write_time(file, ignored);
  if (ignored) return "";
  const std::time_t time = std::chrono::system_clock::to_time_t(
      std::chrono::time_point_cast<std::chrono::system_clock::duration>(
          written - fs::file_time_type::clock::now() + std::chrono::system_clock::now()));
  std::tm local{};
  char words[32];
  if (::localtime_r(&time, &local) == nullptr) return "";
  std::strftime(words, sizeof words, "%Y-%m-%d %H:%M", &local);
  return words;
}

void OpenDemo(State& state) {
  GuardUnsaved(state, "open the demo scene",
               [](State& sure) { OpenScene(sure, ResourceFolder() / "demo"); });
}

template <const char* const& id>
void BeginWith(State& state) {
  GuardUnsaved(state, "begin a new scene", [](State& sure) {
    StartDocument(sure, NewDocument(), true);
    sure.step = Step::kPanorama;
    HideStartPage(sure);
    Run(sure, id);
  });
}
constexpr const char* kFromFootage = "make-panorama";
constexpr const char* kFromPicture = "import-panorama";
constexpr const char* kFromPhantom = "phantom-footage";

void OpenLibrary(State& state) {
  HideStartPage(state);
  state.step = Step::kTissue;
  state.steps.tissue->shelf->is_open = true;
}

constexpr Command kStartPageCommands[] = {
    {"start-page",
     "Start",
     "Show the start page, or go back to the scene.",
     "Scene",
     {},
     {},
     InEditor,
     [](State& state) {
       if (ShowsStartPage(state))
         HideStartPage(state);
       else
         ShowStartPage(state);
     }},
    {"open-demo",
     "Demo scene",
     "Open the scene that came with the program.",
     "Scene",
     {},
     {},
     Idle,
     OpenDemo},
    {"new-from-footage",
     "New from footage…",
     "Begin a scene with a panorama made from a video or a folder of pictures.",
     "Scene",
     {},
     {},
     Idle,
     BeginWith<kFromFootage>},
    {"new-from-picture",
     "New from a picture…",
     "Begin a scene with a picture as its backdrop.",
     "Scene",
     {},
     {},
     Idle,
     BeginWith<kFromPicture>},
    {"new-from-phantom",
     "New from a digital knee…",
     "Make the footage of a computed knee, and begin a scene from it.",
     "Scene",
     {},
     {},
     Idle,
     BeginWith<kFromPhantom>},
    {"open-library",
     "Model library",
     "Show the ready-made models of the knee on the page of tissues.",
     "Scene",
     {},
     {},
     HasPicture,
     OpenLibrary},
};

}  // namespace

std::span<const Command> StartCommands() { return kStartPageCommands; }

StartScene ReadStartScene(const fs::path& place) {
  StartScene scene;
  scene.place = place;
  scene.is_read = true;
  scene.title = place.stem().string();
  scene.folder = place.parent_path().string();
  scene.saved = SavedAt(place);
  try {
    std::error_code ignored;
    if (fs::is_directory(place, ignored)) {
      const Scene values = ReadScene(place);
      if (!values.title.empty()) scene.title = values.title;
      scene.picture = SmallPicture(ReadColourImage(place / values.backdrop.panorama));
    } else {
      const LoadedScene loaded = LoadScene(place);
      if (!loaded.scene.title.empty()) scene.title = loaded.scene.title;
      if (loaded.panorama) scene.picture = SmallPicture(*loaded.panorama);
    }
  } catch (const std::exception& fault) {
    scene.problem = DescribeFault(fault);
  }
  return scene;
}

bool ShowsStartPage(const State& state) { return state.start && state.start->is_shown; }

void HideStartPage(State& state) {
  if (state.start) state.start->is_shown = false;
}

void ShowStartPage(State& state) {
  if (!state.start) state.start.emplace(state.wake);
  StartPage& page = *state.start;
  page.is_shown = true;
  page.document_number = state.document_number;
  std::vector<StartScene> scenes;
  for (const fs::path& place : state.recent.Existing()) {
    const auto known = std::find_if(page.scenes.begin(), page.scenes.end(),
                                    [&](const auto& scene) { return scene.place == place; });
    StartScene scene = known != page.scenes.end() ? *known : StartScene{};
    scene.is_read = false;  // it may have been saved meanwhile; its old picture stays until then
    if (scene.place.empty()) {
      scene.place = place;
      scene.title = place.stem().string();
      scene.folder = place.parent_path().string();
    }
    scenes.push_back(std::move(scene));
  }
  page.scenes = std::move(scenes);
}

bool KeepStartPageFresh(State& state) {
  if (!state.start) return false;
  StartPage& page = *state.start;
  if (page.is_shown && page.document_number != state.document_number) page.is_shown = false;
  bool changed = false;
  if (page.jobs.busy()) changed = page.jobs.Finish(state);
  if (!page.is_shown || page.jobs.busy()) return changed;
  const auto next = std::find_if(page.scenes.begin(), page.scenes.end(),
                                 [](const auto& scene) { return !scene.is_read; });
  if (next == page.scenes.end()) return changed;
  page.jobs.Start("Recent scenes", [place = next->place](const Progress&) {
    return [read = ReadStartScene(place)](State& now) {
      for (StartScene& scene : now.start->scenes)
        if (scene.place == read.place) scene = read;
    };
  });
  return changed;
}

}  // namespace arthro::app
