#include "app/steps/lessons/pages/lesson_picture.h"

#include <algorithm>

#include <imgui.h>

#include "app/state/capital.h"
#include "simulation/core/error.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

LessonPicture ReadPicture(const EditorState& state, const std::filesystem::path& name) {
  LessonPicture read{name, state.document_number, {}, {}};
  const auto& files = state.document().files;
  const auto file = files.find(name.generic_string());
  try {
    if (file == files.end())
      throw Error(Code::kFile, "the scene has no file of this name; choose the picture again",
                  name);
    read.picture = Share(ReadColourImage(file->second.file));
  } catch (const Error& fault) {
    read.fault = fault.what();
  }
  return read;
}

}  // namespace

void ShowLessonPicture(Ui& ui, EditorState& state, const std::filesystem::path& name, float height,
                       const LessonTexture& texture_of) {
  if (name.empty()) return;
  LessonPicture& shown = state.steps.lessons->picture;
  if (shown.name != name || shown.document != state.document_number)
    shown = ReadPicture(state, name);
  if (!shown.fault.empty()) return ColouredText(ui, Capital(shown.fault) + ".", kWarning);
  const unsigned texture = texture_of(shown.picture);
  if (texture == 0 || shown.picture->width < 1) return;
  const auto width = static_cast<float>(shown.picture->width),
             high = static_cast<float>(shown.picture->height);
  const float factor =
      std::min({ui.Px(height) / high, ImGui::GetContentRegionAvail().x / width, ui.scale});
  ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture)),
               {factor * width, factor * high});
  RecordItem(ui, "Picture of the exercise", true, "", WidgetKind::kShown);
}

}  // namespace arthro::app
