// Pages of the Depth step: the controls beside the map, and the map. Free functions over the
// editor's state, which they change only through commands and edits.
#pragma once

#include <functional>
#include <memory>

#include "app/panels/fixed_window.h"
#include "app/state/editor_state.h"
#include "simulation/scene/image.h"

namespace arthro::app {

using DepthTextureOf = std::function<unsigned(const std::shared_ptr<const ColourImage>&)>;

// Width of one of so many buttons beside each other.
float ColumnWidth(int columns);

// Tools of the map, and what they read.
void DepthMapPanel(Ui& ui, EditorState& state);

// Kind, size and effect of the brush, and what it will do. Escape leaves it.
void BrushFields(Ui& ui, EditorState& state);

// Panorama, grey, filtered grey and relief, with the same zoom.
void ComparedPictures(Ui& ui, EditorState& state, const Area& area, const DepthTextureOf& texture);

// Shares of the picture by grey or nearness, with two handles that set the percentiles.
void DepthHistogramFigure(Ui& ui, EditorState& state);

// Presets of the weights of red, green and blue.
void ColourFilterField(Ui& ui, EditorState& state);

// Choice, meaning and range of a depth map in a file.
void ImportDepthFields(Ui& ui, EditorState& state);

// Distance, normal, stiffness and force under the pointer.
void TouchFields(Ui& ui, EditorState& state);

// The map with its layer, points and profile. `texture` gives a picture's OpenGL texture, first row
// at v = 0.
void DepthBoardPage(Ui& ui, EditorState& state, const Area& area, const DepthTextureOf& texture);

// Distance along the profile line: measured parts solid, others dashed, one standard error as a
// band.
void ProfileFigure(Ui& ui, const EditorState& state, const Area& area);

}  // namespace arthro::app
