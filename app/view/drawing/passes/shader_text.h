// The GLSL of app/view/shaders, which is embedded into the program when it is built.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace arthro::app {

// Returns the text of a file, such as "backdrop.glsl", after a `#define` for each of `defines`.
// Each line `#include "FILE"` is replaced by that file the first time, and left out after that,
// whether or not an #ifdef hides it. Throws Error(kFile) when there is no such file.
std::string ShaderText(std::string_view file, const std::vector<std::string>& defines = {});

}  // namespace arthro::app
