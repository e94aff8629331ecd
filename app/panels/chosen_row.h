// The chosen row of a list in a child window, kept in sight.
#pragma once

namespace arthro::app {

// After row `row` of the list, ImGui's last item: scrolls to it in the frame after it was chosen.
void ScrollToChosen(int row, int chosen);

// After the child window of the list, or where it would stand without rows (`chosen` −1): scrolls
// what the list stands in to it in the frame after a row was chosen. `list` is a name of its own.
void ScrollToListOf(const char* list, int chosen);

}  // namespace arthro::app
