#include "app/state/script_record.h"

#include <utility>
#include <variant>

#include <fmt/format.h>

#include "app/platform/script/script.h"
#include "app/state/command.h"
#include "app/state/editor_state.h"

namespace arthro::app {

namespace fs = std::filesystem;

void RecordCommand(ScriptRecord& record, const std::string& id, const std::string& words,
                   const std::vector<std::string>& arguments) {
  if (!record.is_on || id.ends_with("-script")) return;  // the record's own
  std::string line = "do " + ScriptWord(id);
  for (const std::string& argument : arguments) line += " " + ScriptWord(argument);
  record.pending.push_back(std::move(line));
  record.command_words.push_back(words);
}

void RecordFile(ScriptRecord& record, const char* verb, const fs::path& file) {
  if (!record.is_on) return;
  record.pending.push_back(std::string(verb) + " " + ScriptWord(file.string()));
}

void BeginRecord(EditorState& state) {
  state.record = {};
  state.record.is_on = true;
  std::vector<std::string>& lines = state.record.lines;
  lines.push_back("# Session of the editor. `arthroscene run FILE` repeats it.");
  const auto& document = state.document();
  if (!state.history.IsSaved())
    lines.push_back("# The scene had changes that were not saved when the record began.");
  if (!state.on_disk.place.empty()) {
    lines.push_back("do open " + ScriptWord(fs::absolute(state.on_disk.place).string()));
    lines.push_back("wait job");
  } else if (document.panorama == nullptr) {
    lines.push_back("do new");
  } else {
    lines.push_back("# It begins in the demo scene.");
  }
  state.step = Step::kPanorama;
  state.views = {};
  state.tissue = document.scene.tissues.empty() ? -1 : 0;
}

std::string ChooseFile(EditorState& state, const fs::path& file) {
  if (state.dialogs.empty() || !std::holds_alternative<BrowseDialog>(state.dialogs.back()))
    return "there is no file dialog to choose \"" + file.string() + "\" in";
  auto& dialog = std::get<BrowseDialog>(state.dialogs.back());
  FileBrowserModel& model = dialog.model;
  std::error_code ignored;
  const bool opens =
      model.purpose() == BrowseFor::kOpenFile || model.purpose() == BrowseFor::kOpenFileOrFolder;
  fs::path wanted = fs::absolute(file);
  if (opens && fs::is_directory(wanted, ignored) && fs::exists(wanted / "scene.json", ignored))
    wanted /= "scene.json";
  Acceptance acceptance = Acceptance::kNothing;
  if (model.purpose() == BrowseFor::kOpenFileOrFolder && fs::is_directory(wanted, ignored)) {
    model.GoTo(wanted);
    acceptance = model.AcceptFolder();
  } else {
    model.file_name = wanted.string();
    acceptance = model.Accept();
  }
  if (acceptance == Acceptance::kOverwrite) acceptance = model.AcceptOverwrite();
  if (acceptance != Acceptance::kDone)
    return model.problem().empty() ? "\"" + file.string() + "\" is a folder; choose a file"
                                   : model.problem();
  const BrowseDialog taken = std::get<BrowseDialog>(std::move(state.dialogs.back()));
  state.dialogs.pop_back();
  RecordFile(state.record, "choose", taken.model.accepted());
  Guarded(state, taken.title, [&] { taken.then(state, taken.model.accepted()); });
  return "";
}

namespace {

// Why the command is not enabled, as far as that can be told for any of them.
std::string WhyNot(const EditorState& state, const Command& command) {
  if (state.jobs.busy())
    return fmt::format("\"{}\" is still under way; put \"wait job\" on the line before",
                       state.jobs.words());
  if (state.practice)
    return "a practice is under way; \"do leave-practice\" ends it, if it is not one of practice";
  if (*command.needs != '\0') return command.needs;
  if (!HasPicture(state))
    return "the scene has no picture; \"do import-panorama FILE\" gives it one";
  return fmt::format(
      "its work is not there, not chosen, or on a page that is not open. It does this: {}",
      command.help);
}

// Why the dialog that is open stands in the way of a further command.
std::string WordsOf(const Dialog& dialog) {
  if (const auto* error = std::get_if<ErrorDialog>(&dialog))
    return fmt::format("the message that is open: {}", error->sentence);
  if (const auto* guard = std::get_if<GuardDialog>(&dialog))
    return fmt::format(
        "the question that is open: the scene has changes that are not saved; save it before you "
        "{}",
        guard->action);
  return "the dialog that is open";
}

}  // namespace

std::string RunByName(EditorState& state, const std::string& id,
                      const std::vector<std::string>& arguments) {
  for (const Command& command : state.commands) {
    if (id != command.id) continue;
    if (!state.dialogs.empty())
      return fmt::format("\"{}\" waits for {}", id, WordsOf(state.dialogs.back()));
    if (!command.enabled(state))
      return fmt::format("\"{}\" cannot be called now. {}", id, WhyNot(state, command));
    if (!arguments.empty() && command.run_with != nullptr) {
      Run(state, id, arguments);
      if (state.dialogs.empty() || !std::holds_alternative<ErrorDialog>(state.dialogs.back()))
        return "";
      const std::string sentence = std::get<ErrorDialog>(state.dialogs.back()).sentence;
      state.dialogs.pop_back();
      return fmt::format("\"{}\": {}", id, sentence);
    }
    if (arguments.size() > 1) return fmt::format("\"{}\" takes no more than a file", id);
    Run(state, command);
    if (arguments.empty()) return "";
    if (!state.dialogs.empty() && !std::holds_alternative<BrowseDialog>(state.dialogs.back()))
      return fmt::format("\"{}\" waits for {}", id, WordsOf(state.dialogs.back()));
    return ChooseFile(state, arguments.front());
  }
  return fmt::format("there is no command \"{}\"; `arthroscene run --list` names them", id);
}

}  // namespace arthro::app
