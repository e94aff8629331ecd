#include "app/platform/script/script.h"

#include <cctype>
#include <charconv>
#include <map>
#include <optional>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

[[noreturn]] void Refuse(int line, const std::string& what, const std::filesystem::path& file) {
  throw Error(Code::kBadData, fmt::format("script line {}: {}", line, what), file);
}

// Words of a line; quotes keep blanks, \" and \\ inside them stand for themselves.
std::optional<std::vector<std::string>> Words(std::string_view line) {
  std::vector<std::string> words;
  std::size_t i = 0;
  while (i < line.size()) {
    if (std::isspace(static_cast<unsigned char>(line[i]))) {
      ++i;
    } else if (line[i] == '#') {
      break;
    } else if (line[i] == '"') {
      std::string word;
      for (++i; i < line.size() && line[i] != '"'; ++i) {
        if (line[i] == '\\' && i + 1 < line.size()) ++i;
        word += line[i];
      }
      if (i == line.size()) return std::nullopt;
      ++i;
      words.push_back(word);
    } else {
      std::string word;
      while (i < line.size() && !std::isspace(static_cast<unsigned char>(line[i])))
        word += line[i++];
      words.push_back(word);
    }
  }
  return words;
}

std::optional<double> Number(const std::string& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

ScriptLine LineFromWords(const std::vector<std::string>& words, int number,
                         const std::filesystem::path& file) {
  ScriptLine line;
  line.number = number;
  const std::string& verb = words[0];
  const auto want = [&](std::size_t count, const char* form) {
    if (words.size() != count) Refuse(number, fmt::format("write it as: {}", form), file);
  };
  const auto number_at = [&](std::size_t index) {
    const auto value = Number(words[index]);
    if (!value) Refuse(number, fmt::format("\"{}\" is not a number", words[index]), file);
    return *value;
  };
  // Numbers and the words for buttons and keys, in any order.
  const auto read_tail = [&](std::size_t first, ScriptLine& into, const char* form) {
    for (std::size_t i = first; i < words.size(); ++i) {
      const std::string& word = words[i];
      if (word == "right" || word == "middle")
        into.button = word == "right" ? 1 : 2;
      else if (word == "shift")
        into.shift = true;
      else if (word == "ctrl")
        into.ctrl = true;
      else if (const auto value = Number(word))
        into.numbers.push_back(*value);
      else
        want(0, form);
    }
  };
  const std::map<std::string, ScriptVerb> of_item = {{"click", ScriptVerb::kClick},
                                                     {"double-click", ScriptVerb::kDoubleClick},
                                                     {"right-click", ScriptVerb::kRightClick},
                                                     {"hover", ScriptVerb::kHover}};
  const std::map<std::string, ScriptVerb> of_text = {{"type", ScriptVerb::kType},
                                                     {"shot", ScriptVerb::kShot},
                                                     {"shot-trainee", ScriptVerb::kShotTrainee},
                                                     {"mark", ScriptVerb::kMark},
                                                     {"choose", ScriptVerb::kChoose},
                                                     {"drop", ScriptVerb::kDrop}};
  const std::map<std::string, ScriptVerb> alone = {
      {"close", ScriptVerb::kClose}, {"quit", ScriptVerb::kQuit}, {"walk", ScriptVerb::kWalk}};
  if (const auto item = of_item.find(verb); item != of_item.end()) {
    if (words.size() != 4) want(2, (verb + " NAME [DX DY]").c_str());
    line.verb = item->second;
    line.name = words[1];
    if (words.size() == 4) line.x = number_at(2), line.y = number_at(3);
  } else if (const auto text = of_text.find(verb); text != of_text.end()) {
    want(2, (verb + " TEXT").c_str());
    line.verb = text->second;
    line.text = words[1];
  } else if (const auto single = alone.find(verb); single != alone.end()) {
    want(1, verb.c_str());
    line.verb = single->second;
  } else if (verb == "drag") {
    line.right_button = words.size() == 5 && words[4] == "right";
    if (!line.right_button) want(4, "drag NAME DX DY [right]");
    line.verb = ScriptVerb::kDrag;
    line.name = words[1];
    line.x = number_at(2), line.y = number_at(3);
  } else if (verb == "wheel") {
    constexpr const char* kForm = "wheel NAME NOTCHES [DX DY] [shift] [ctrl]";
    if (words.size() < 3) want(3, kForm);
    line.verb = ScriptVerb::kWheel;
    line.name = words[1];
    line.y = number_at(2);
    read_tail(3, line, kForm);
    if (line.numbers.size() > 2 || line.numbers.size() == 1 || line.button != 0) want(0, kForm);
  } else if (verb == "stroke") {
    constexpr const char* kForm = "stroke NAME [right|middle] [shift] [ctrl] X Y X Y …";
    if (words.size() < 4) want(0, kForm);
    line.verb = ScriptVerb::kStroke;
    line.name = words[1];
    read_tail(2, line, kForm);
    if (line.numbers.empty() || line.numbers.size() % 2 != 0) want(0, kForm);
  } else if (verb == "do") {
    if (words.size() < 2) want(2, "do COMMAND [FILE | ARGUMENTS]");
    line.verb = ScriptVerb::kDo;
    line.name = words[1];
    line.arguments.assign(words.begin() + 2, words.end());
  } else if (verb == "pose") {
    constexpr const char* kForm = "pose scope|instrument DEPTH LATITUDE LONGITUDE ROLL";
    want(6, kForm);
    line.verb = ScriptVerb::kPose;
    line.name = words[1];
    if (line.name != "scope" && line.name != "instrument") want(0, kForm);
    read_tail(2, line, kForm);
    if (line.numbers.size() != 4) want(0, kForm);
  } else if (verb == "resize" || verb == "crawl") {
    want(3, verb == "resize" ? "resize WIDTH HEIGHT" : "crawl SEED ACTIONS");
    line.verb = verb == "resize" ? ScriptVerb::kResize : ScriptVerb::kCrawl;
    line.x = number_at(1), line.y = number_at(2);
    if (!(line.x >= 1 && line.y >= 1 && line.x <= 1e6 && line.y <= 1e6))
      Refuse(number, fmt::format("write two numbers from 1 to 1000000 after {}", verb), file);
  } else if (verb == "key" || verb == "hold") {
    want(verb == "key" ? 2 : 3, verb == "key" ? "key ctrl+s" : "hold KEY FRAMES");
    line.verb = verb == "key" ? ScriptVerb::kKey : ScriptVerb::kHold;
    line.text = words[1];
    KeysFromWords(line.text);  // so that a wrong name is told before the window opens
    if (verb == "hold") line.x = number_at(2);
  } else if (verb == "set") {
    want(3, "set NAME VALUE");
    line.verb = ScriptVerb::kSet;
    line.name = words[1], line.text = words[2];
  } else if (verb == "wait" && words.size() == 2 && words[1] == "job") {
    line.verb = ScriptVerb::kWaitJob;
  } else if (verb == "wait") {
    want(3, "wait frames N, or wait job");
    line.verb = ScriptVerb::kWaitFrames;
    line.x = number_at(2);
  } else if (verb == "expect" && words.size() >= 2 && words[1] == "translated") {
    line.verb = ScriptVerb::kExpectTranslated;
    for (std::size_t i = 2; i < words.size(); ++i) line.text += words[i] + '\n';
  } else if (verb == "expect" && words.size() == 2 && words[1] == "tips") {
    line.verb = ScriptVerb::kExpectTips;
  } else if (verb == "expect" && words.size() == 2 && words[1] == "layout") {
    line.verb = ScriptVerb::kExpectLayout;
  } else if (verb == "expect" && words.size() == 2) {
    line.verb = ScriptVerb::kExpect;
    line.text = words[1];
  } else if (verb == "expect" && words.size() == 3) {
    line.verb = words[1] == "not"        ? ScriptVerb::kExpectNot
                : words[1] == "enabled"  ? ScriptVerb::kExpectEnabled
                : words[1] == "disabled" ? ScriptVerb::kExpectDisabled
                : words[1] == "focus"    ? ScriptVerb::kExpectFocus
                                         : ScriptVerb::kExpect;
    if (line.verb == ScriptVerb::kExpect)
      Refuse(number, "write it as: expect [not] TEXT, or expect enabled|disabled NAME", file);
    (line.verb == ScriptVerb::kExpectNot ? line.text : line.name) = words[2];
  } else if (verb == "expect") {
    want(4, "expect value NAME TEXT");
    line.verb = ScriptVerb::kExpectValue;
    line.name = words[2], line.text = words[3];
  } else {
    Refuse(number, fmt::format("\"{}\" is not an action; see app/platform/script/script.h", verb),
           file);
  }
  return line;
}

}  // namespace

