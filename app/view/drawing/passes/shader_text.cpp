#include "app/view/drawing/passes/shader_text.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

constexpr std::pair<std::string_view, std::string_view> kFiles[] = {
#include "embedded_shaders.inc"
};

// Definitions by which GLSL reads constants.inc.
constexpr std::string_view kMacros =
    "#define CONSTANT(name, value) const float name = value;\n"
    "#define COUNT(name, value) const int name = value;\n";

void Append(std::string_view file, std::string& text, std::set<std::string, std::less<>>& taken) {
  constexpr std::string_view kInclude = "#include \"";
  if (!taken.emplace(file).second) return;
  const auto* found =
      std::ranges::find(kFiles, file, &std::pair<std::string_view, std::string_view>::first);
  if (found == std::end(kFiles))
    throw Error(Code::kFile, "there is no shader " + std::string(file) + " in this program");
  std::istringstream lines{std::string(found->second)};
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(kInclude))
      Append(std::string_view(line).substr(kInclude.size(), line.rfind('"') - kInclude.size()),
             text, taken);
    else
      text += line + "\n";
  }
}

}  // namespace

std::string ShaderText(std::string_view file, const std::vector<std::string>& defines) {
  std::string text(kMacros);
  for (const std::string& define : defines) text += "#define " + define + "\n";
  std::set<std::string, std::less<>> taken;
  Append(file, text, taken);
  return text;
}

}  // namespace arthro::app
