#include "app/cli/practice/window_flags.h"

#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/editor/editor.h"

namespace arthro::app {
namespace {

// One flag per setting; a flag that is not given leaves what the user has set.
struct LookVisitor {
  CLI::App& job;
  EditorOptions& options;
  const char* otherwise;

  template <class T>
  void operator()(const char* name, T&, const Choices<T>& choices, const char*, const char* help) {
    std::string flag = "--" + std::string(name);
    std::replace(flag.begin(), flag.end(), '_', '-');
    std::vector<std::string> words;
    for (const auto& [value, word] : choices.words) words.push_back(word);
    EditorOptions* const target = &options;
    job.add_option_function<std::string>(
           flag,
           [target, field = std::string(name)](const std::string& word) {
             target->look[field] = word;
           },
           fmt::format("{} {}", help, otherwise))
        ->check(CLI::IsMember(words))
        ->group("Window");
  }
};

}  // namespace

void AddLookFlags(CLI::App& job, EditorOptions& options, const char* otherwise) {
  WindowSettings().Visit(LookVisitor{job, options, otherwise});
}

}  // namespace arthro::app
