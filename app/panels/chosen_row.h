// The chosen row of a list in a child window, kept in sight.
#pragma once

namespace arthro::app {

// After row `row` of the list, ImGui's last item: scrolls to it in the frame after it was chosen.
void ScrollToChosen(int row, int chosen);

}  // namespace arthro::app
