#include "app/files/browse_preview.h"

#include <utility>
#include <variant>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "app/files/start_page.h"
#include "app/steps/panorama/board/board_picture.h"
#include "authoring/footage/footage.h"
#include "authoring/project/files/file_ending.h"
#include "simulation/core/error.h"
#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/training/attempt_head.h"
#include "simulation/training/attempt_log.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

// Larger files take too long to read for a glance.
constexpr std::uintmax_t kMostBytes = 256u << 20;

FilePreview OfScene(const fs::path& place) {
  const StartScene scene = ReadStartScene(place);
  return {place, scene.picture, scene.problem.empty() ? scene.title : scene.problem};
}

FilePreview OfPicture(const fs::path& file) {
  const ColourImage picture = ReadColourImage(file);
  return {file, PictureFromColour(picture, BrowsePreview::kPictureSide),
          fmt::format("{} x {} px", picture.width, picture.height)};
}

FilePreview OfVideo(const fs::path& file) {
  authoring::Footage footage = authoring::Footage::Open(file);
  const authoring::FootageInfo& info = footage.info();
  FilePreview preview{file, nullptr, fmt::format("{} x {} px", info.width, info.height)};
  if (info.frames > 0 && info.frames_per_second > 0)
    preview.words += fmt::format(", {:.0f} s", info.frames / info.frames_per_second);
  cv::Mat frame;
  if (footage.Next(frame)) preview.picture = PictureFromMat(frame, BrowsePreview::kPictureSide);
  return preview;
}

FilePreview OfAttempt(const fs::path& file) {
  const simulation::AttemptHead head =
      simulation::AttemptHeadOf(simulation::ReadAttempt(file).head, file);
  return {file, nullptr,
          fmt::format("Exercise {} of the scene \"{}\", {}", head.exercise, head.scene, head.mode)};
}

// The entry of the dialog on top that is chosen; nothing where no file browser is open.
std::optional<fs::path> ChosenEntry(const EditorState& state) {
  if (state.dialogs.empty()) return std::nullopt;
  const auto* dialog = std::get_if<BrowseDialog>(&state.dialogs.back());
  if (dialog == nullptr) return std::nullopt;
  const FileBrowserModel& model = dialog->model;
  for (const FileEntry& entry : model.entries())
    if (entry.name() == model.file_name) return entry.path;
  return fs::path();
}

}  // namespace

FilePreview ReadFilePreview(const fs::path& file) {
  using authoring::IsOneOf;
  std::error_code ignored;
  const std::string ending = authoring::LowerExtension(file);
  try {
    if (fs::exists(file / "scene.json", ignored)) return OfScene(file);
    if (!fs::is_regular_file(file, ignored)) return {file, nullptr, ""};
    if (fs::file_size(file, ignored) > kMostBytes && !IsOneOf(ending, {".mp4", ".avi", ".mkv"}))
      return {file, nullptr, "Too large for a preview."};
    if (IsArchive(file) || file.filename() == "scene.json") return OfScene(file);
    if (IsOneOf(ending, {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp"})) return OfPicture(file);
    if (IsOneOf(ending, {".mp4", ".avi", ".mkv", ".mov", ".mpg", ".mpeg", ".webm", ".m4v"}))
      return OfVideo(file);
    if (ending == ".attempt") return OfAttempt(file);
  } catch (const Error& fault) {
    return {file, nullptr, fault.sentence()};
  } catch (const std::exception& fault) {
    return {file, nullptr, fault.what()};
  }
  return {file, nullptr, ""};
}

bool KeepBrowsePreviewFresh(EditorState& state) {
  const std::optional<fs::path> chosen = ChosenEntry(state);
  if (!chosen && !state.browsed) return false;
  if (!state.browsed) state.browsed.emplace(state.wake);
  BrowsePreview& preview = *state.browsed;
  bool changed = false;
  if (preview.jobs.busy()) changed = preview.jobs.Finish(state);
  if (preview.jobs.busy()) return changed;
  const fs::path wanted = chosen.value_or(fs::path());
  if (preview.shown.file == wanted) return changed;
  preview.shown = {wanted, nullptr, ""};
  if (wanted.empty()) return true;
  preview.jobs.Start("Preview", [wanted](const Progress&) -> Jobs::Apply {
    return [read = ReadFilePreview(wanted)](EditorState& now) {
      if (now.browsed->shown.file == read.file) now.browsed->shown = read;
    };
  });
  return true;
}

}  // namespace arthro::app
