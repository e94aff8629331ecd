// Targets by their names in lists and choices, and pictures of exercises.
#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/lessons/author/author_fields.h"
#include "app/steps/lessons/author/step_edit.h"
#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

std::vector<std::string> NamesFor(const Exercise& exercise, const std::string& key) {
  std::vector<std::string> names;
  for (const ExerciseTarget& target : exercise.targets)
    if (TakesInto(key, target)) names.push_back(target.id);
  return names;
}

bool SmallArrow(Ui& ui, const std::string& name, ImGuiDir direction, bool is_enabled,
                const char* tip) {
  ImGui::BeginDisabled(!is_enabled);
  const bool is_pressed = ImGui::ArrowButton(name.c_str(), direction);
  ImGui::EndDisabled();
  RecordItem(ui, name, is_enabled);
  Tooltip(ui, tip);
  return is_pressed && is_enabled;
}

std::filesystem::path& PictureNameOf(Exercise& exercise, int step) {
  return step < 0 ? exercise.picture
                  : BaseOf(exercise.steps[static_cast<std::size_t>(step)]).picture;
}

// Copies the picture beside the scene's other files, under a name of the exercise.
void TakePicture(EditorState& state, int step, const std::filesystem::path& file) {
  ReadColourImage(file);  // throws for what is no picture
  const Exercise& exercise = *ChosenExercise(state);
  const std::string owner =
      step < 0 ? exercise.id
               : fmt::format("{}-{}", exercise.id,
                             BaseOf(exercise.steps[static_cast<std::size_t>(step)]).id);
  const std::filesystem::path name = "picture-" + owner + file.extension().string();
  const std::filesystem::path copy = state.scratch.NewFile(name);
  WriteAtomically(copy, ReadWholeFile(file));
  // The file is no edit of its own: it comes with the step of the history that names it.
  EditExercise(state, "Picture", "", [&](Exercise& e) { PictureNameOf(e, step) = name; });
  authoring::Document document = state.document();
  document.files[name.generic_string()] = {copy, {}, {}};
  state.history.Amend(std::move(document));
}

}  // namespace

bool TargetListField(Ui& ui, const Exercise& exercise, const std::string& key,
                     const std::string& words, bool repeats, std::vector<std::string>& ids) {
  const std::vector<std::string> before = ids;
  QuietText(ui, words);
  const float side = ImGui::GetFrameHeight(), gap = ui.Px(4);
  for (std::size_t i = 0; i < before.size() && ids == before; ++i) {
    ImGui::PushID(static_cast<int>(i));
    const float line = ImGui::GetContentRegionAvail().x;
    ImGui::AlignTextToFramePadding();
    ShortenedText(ui, fmt::format("{}. {}", i + 1, before[i]), before[i], line - 3 * (side + gap));
    const float left = ImGui::GetCursorPosX() + line - 3 * side - 2 * gap;
    const std::string row = fmt::format("##{}{}", key, i);
    ImGui::SameLine(left);
    if (SmallArrow(ui, "Earlier" + row, ImGuiDir_Up, i > 0, "Earlier"))
      std::swap(ids[i], ids[i - 1]);
    ImGui::SameLine(0, gap);
    if (SmallArrow(ui, "Later" + row, ImGuiDir_Down, i + 1 < before.size(), "Later"))
      std::swap(ids[i], ids[i + 1]);
    ImGui::SameLine(0, gap);
    if (Button(ui, "×" + row, true, {side, side}, "Take it from this list."))
      ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(i));
    ImGui::PopID();
  }
  std::vector<std::string> rest = NamesFor(exercise, key);
  if (!repeats)
    std::erase_if(rest, [&](const std::string& id) { return std::ranges::count(ids, id) > 0; });
  int added = -1;
  if (!rest.empty() && Combo(ui, "Add to: " + words, added, rest))
    ids.push_back(rest[static_cast<std::size_t>(added)]);
  return ids != before;
}

bool TargetField(Ui& ui, const Exercise& exercise, const std::string& key, const std::string& words,
                 std::string& id) {
  const std::vector<std::string> names = NamesFor(exercise, key);
  const auto own = std::ranges::find(names, id);
  int chosen = own == names.end() ? -1 : static_cast<int>(own - names.begin());
  if (!Combo(ui, words, chosen, names)) return false;
  id = names[static_cast<std::size_t>(chosen)];
  return true;
}

void PictureField(Ui& ui, EditorState& state, int step) {
  Exercise copy = *ChosenExercise(state);
  const std::filesystem::path picture = PictureNameOf(copy, step);
  const float half = (ImGui::GetContentRegionAvail().x - ui.Px(6)) / 2;
  const std::string owner = step < 0 ? "##of exercise" : "##of step";
  if (Button(ui, "Picture…" + owner, true, {half, 0}, "Picture that is shown with the words."))
    Browse(state, BrowseFor::kOpenFile, "Picture of the exercise", "Use",
           {{"Pictures", {".png", ".jpg", ".jpeg"}}},
           [step](EditorState& now, const std::filesystem::path& file) {
             Guarded(now, "Picture", [&] {
               if (HasExercise(now)) TakePicture(now, step, file);
             });
           });
  ImGui::SameLine(0, ui.Px(6));
  if (Button(ui, "No picture" + owner, !picture.empty(), {half, 0}))
    EditExercise(state, "Picture", "", [&](Exercise& e) { PictureNameOf(e, step).clear(); });
  if (!picture.empty()) QuietText(ui, picture.generic_string());
}

void EditedExercise::Apply() {
  if (what_ != nullptr)
    EditExercise(state_, what_, is_dragged_ ? what_ : "",
                 [&](Exercise& exercise) { std::swap(exercise, changed); });
  if (is_released_) EndDrag(state_);
}

}  // namespace arthro::app
