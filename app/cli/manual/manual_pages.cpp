#include "app/cli/manual/manual_pages.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace arthro::app {
namespace {

// Plain text as roff shows it. A hyphen is written as one, so that a flag can be copied.
std::string Roff(std::string_view text) {
  std::string roff;
  bool is_line_start = true;
  for (const char c : text) {
    if (is_line_start && (c == '.' || c == '\'')) roff += "\\&";
    is_line_start = c == '\n';
    if (c == '\\')
      roff += "\\e";
    else if (c == '-')
      roff += "\\-";
    else
      roff += c;
  }
  return roff;
}

std::string Upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'a' && c <= 'z' ? c - 'a' + 'A' : c);
  });
  return text;
}

std::vector<const CLI::Option*> ShownOptions(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

// Leaves out hidden jobs, which the program starts itself.
std::vector<const CLI::App*> Jobs(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App* job) { return !job->get_group().empty(); });
}

// Names and value: "-o, --output FILE".
std::string NamesOf(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "-" : ", -") + name;
  for (const std::string& name : option.get_lnames())
    names += (names.empty() ? "--" : ", --") + name;
  if (option.get_positional()) names = option.get_name(true, false);
  std::string shown = "\\fB" + Roff(names) + "\\fR";
  const bool takes_value = option.get_items_expected_max() > 0;
  if (takes_value && !option.get_positional() && !option.get_type_name().empty())
    shown += " \\fI" + Roff(option.get_type_name()) + "\\fR";
  return shown;
}

std::string OptionList(const CLI::App& app, bool is_positional) {
  std::string list;
  for (const CLI::Option* option : ShownOptions(app)) {
    if (option->get_positional() != is_positional) continue;
    std::string words = option->get_description();
    if (!option->get_default_str().empty())
      words += fmt::format("{}Default: {}.", words.empty() ? "" : " ", option->get_default_str());
    list += fmt::format(".TP\n{}\n{}\n", NamesOf(*option), Roff(words));
  }
  return list;
}

std::string Head(const std::string& name, const std::string& version, const std::string& words) {
  return fmt::format(
      ".TH {} 1 \"\" \"arthroscene {}\" \"Arthroscene\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n",
      Upper(Roff(name)), Roff(version), Roff(name), Roff(words));
}

std::string ExitCodes() {
  return ".SH EXIT STATUS\n"
         ".TP\n0\nThe job is done.\n"
         ".TP\n1\nThe job is refused. One sentence on the error stream says what is wrong, where, "
         "and what to do.\n"
         ".TP\n2\nThe line is no valid call.\n";
}

std::string PageOfJob(const CLI::App& job, const std::string& version) {
  const std::string name = "arthroscene-" + job.get_name();
  std::string page = Head(name, version, job.get_description());
  page += fmt::format(".B arthroscene {}\n", Roff(job.get_name()));
  for (const CLI::Option* option : ShownOptions(job))
    if (option->get_positional())
      page += fmt::format(".RI {} \" \"\n", Roff(option->get_name(true, false)));
  page += ".RI [ options ]\n";
  page += ".SH DESCRIPTION\n" + Roff(job.get_description()) + "\n";
  if (const std::string list = OptionList(job, true); !list.empty())
    page += ".SH ARGUMENTS\n" + list;
  page += ".SH OPTIONS\n" + OptionList(job, false);
  if (!job.get_footer().empty()) page += ".SH NOTES\n" + Roff(job.get_footer()) + "\n";
  return page + ExitCodes() + ".SH SEE ALSO\n.BR arthroscene (1)\n";
}

std::string PageOfProgram(const CLI::App& program, const std::string& version) {
  std::string page = Head("arthroscene", version, program.get_description());
  page += ".B arthroscene\n.I job\n.RI [ options ]\n.SH DESCRIPTION\n";
  page +=
      "An educator makes scenes from surgical video, and a trainee practises in them. Every job "
      "runs without a window, except those that open one.\n";
  page += ".SH JOBS\n";
  for (const CLI::App* job : Jobs(program))
    page += fmt::format(".TP\n.BR arthroscene\\-{} (1)\n{}\n", Roff(job->get_name()),
                        Roff(job->get_description()));
  page += ".SH OPTIONS\n" + OptionList(program, false) + ExitCodes();
  page +=
      ".SH FILES\n.TP\n\\fI~/.local/state/arthroscene/recovery\\fR\nCopies of unsaved work, "
      "offered at the next start after a crash.\n";
  return page;
}

}  // namespace

std::map<std::string, std::string> ManualPages(const CLI::App& program,
                                               const std::string& version) {
  std::map<std::string, std::string> pages{{"arthroscene.1", PageOfProgram(program, version)}};
  for (const CLI::App* job : Jobs(program))
    pages["arthroscene-" + job->get_name() + ".1"] = PageOfJob(*job, version);
  return pages;
}

std::string BashCompletion(const CLI::App& program) {
  std::string jobs, cases;
  for (const CLI::App* job : Jobs(program)) {
    jobs += (jobs.empty() ? "" : " ") + job->get_name();
    std::string flags;
    for (const CLI::Option* option : ShownOptions(*job))
      for (const std::string& name : option->get_lnames())
        flags += (flags.empty() ? "--" : " --") + name;
    cases += fmt::format("    {}) flags='{}' ;;\n", job->get_name(), flags);
  }
  return fmt::format(
      R"(# Completion of arthroscene for bash: jobs, flags, files.
_arthroscene() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} flags=
  if [ "$COMP_CWORD" = 1 ]; then
    COMPREPLY=($(compgen -W '{} --help --help-all --version' -- "$word"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$flags" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -o filenames -F _arthroscene arthroscene
)",
      jobs, cases);
}

}  // namespace arthro::app
