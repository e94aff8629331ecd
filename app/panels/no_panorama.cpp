#include "app/panels/no_panorama.h"

#include "app/panels/command_button.h"

namespace arthro::app {

void AskForPanorama(Ui& ui, EditorState& state, const std::string& reason) {
  Text(ui, reason);
  if (CommandOf(state, "use-panorama").enabled(state)) {
    Text(ui, "The panorama that was made from the footage is not in the scene yet.");
    CommandButton(ui, state, "use-panorama", {-FLT_MIN, 0});
  } else if (Button(ui, "Take me there", true, {-FLT_MIN, 0}, "Open the Panorama step.")) {
    Run(state, "step-panorama");
  }
}

}  // namespace arthro::app