std::vector<ScriptLine> ParseScript(std::string_view text, const std::filesystem::path& file) {
  std::vector<ScriptLine> lines;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const auto words = Words(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (!words) Refuse(number, "a quote is not closed", file);
    if (!words->empty()) lines.push_back(LineFromWords(*words, number, file));
  }
  return lines;
}

std::string ScriptWord(std::string_view text) {
  const bool is_plain =
      !text.empty() && text.find_first_of(" \t\r\n\"\\#") == std::string_view::npos;
  if (is_plain) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '\n' ? ' ' : c;
  }
  return quoted + "\"";
}

std::vector<int> KeysFromWords(std::string_view words) {
  static const std::map<std::string, int, std::less<>> kNames = {{"ctrl", GLFW_KEY_LEFT_CONTROL},
                                                                 {"shift", GLFW_KEY_LEFT_SHIFT},
                                                                 {"alt", GLFW_KEY_LEFT_ALT},
                                                                 {"enter", GLFW_KEY_ENTER},
                                                                 {"escape", GLFW_KEY_ESCAPE},
                                                                 {"tab", GLFW_KEY_TAB},
                                                                 {"space", GLFW_KEY_SPACE},
                                                                 {"backspace", GLFW_KEY_BACKSPACE},
                                                                 {"delete", GLFW_KEY_DELETE},
                                                                 {"home", GLFW_KEY_HOME},
                                                                 {"end", GLFW_KEY_END},
                                                                 {"pageup", GLFW_KEY_PAGE_UP},
                                                                 {"pagedown", GLFW_KEY_PAGE_DOWN},
                                                                 {"left", GLFW_KEY_LEFT},
                                                                 {"right", GLFW_KEY_RIGHT},
                                                                 {"up", GLFW_KEY_UP},
                                                                 {"down", GLFW_KEY_DOWN},
                                                                 {"?", GLFW_KEY_SLASH},
                                                                 {",", GLFW_KEY_COMMA}};
  std::vector<int> keys;
  for (std::string_view rest = words; !rest.empty();) {
    const std::size_t end = std::min(rest.find('+'), rest.size());
    const std::string_view word = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    int function = 0;
    if (const auto name = kNames.find(word); name != kNames.end()) {
      keys.push_back(name->second);
    } else if (word.size() == 1 && std::isalnum(static_cast<unsigned char>(word[0]))) {
      keys.push_back(std::toupper(static_cast<unsigned char>(word[0])));  // key numbers of GLFW
    } else if (word.size() >= 2 && word[0] == 'f' &&
               std::from_chars(word.data() + 1, word.data() + word.size(), function).ec ==
                   std::errc() &&
               function >= 1 && function <= 12) {
      keys.push_back(GLFW_KEY_F1 + function - 1);
    } else {
      throw Error(Code::kBadData, fmt::format("\"{}\" is not a key that a script knows", word));
    }
  }
  if (keys.empty()) throw Error(Code::kBadData, "a key needs a name, such as ctrl+z");
  return keys;
}

}  // namespace arthro::app
