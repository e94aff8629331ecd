#include "app/editor/help/manual_page.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "app/help/help_pages.h"

namespace arthro::app {
namespace {

// Words of a line that lead to one place.
struct Piece {
  std::string words;
  std::string target;  // target of a link; empty: plain words
};

// Words without the signs of Markdown. Within `code` only the quotes are such signs.
std::string Plain(std::string_view line) {
  std::string words;
  bool is_code = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '`') {
      is_code = !is_code;
    } else if (is_code) {
      words += line[i];
    } else if (line[i] != '*') {
      if (line[i] == '\\' && i + 1 < line.size()) ++i;
      words += line[i];
    }
  }
  return words;
}

std::vector<Piece> PiecesOf(std::string_view line) {
  std::vector<Piece> pieces;
  std::size_t done = 0;
  const auto add = [&](std::string words, std::string_view target) {
    if (!words.empty()) pieces.push_back({std::move(words), std::string(target)});
  };
  for (std::size_t open = line.find('['); open != line.npos; open = line.find('[', open + 1)) {
    const std::size_t middle = line.find("](", open);
    if (middle == line.npos) break;
    const std::size_t close = line.find(')', middle);
    // The last bracket before "](" opens the link.
    if (close == line.npos || line.substr(open + 1, middle - open - 1).find('[') != line.npos)
      continue;
    add(Plain(line.substr(done, open - done)), "");
    add(Plain(line.substr(open + 1, middle - open - 1)),
        line.substr(middle + 2, close - middle - 2));
    done = close + 1, open = close;
  }
  add(Plain(line.substr(done)), "");
  return pieces;
}

std::string WordsOfPieces(const std::vector<Piece>& pieces) {
  std::string words;
  for (const Piece& piece : pieces) words += piece.words;
  return words;
}

std::vector<std::string> CellsOf(const std::string& row) {
  std::vector<std::string> cells;
  std::string cell;
  const auto without_spaces = [](const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? std::string()
                                      : text.substr(first, text.find_last_not_of(' ') + 1 - first);
  };
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i] == '\\' && i + 1 < row.size() && row[i + 1] == '|') {
      cell += row[++i];
    } else if (row[i] == '|') {
      cells.push_back(without_spaces(cell));
      cell.clear();
    } else {
      cell += row[i];
    }
  }
  return cells;
}

bool IsRule(const std::string& row) { return row.find_first_not_of("|-: ") == std::string::npos; }

// A numbered or plain entry of a list: its mark, or "".
std::string MarkOf(const std::string& line) {
  if (line.starts_with("- ")) return "- ";
  const std::size_t digits = line.find_first_not_of("0123456789");
  const bool is_numbered =
      digits != line.npos && digits > 0 && std::string_view(line).substr(digits).starts_with(". ");
  return is_numbered ? line.substr(0, digits + 2) : std::string();
}

class PageReader {
 public:
  PageReader(Ui& ui, const std::string& markdown, const std::string& anchor)
      : ui_(ui), lines_(markdown), anchor_(anchor) {}

  PageUse Draw() {
    while (Next()) {
      if (line_.starts_with("```")) {
        DrawListing();
      } else if (line_.starts_with("#")) {
        DrawHeading();
      } else if (line_.starts_with("|")) {
        DrawTable();
      } else if (!line_.empty() && !line_.starts_with("![")) {
        DrawParagraph();
      }
    }
    return use_;
  }

 private:
  bool Next() {
    if (is_kept_) return !(is_kept_ = false);
    return static_cast<bool>(std::getline(lines_, line_));
  }
  // The next call of Next gives the present line again.
  void Keep() { is_kept_ = true; }

  void DrawHeading() {
    const std::size_t words = std::min(line_.find_first_not_of("# "), line_.size());
    const std::string heading = WordsOfPieces(PiecesOf(std::string_view(line_).substr(words)));
    Gap(ui_);
    if (!anchor_.empty() && !use_.has_scrolled && AnchorOfHeading(heading) == anchor_) {
      ImGui::SetScrollHereY(0);
      use_.has_scrolled = true;
    }
    Heading(ui_, heading);
  }

