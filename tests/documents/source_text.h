// Texts of the repository as the tests of its language see them: files, comments, string literals.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace arthro::test {

std::string TextOf(const std::filesystem::path& file);

// C++ and GLSL sources below app, authoring, simulation and tests, in order of their paths.
std::vector<std::filesystem::path> SourceFiles(const std::filesystem::path& root);

// README, CONTRIBUTING, CHANGELOG and every page of resources/doc.
std::vector<std::filesystem::path> DocumentFiles(const std::filesystem::path& root);

// CMake lists and shell scripts, whose comments begin with #.
std::vector<std::filesystem::path> ScriptFiles(const std::filesystem::path& root);

struct Line {
  int number = 0;  // from 1
  std::string text;
};

// Comment lines that follow one another, without their slashes. A trailing comment opens a comment
// of its own; lines below it that hold nothing but a comment, in the same column, continue it.
struct Comment {
  bool is_trailing = false;
  std::vector<Line> lines;

  std::string Joined() const;
};

// Adjacent literals, joined as the compiler joins them; escapes stay as they are written.
struct Literal {
  int number = 0;  // line of its first quote
  std::string text;
};

struct SourceParts {
  std::vector<Comment> comments;
  std::vector<Literal> literals;  // raw literals are left out: their comments are read instead
};
SourceParts PartsOfSource(std::string_view source);

// Comments of a CMake list or a shell script.
std::vector<Comment> CommentsOfScript(std::string_view script);

}  // namespace arthro::test
