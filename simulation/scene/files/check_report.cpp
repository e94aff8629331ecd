#include "simulation/scene/files/check_report.h"

#include <nlohmann/json.hpp>

namespace arthro {

std::string JsonFromFindings(const SceneFindings& findings) {
  nlohmann::ordered_json json;
  json["schema"] = "arthroscene.check/1";
  json["status"] = findings.errors.empty() ? "ok" : "refused";
  json["errors"] = findings.errors;
  json["warnings"] = findings.warnings;
  json["hints"] = findings.hints;
  json["found"] = findings.found;
  if (findings.relief) {
    const ReliefShares& relief = *findings.relief;
    json["relief"] = {{"measured", relief.measured},
                      {"brightness", relief.brightness},
                      {"interpolated", relief.interpolated},
                      {"without_origin", relief.without_origin},
                      {"without_sigma", relief.without_sigma}};
    if (relief.median_sigma) json["relief"]["median_sigma"] = *relief.median_sigma;
  }
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace arthro
