// A picture that just fits its part of the board, on which a person points at pixels.
#pragma once

#include <optional>
#include <string>

#include <imgui.h>

#include "app/state/settings/picture_zoom.h"
#include "app/steps/panorama/pages/footage_panels.h"

namespace arthro::app {

struct ShownPicture {
  SharedPicture picture;
  Area area;
  glm::dvec2 size{0.0};  // px of the full picture

  ImVec2 OnScreen(const glm::dvec2& pixel) const;
  // The pixel under the pointer, if it is on the picture.
  std::optional<glm::dvec2> UnderPointer() const;
  void Draw(const TextureOf& texture) const;
};

// A ring with a word beside it; a line over the top of an area; a part of the board that takes the
// mouse, true when it was clicked.
void MarkPoint(Ui& ui, const ImVec2& at, const std::string& words);
void HintOver(Ui& ui, const Area& area, const std::string& words);
bool HitPart(Ui& ui, const char* name, const Area& area);
// A rectangle of pixels, dimmed or only outlined.
void MarkBox(Ui& ui, const ShownPicture& shown, const glm::dvec2& corner,
             const glm::dvec2& opposite, bool is_dimmed);

}  // namespace arthro::app
