#include "app/view/drawing/passes/steady_inputs.h"

#include <sstream>

#include <fmt/format.h>

namespace arthro::app {

SteadyInputs TakeSteadyInputs(const std::string& fragment) {
  SteadyInputs inputs;
  std::string body;
  std::istringstream lines(fragment);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string steady, type, name;
    if (!(words >> steady >> type) || steady != "steady") {
      inputs.fragment += line + "\n";
      // Directives around the inputs of a variant hold for the vertex shader too.
      if (line.starts_with('#'))
        for (std::string* text : {&inputs.uniforms, &inputs.outputs, &body}) *text += line + "\n";
      continue;
    }
    for (bool is_last = false; !is_last && words >> name;) {
      is_last = name.back() == ';';
      name.pop_back();  // or its comma
      inputs.fragment += fmt::format("flat in {} {};\n", type, name);
      inputs.uniforms += fmt::format("uniform {} given_{};\n", type, name);
      inputs.outputs += fmt::format("flat out {} {};\n", type, name);
      name = name.substr(0, name.find('['));
      body += fmt::format("  {0} = given_{0};\n", name);
    }
  }
  inputs.outputs += "void handOn() {\n" + body + "}\n";
  return inputs;
}

}  // namespace arthro::app
