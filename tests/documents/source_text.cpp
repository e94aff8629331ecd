#include "tests/documents/source_text.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

std::string Trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1));
}

void AddTree(const fs::path& folder, std::vector<fs::path>& files, auto&& is_wanted) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && is_wanted(entry.path())) files.push_back(entry.path());
}

// Reads a source from its first character to its last, once.
class Reader {
 public:
  explicit Reader(std::string_view source) : source_(source) {}

  SourceParts Read() {
    while (at_ < source_.size()) ReadNext();
    return std::move(parts_);
  }

 private:
  bool Sees(std::string_view word) const { return source_.substr(at_).starts_with(word); }

  void ReadNext() {
    const char next = source_[at_];
    if (Sees("//")) {
      ReadComment();
    } else if (Sees("R\"") && !IsInWord()) {
      ReadRaw();
    } else if (next == '"') {
      ReadLiteral();
    } else if (next == '\'' && !IsInWord()) {
      for (++at_; at_ < source_.size() && source_[at_] != '\''; ++at_)
        if (source_[at_] == '\\') ++at_;
      ++at_;
      MarkCode();
    } else {
      if (next == '\n') {
        ++line_;
        line_has_code_ = false;
      } else if (!std::isspace(static_cast<unsigned char>(next))) {
        MarkCode();
      }
      ++at_;
    }
  }

  // Digit separators and prefixes: 1'000, LR"(…)".
  bool IsInWord() const {
    return at_ > 0 && (std::isalnum(static_cast<unsigned char>(source_[at_ - 1])) != 0 ||
                       source_[at_ - 1] == '_');
  }

  void MarkCode() {
    line_has_code_ = true;
    literal_goes_on_ = false;
  }

  void ReadComment() {
    const std::size_t end = std::min(source_.find('\n', at_), source_.size());
    std::size_t begin = at_ + 2;
    while (begin < end && source_[begin] == '/') ++begin;
    Line line{line_, Trimmed(source_.substr(begin, end - begin))};
    const std::size_t column = at_ - std::min(source_.rfind('\n', at_) + 1, at_);
    const bool goes_on = !line_has_code_ && !parts_.comments.empty() &&
                         last_comment_line_ == line_ - 1 &&
                         (!parts_.comments.back().is_trailing || column == last_comment_column_);
    if (!goes_on) parts_.comments.push_back({line_has_code_, {}});
    parts_.comments.back().lines.push_back(std::move(line));
    last_comment_line_ = line_;
    last_comment_column_ = column;
    at_ = end;
  }

  void ReadLiteral() {
    const std::size_t begin = ++at_;
    while (at_ < source_.size() && source_[at_] != '"' && source_[at_] != '\n')
      at_ += source_[at_] == '\\' ? 2 : 1;
    const std::string_view text = source_.substr(begin, at_ - begin);
    if (literal_goes_on_)
      parts_.literals.back().text += text;
    else
      parts_.literals.push_back({line_, std::string(text)});
    if (at_ < source_.size() && source_[at_] == '"') ++at_;
    line_has_code_ = true;
    literal_goes_on_ = true;
  }

  void ReadRaw() {
    const std::size_t open = source_.find('(', at_);
    if (open == std::string_view::npos) {
      at_ = source_.size();
      return;
    }
    const std::string close = ")" + std::string(source_.substr(at_ + 2, open - at_ - 2)) + "\"";
    const std::size_t end = std::min(source_.find(close, open), source_.size());
    const std::string_view body = source_.substr(open + 1, end - open - 1);
    for (Comment& comment : PartsOfSource(body).comments) {
      for (Line& line : comment.lines) line.number += line_ - 1;
      parts_.comments.push_back(std::move(comment));
    }
    line_ += static_cast<int>(std::ranges::count(body, '\n'));
    at_ = std::min(end + close.size(), source_.size());
    MarkCode();
  }

  std::string_view source_;
  std::size_t at_ = 0;
  std::size_t last_comment_column_ = 0;
  int line_ = 1, last_comment_line_ = -1;
  bool line_has_code_ = false, literal_goes_on_ = false;
  SourceParts parts_;
};

}  // namespace

std::string TextOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<fs::path> SourceFiles(const fs::path& root) {
  std::vector<fs::path> files;
  for (const char* top : {"app", "authoring", "simulation", "tests"})
    AddTree(root / top, files, [](const fs::path& file) {
      const std::string extension = file.extension().string();
      return extension == ".h" || extension == ".cpp" || extension == ".inc" ||
             extension == ".glsl";
    });
  std::ranges::sort(files);
  return files;
}

std::vector<fs::path> DocumentFiles(const fs::path& root) {
  std::vector<fs::path> files = {root / "README.md", root / "CONTRIBUTING.md",
                                 root / "CHANGELOG.md", root / "SECURITY.md"};
  AddTree(root / "resources/doc", files,
          [](const fs::path& file) { return file.extension() == ".md"; });
  std::sort(files.begin() + 4, files.end());
  return files;
}

std::vector<fs::path> ScriptFiles(const fs::path& root) {
  std::vector<fs::path> files = {root / "CMakeLists.txt", root / ".ci/run"};
  for (const char* top : {"app", "authoring", "simulation", "tests", "resources"})
    AddTree(root / top, files, [](const fs::path& file) {
      const std::string extension = file.extension().string();
      return file.filename() == "CMakeLists.txt" || extension == ".cmake" || extension == ".py";
    });
  AddTree(root / "packaging", files, [](const fs::path&) { return true; });
  std::ranges::sort(files);
  return files;
}

std::string Comment::Joined() const {
  std::string text;
  for (const Line& line : lines) text += (text.empty() ? "" : " ") + line.text;
  return text;
}

SourceParts PartsOfSource(std::string_view source) { return Reader(source).Read(); }

std::vector<Comment> CommentsOfScript(std::string_view script) {
  std::vector<Comment> comments;
  std::istringstream lines{std::string(script)};
  int number = 0, last = -1;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string text = Trimmed(line);
    if (!text.starts_with('#') || text.starts_with("#!")) continue;
    if (last != number - 1) comments.emplace_back();
    comments.back().lines.push_back({number, Trimmed(std::string_view(text).substr(1))});
    last = number;
  }
  return comments;
}

}  // namespace arthro::test
