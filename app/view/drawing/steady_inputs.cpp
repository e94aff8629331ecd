#include "app/view/drawing/steady_inputs.h"

#include <sstream>

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
      inputs.fragment += "flat in " + type + " " + name + ";\n";
      inputs.uniforms += "uniform " + type + " given_" + name + ";\n";
      inputs.outputs += "flat out " + type + " " + name + ";\n";
      name = name.substr(0, name.find('['));
      body += "  " + name + " = given_" + name + ";\n";
    }
  }
  inputs.outputs += "void handOn() {\n" + body + "}\n";
  return inputs;
}

}  // namespace arthro::app
