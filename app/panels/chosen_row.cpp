#include "app/panels/chosen_row.h"

#include <imgui.h>
#include <imgui_internal.h>

namespace arthro::app {

void ScrollToChosen(int row, int chosen) {
  if (row != chosen) return;
  // The row that was last seen chosen, from 1; 0: none.
  int* const seen = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("##chosen row"), 0);
  if (*seen != chosen + 1) ImGui::SetScrollHereY();
  *seen = chosen + 1;
}

void ScrollToListOf(const char* list, int chosen) {
  // The row that was last seen chosen, from 2; 1: none; 0: the list is new, and nothing moves.
  int* const seen = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID(list), 0);
  if (*seen != 0 && *seen != chosen + 2 && chosen >= 0)
    ImGui::ScrollToItem(ImGuiScrollFlags_KeepVisibleEdgeY);
  *seen = chosen + 2;
}

}  // namespace arthro::app
