#include "app/editor/help/manual_page.h"

#include <regex>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

namespace arthro::app {
namespace {

// Words of a line without the signs of Markdown.
std::string Plain(std::string line) {
  static const std::regex link(R"(!?\[([^\]]*)\]\([^)]*\))");
  line = std::regex_replace(line, link, "$1");
  std::string words;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '`') continue;
    if (line[i] == '*') continue;
    if (line[i] == '\\' && i + 1 < line.size()) ++i;
    words += line[i];
  }
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
      cells.push_back(Plain(without_spaces(cell)));
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
  static const std::regex mark(R"(^(- |[0-9]+\. ))");
  std::smatch match;
  return std::regex_search(line, match, mark) ? match[1].str() : std::string();
}

class PageReader {
 public:
  PageReader(Ui& ui, const std::string& markdown) : ui_(ui), lines_(markdown) {}

  void Draw() {
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
    Gap(ui_);
    Heading(ui_, Plain(line_.substr(words)));
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
          if (ImGui::TableNextColumn()) is_head ? QuietText(ui_, cell) : Text(ui_, cell);
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
      Text(ui_, Plain(words));
    } else {
      Text(ui_, mark == "- " ? "•" : mark);
      ImGui::SameLine(ui_.Px(26));
      Text(ui_, Plain(words));
    }
    if (ends_list) Gap(ui_);
  }

  Ui& ui_;
  std::istringstream lines_;
  std::string line_;
  bool is_kept_ = false;
  int tables_ = 0;
};

}  // namespace

void ManualPage(Ui& ui, const std::string& markdown) { PageReader(ui, markdown).Draw(); }

}  // namespace arthro::app
