#include "app/panels/chosen_row.h"

#include <imgui.h>

namespace arthro::app {

void ScrollToChosen(int row, int chosen) {
  if (row != chosen) return;
  // The row that was last seen chosen, from 1; 0: none.
  int* const seen = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("##chosen row"), 0);
  if (*seen != chosen + 1) ImGui::SetScrollHereY();
  *seen = chosen + 1;
}

}  // namespace arthro::app