  // Wrapped words, with links that can be pressed by mouse and keyboard.
  void DrawWords(std::string_view markdown, bool is_quiet = false) {
    const std::vector<Piece> pieces = PiecesOf(markdown);
    const bool has_link =
        std::ranges::any_of(pieces, [](const Piece& p) { return !p.target.empty(); });
    if (!has_link) {
      const std::string words = WordsOfPieces(pieces);
      return is_quiet ? QuietText(ui_, words) : Text(ui_, words);
    }
    const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {spacing.x, 0});
    FlowOfWords flow;
    for (const Piece& piece : pieces) {
      if (!piece.target.empty()) {
        DrawLink(flow, piece);
        continue;
      }
      for (std::size_t at = 0; at < piece.words.size();) {
        const std::size_t begin = piece.words.find_first_not_of(' ', at);
        flow.has_space |= begin != at;
        if (begin == std::string::npos) break;
        at = std::min(piece.words.find(' ', begin), piece.words.size());
        const std::string word = piece.words.substr(begin, at - begin);
        flow.Place(ImGui::CalcTextSize(word.c_str()).x);
        ImGui::TextUnformatted(word.c_str());
      }
    }
    ImGui::PopStyleVar();
    ui_.widgets.RecordText(WordsOfPieces(pieces));
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + spacing.y);
  }

  // Runs of words side by side, up to the right end of the room.
  struct FlowOfWords {
    float left = ImGui::GetCursorPosX(), room = ImGui::GetContentRegionAvail().x, used = 0;
    bool is_first = true, has_space = false;

    // Moves ImGui's cursor to where an item of this width belongs.
    void Place(float width) {
      const float gap = has_space ? ImGui::CalcTextSize(" ").x : 0;
      if (!is_first && used + gap + width <= room) {
        ImGui::SameLine(0, gap);
        used += gap + width;
      } else {
        ImGui::SetCursorPosX(left);
        used = width;
      }
      is_first = has_space = false;
    }
  };

  void DrawLink(FlowOfWords& flow, const Piece& piece) {
    const ImVec2 size = ImGui::CalcTextSize(piece.words.c_str());
    flow.Place(size.x);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::PushID(++links_);
    if (HitArea(piece.words.c_str(), size)) use_.link = piece.target;
    ImGui::PopID();
    RecordItem(ui_, piece.words);
    const bool is_lit = ImGui::IsItemHovered() || ImGui::IsItemFocused();
    if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    Tooltip(ui_, piece.target.c_str());
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const unsigned colour = OnGround(kAccent);
    draw->AddText(corner, colour, piece.words.c_str());
    draw->AddLine({corner.x, corner.y + size.y}, {corner.x + size.x, corner.y + size.y}, colour,
                  ui_.Px(is_lit ? 2 : 1));
  }

  void DrawListing() {
    while (Next() && !line_.starts_with("```")) QuietText(ui_, "    " + line_);
    Gap(ui_);
  }

  void DrawTable() {
    const std::size_t columns = CellsOf(line_).size();
    const bool is_open =
        columns > 0 && ImGui::BeginTable(fmt::format("table {}", ++tables_).c_str(),
                                         static_cast<int>(columns), ImGuiTableFlags_BordersInnerH);
    bool is_head = true;
    do {
      if (is_open && !IsRule(line_)) {
        ImGui::TableNextRow();
        for (const std::string& cell : CellsOf(line_))
          if (ImGui::TableNextColumn()) DrawWords(cell, is_head);
      }
      is_head = false;
    } while (Next() && line_.starts_with("|"));
    Keep();
    if (is_open) ImGui::EndTable();
    Gap(ui_);
  }

  // Lines up to an empty one, a new entry of a list or a block of another kind.
  void DrawParagraph() {
    const std::string mark = MarkOf(line_);
    std::string words = line_.substr(mark.size());
    while (Next() && !line_.empty() && MarkOf(line_).empty() && !line_.starts_with("|") &&
           !line_.starts_with("#") && !line_.starts_with("```")) {
      const std::size_t first = std::min(line_.find_first_not_of(' '), line_.size());
      words += " " + line_.substr(first);
    }
    const bool ends_list = line_.empty();
    if (!ends_list) Keep();
    if (mark.empty()) {
      DrawWords(words);
    } else {
      Text(ui_, mark == "- " ? "•" : mark);
      ImGui::SameLine(ui_.Px(26));
      DrawWords(words);
    }
    if (ends_list) Gap(ui_);
  }

  Ui& ui_;
  std::istringstream lines_;
  std::string line_;
  const std::string& anchor_;
  PageUse use_;
  bool is_kept_ = false;
  int tables_ = 0, links_ = 0;
};

}  // namespace

PageUse ManualPage(Ui& ui, const std::string& markdown, const std::string& anchor) {
  return PageReader(ui, markdown, anchor).Draw();
}

}  // namespace arthro::app
