#include "tests/documents/language_rules.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLongestSentence = 30;  // words

// Wording that hides its meaning, and the wording to use instead.
struct Refused {
  const char* pattern;
  const char* instead;
};
constexpr Refused kRefused[] = {
    {R"(so-manieth)", "every N-th"},
    {R"(\bthe say of\b)", "the blend weight of"},
    {R"(\bno frame saw\b)", "unobserved pixels"},
    {R"(\blooks? (a|per) (pixel|ray|texel)\b)", "samples per pixel"},
    {R"(\blooks at the panorama\b)", "samples of the panorama"},
    {R"(\b(costs?|without|after|of) a look\b)", "a sample, a test or a read"},
    {R"(\blight is thrown back\b)", "reflected, or diffuse shading"},
    {R"(\bliving ones\b)", "deformable tissues"},
    {R"(\bone a [a-z]+\b)", "one per"},
    {R"(\b(one|two|[0-9]+) (?!(for|where|in|of|is|as|to|at|by|from|on|with|and|or|than) )[a-z]+ )"
     R"(an? (second|minute|tick|step|frame|pixel|tissue|triangle|point|axis)\b)",
     "per"},
    {R"(\b(time|clock) a (frame|tick|step)\b)", "per"},
};

bool IsOpening(const std::string& word) {
  std::string lower;
  for (const char letter : word)
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  for (const char* opening : {"of", "what", "where", "as", "by", "who", "that", "which"})
    if (lower == opening) return true;
  return false;
}

std::string FirstWord(const std::string& text) {
  const auto end = std::find_if(text.begin(), text.end(), [](char letter) {
    return std::isalpha(static_cast<unsigned char>(letter)) == 0;
  });
  return {text.begin(), end};
}

// A first line opens with its first word. A later line opens only where it begins a sentence: its
// word is capitalised; otherwise it continues the line above it.
void CheckOpenings(const Comment& comment, std::vector<LanguageFault>& faults) {
  for (const Line& line : comment.lines) {
    const std::string word = FirstWord(line.text);
    const bool is_first = &line == &comment.lines.front();
    const bool is_capital = !word.empty() && std::isupper(static_cast<unsigned char>(word[0])) != 0;
    if (IsOpening(word) && (is_first || is_capital))
      faults.push_back({line.number, "opens with \"" + word + "\"; open with a noun or a verb"});
  }
}

void CheckWords(int number, const std::string& text, std::vector<LanguageFault>& faults) {
  static const auto patterns = [] {
    std::vector<std::pair<std::regex, const char*>> list;
    for (const Refused& refused : kRefused)
      list.emplace_back(std::regex(refused.pattern, std::regex::icase | std::regex::optimize),
                        refused.instead);
    return list;
  }();
  std::smatch match;
  for (const auto& [pattern, instead] : patterns)
    if (std::regex_search(text, match, pattern))
      faults.push_back({number, "says \"" + match.str() + "\"; say: " + instead});
}

int CountWords(const std::string& sentence) {
  std::istringstream words(sentence);
  int count = 0;
  for (std::string word; words >> word;)
    count += std::ranges::any_of(
        word, [](unsigned char letter) { return std::isalnum(letter) != 0 || letter >= 0x80; });
  return count;
}

// A sentence ends at a full stop, an exclamation or question mark before a space, or with its line.
void CheckSentences(const Literal& literal, std::vector<LanguageFault>& faults) {
  static const std::regex end(R"([.!?]( |$)|\\n)");
  for (std::sregex_token_iterator sentence(literal.text.begin(), literal.text.end(), end, -1), none;
       sentence != none; ++sentence) {
    const int words = CountWords(sentence->str());
    if (words <= kLongestSentence) continue;
    faults.push_back({literal.number, "has a sentence of " + std::to_string(words) + " words (" +
                                          std::to_string(kLongestSentence) +
                                          " at most): " + sentence->str().substr(0, 60) + "…"});
  }
}

// The last literal of each call that declares an option, a flag or a job is its help. Help that is
// put together at run time, or a name alone, is not judged.
void CheckHelp(std::string_view source, std::vector<LanguageFault>& faults) {
  static const std::regex call(
      R"(\b(add_(option|flag|subcommand)(_function)?(<[^<>]*>)?|v)\(\s*")");
  for (std::cregex_iterator found(source.data(), source.data() + source.size(), call), none;
       found != none; ++found) {
    const auto begin = static_cast<std::size_t>(found->position());
    const std::size_t open = source.find('(', begin);
    int depth = 0;
    std::size_t end = open, quote = open;  // quote: end of the last literal
    for (bool is_inside = false; end < source.size(); ++end) {
      const char next = source[end];
      if (next == '\\') {
        ++end;
      } else if (next == '"') {
        is_inside = !is_inside;
        quote = end;
      } else if (!is_inside) {
        depth += next == '(' ? 1 : next == ')' ? -1 : 0;
        if (depth == 0) break;
      }
    }
    const SourceParts parts = PartsOfSource(source.substr(open, end - open));
    if (parts.literals.empty()) continue;
    const std::string& help = parts.literals.back().text;
    const char after = source[source.find_first_not_of(" \n", quote + 1)];
    if (help.find(' ') == std::string::npos || help.ends_with('.') ||
        (after != ')' && after != ','))
      continue;
    const auto line = static_cast<int>(std::count(source.begin(), source.begin() + begin, '\n'));
    faults.push_back({line + 1, "has help without a full stop: \"" + help.substr(0, 60) + "\""});
  }
}

void CheckComments(const std::vector<Comment>& comments, std::vector<LanguageFault>& faults) {
  for (const Comment& comment : comments) {
    CheckOpenings(comment, faults);
    CheckWords(comment.lines.front().number, comment.Joined(), faults);
  }
}

}  // namespace

std::vector<LanguageFault> LanguageFaults(std::string_view text, TextKind kind) {
  std::vector<LanguageFault> faults;
  if (kind == TextKind::kScript) {
    CheckComments(CommentsOfScript(text), faults);
  } else if (kind == TextKind::kDocument) {
    std::istringstream lines{std::string(text)};
    int number = 0;
    for (std::string line; std::getline(lines, line);) CheckWords(++number, line, faults);
  } else {
    const SourceParts parts = PartsOfSource(text);
    CheckComments(parts.comments, faults);
    if (kind == TextKind::kProduct) CheckHelp(text, faults);
    for (const Literal& literal : parts.literals) {
      CheckWords(literal.number, literal.text, faults);
      if (kind == TextKind::kProduct) CheckSentences(literal, faults);
    }
  }
  std::ranges::stable_sort(faults, {}, &LanguageFault::line);
  return faults;
}

std::vector<FileFaults> RepositoryLanguageFaults(const fs::path& root) {
  std::vector<FileFaults> all;
  const auto read = [&](const fs::path& file, TextKind kind) {
    const fs::path name = fs::relative(file, root);
    if (name.parent_path() == "tests/documents" && name.stem().string().starts_with("language_"))
      return;
    auto faults = LanguageFaults(TextOf(file), kind);
    if (!faults.empty()) all.push_back({name, std::move(faults)});
  };
  for (const fs::path& file : SourceFiles(root))
    read(file, fs::relative(file, root).begin()->string() == "tests" ? TextKind::kSource
                                                                     : TextKind::kProduct);
  for (const fs::path& file : ScriptFiles(root)) read(file, TextKind::kScript);
  for (const fs::path& file : DocumentFiles(root)) read(file, TextKind::kDocument);
  return all;
}

}  // namespace arthro::test
