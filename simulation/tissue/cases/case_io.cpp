#include "simulation/tissue/cases/case_io.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/core/json_text.h"
#include "simulation/core/options_json.h"
#include "simulation/scene/json/json_object_reader.h"
#include "simulation/scene/mesh/mesh_io.h"

namespace arthro::simulation {
namespace {

constexpr JsonLimits kMetres{-10, 10, "metres"};
constexpr JsonLimits kNewtons{-1e6, 1e6, "newtons"};
constexpr JsonLimits kNewtonsPerVolume{-1e12, 1e12, "newtons per cubic metre"};

class CaseReader {
 public:
  explicit CaseReader(const std::filesystem::path& file) : file_(file) {}

  TissueCase Read() {
    nlohmann::json json = ParseJson(ReadWholeFile(file_, kMostJsonBytes), Code::kBadData, file_);
    if (!json.is_object()) throw Error(Code::kBadData, "a case must be a JSON object {…}", file_);
    // The material is read through its own list of fields.
    ReadMaterial(json);
    json.erase("material");
    JsonObjectReader root(json, "", faults_);
    std::string mesh;
    root.Text("mesh", mesh, JsonObjectReader::kRequired);
    double order = 0, steps = case_.steps;
    root.Number("order", order, {1, 2}, JsonObjectReader::kRequired);
    if (order != std::floor(order))
      root.Fault("order", fmt::format("is {}; it must be 1 or 2", order));
    std::string mode = "static";
    root.Text("mode", mode);
    if (mode != "static" && mode != "dynamic")
      root.Fault("mode", fmt::format("is \"{}\"; it must be static or dynamic", mode));
    case_.is_dynamic = mode == "dynamic";
    const auto need = case_.is_dynamic ? JsonObjectReader::kRequired : JsonObjectReader::kOptional;
    root.Number("dt", case_.dt, {1e-6, 100, "seconds"}, need);
    root.Number("steps", steps, {1, 1e6}, need);
    if (steps != std::floor(steps))
      root.Fault("steps", fmt::format("is {}; it must be a whole number", steps));
    case_.steps = static_cast<int>(steps);
    root.Number("tolerance", case_.tolerance, {1e-12, 0.5});
    root.Point("body_force", case_.body_force, kNewtonsPerVolume);
    ReadConditions(root);
    std::string schema;
    root.Text("schema", schema);
    root.RefuseOtherKeys(true);
    Refuse();
    ReadMesh(mesh, static_cast<int>(order));
    Refuse();
    return std::move(case_);
  }

 private:
  void ReadConditions(JsonObjectReader& root) {
    root.Array("fixed", [&](JsonObjectReader& one, int) {
      CaseFixed fixed;
      one.Text("set", fixed.set, JsonObjectReader::kRequired);
      std::string axes = "xyz";
      one.Text("axes", axes);
      fixed.axes = 0;
      if (axes.empty()) one.Fault("axes", "is empty; it must be of the letters x, y and z");
      for (const char letter : axes) {
        if (letter < 'x' || letter > 'z') {
          one.Fault("axes", fmt::format("is \"{}\"; it must be of the letters x, y and z", axes));
          break;
        }
        fixed.axes |= static_cast<std::uint8_t>(1 << (letter - 'x'));
      }
      case_.fixed.push_back(fixed);
    });
    root.Array("displaced", [&](JsonObjectReader& one, int) {
      CaseDisplaced displaced;
      one.Text("set", displaced.set, JsonObjectReader::kRequired);
      one.Point("displacement", displaced.displacement, kMetres, JsonObjectReader::kRequired);
      case_.displaced.push_back(displaced);
    });
    root.Array("loads", [&](JsonObjectReader& one, int) {
      CaseLoad load;
      one.Text("set", load.set, JsonObjectReader::kRequired);
      one.Point("total_force", load.total_force, kNewtons, JsonObjectReader::kRequired);
      case_.loads.push_back(load);
    });
  }

  // Checks the material; the elastic constants have no sensible default.
  void ReadMaterial(const nlohmann::json& json) {
    const auto fault = [&](const std::string& key, const std::string& sentence) {
      faults_.push_back({key, key + " " + sentence});
    };
    const auto material = json.find("material");
    if (material == json.end()) return fault("material", "is missing; give {\"model\": …}");
    if (!material->is_object()) return fault("material", "must be an object {…}");
    for (const char* name : {"model", "young_modulus", "poisson_ratio"})
      if (!material->contains(name)) fault(std::string("material.") + name, "is missing; give it");
    if ((json.contains("mode") && json["mode"] == "dynamic") && !material->contains("density"))
      fault("material.density", "is missing; give it in kg/m3");
    try {
      case_.material = OptionsFromJson<Material>(*material);
    } catch (const Error& error) {
      return fault("material:", error.sentence());
    }
    if (case_.material.fibre_stiffness > 0 && case_.material.fibre_axis == FibreAxis::kNone)
      fault("material.fibre_axis", "is missing; fibres with a stiffness need a direction");
  }

  void ReadMesh(const std::string& name, int order) {
    case_.mesh_file = file_.parent_path() / name;
    TetReadReport report;
    case_.mesh = ReadTetMesh(case_.mesh_file, &report);
    case_.messages = report.messages;
    if (case_.mesh.order != order)
      throw Error(Code::kBadData,
                  fmt::format("order is {}, but {} holds elements of order {}; correct one of them",
                              order, name, case_.mesh.order),
                  file_);
    CompleteSets();
    for (std::size_t i = 0; i < case_.fixed.size(); ++i)
      NeedSet(fmt::format("fixed[{}].set", i), case_.fixed[i].set);
    for (std::size_t i = 0; i < case_.displaced.size(); ++i)
      NeedSet(fmt::format("displaced[{}].set", i), case_.displaced[i].set);
    for (std::size_t i = 0; i < case_.loads.size(); ++i)
      NeedSet(fmt::format("loads[{}].set", i), case_.loads[i].set);
    if (!case_.is_dynamic && case_.fixed.empty() && case_.displaced.empty())
      faults_.push_back({"fixed",
                         "fixed is empty: nothing holds the body, so that it has no equilibrium; "
                         "name a set to hold"});
    if (!faults_.empty()) return;
    RefuseConflicts();
    if (!case_.is_dynamic) RequireHeld();
  }

  // Refuses nodes that are both fixed and displaced, or displaced to two places.
  void RefuseConflicts() {
    const auto shared = [&](const std::string& a, const std::string& b) {
      int count = 0;
      for (std::size_t i = 0; i < case_.mesh.rest_positions.size(); ++i)
        count += case_.mesh.sets[a][i] && case_.mesh.sets[b][i] ? 1 : 0;
      return count;
    };
    const auto refuse = [&](std::size_t i, const std::string& other, const std::string& will) {
      const int nodes = shared(case_.displaced[i].set, other);
      if (nodes == 0) return;
      const std::string key = fmt::format("displaced[{}].set", i);
      faults_.push_back({key, fmt::format("{} \"{}\" has {} nodes that {}; take them out of one of "
                                          "the two",
                                          key, case_.displaced[i].set, nodes, will)});
    };
    for (std::size_t i = 0; i < case_.displaced.size(); ++i) {
      for (std::size_t j = 0; j < case_.fixed.size(); ++j)
        refuse(i, case_.fixed[j].set,
               fmt::format("fixed[{}] \"{}\" holds where they are", j, case_.fixed[j].set));
      for (std::size_t j = 0; j < i; ++j)
        if (case_.displaced[j].displacement != case_.displaced[i].displacement)
          refuse(i, case_.displaced[j].set,
                 fmt::format("displaced[{}] \"{}\" leads elsewhere", j, case_.displaced[j].set));
    }
  }

  // Checks that the fixed axes stop all six rigid motions; otherwise no load has an equilibrium.
  void RequireHeld() {
    const std::vector<glm::dvec3>& rest = case_.mesh.rest_positions;
    std::vector<std::uint8_t> axes(rest.size(), 0);
    for (const CaseFixed& one : case_.fixed)
      for (std::size_t i = 0; i < rest.size(); ++i)
        if (case_.mesh.sets[one.set][i]) axes[i] |= one.axes;
    for (const CaseDisplaced& one : case_.displaced)
      for (std::size_t i = 0; i < rest.size(); ++i)
        if (case_.mesh.sets[one.set][i]) axes[i] = 7;
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& x : rest) middle += x / static_cast<double>(rest.size());
    double size = 0;
    for (const glm::dvec3& x : rest) size = std::max(size, glm::distance(x, middle));

    // Sums the response of the fixed axes to three translations and three rotations about the
    // centre.
    Eigen::Matrix<double, 6, 6> seen = Eigen::Matrix<double, 6, 6>::Zero();
    std::string open = "xyz";
    for (std::size_t i = 0; i < rest.size(); ++i)
      for (int a = 0; a < 3; ++a) {
        if ((axes[i] >> a & 1) == 0) continue;
        std::erase(open, static_cast<char>('x' + a));
        glm::dvec3 along(0.0);
        along[a] = 1.0;
        const glm::dvec3 turn = glm::cross((rest[i] - middle) / size, along);
        Eigen::Matrix<double, 6, 1> row;
        row << along.x, along.y, along.z, turn.x, turn.y, turn.z;
        seen += row * row.transpose();
      }
    if (!open.empty())
      return faults_.push_back(
          {"fixed", fmt::format("fixed holds the body nowhere along {}, so that it has no "
                                "equilibrium; hold a set along {} too",
                                fmt::join(open, " and "), open.size() > 1 ? "these" : "it")});
    constexpr double kLeast = 1e-9;  // relative to the largest eigenvalue; rounding leaves 1e-15
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> motions(
        seen, Eigen::EigenvaluesOnly);
    if (motions.eigenvalues()[0] < kLeast * motions.eigenvalues()[5])
      faults_.push_back({"fixed",
                         "fixed lets the body turn, so that it has no equilibrium; hold it at "
                         "three points that are not on one line, or along more axes"});
  }

  // Adds mid-edge nodes whose two ends are in the set. Marked middles stay: reference meshes mark
  // edges that run from one fixed set into another.
  void CompleteSets() {
    if (case_.mesh.order != 2) return;
    constexpr int kEnds[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    for (auto& [name, member] : case_.mesh.sets)
      for (std::size_t e = 0; e < case_.mesh.elements.size(); e += 10)
        for (int k = 0; k < 6; ++k)
          if (member[case_.mesh.elements[e + kEnds[k][0]]] &&
              member[case_.mesh.elements[e + kEnds[k][1]]])
            member[case_.mesh.elements[e + 4 + k]] = 1;
  }

  void NeedSet(const std::string& key, const std::string& name) {
    const auto set = case_.mesh.sets.find(name);
    std::vector<std::string> known;
    for (const auto& [other, member] : case_.mesh.sets) known.push_back(other);
    if (set == case_.mesh.sets.end())
      faults_.push_back(
          {key,
           fmt::format("{} is \"{}\", which is no point array of the mesh; it has {}", key, name,
                       known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")))});
    else if (std::none_of(set->second.begin(), set->second.end(), [](auto m) { return m != 0; }))
      faults_.push_back(
          {key, fmt::format("{} is \"{}\", a set without a node; mark its nodes with 1 in the mesh",
                            key, name)});
  }

  void Refuse() const {
    if (faults_.empty()) return;
    std::string all;
    for (const JsonFault& fault : faults_) all += (all.empty() ? "" : "; ") + fault.sentence;
    throw Error(Code::kBadData, all, file_);
  }

  std::filesystem::path file_;
  std::vector<JsonFault> faults_;
  TissueCase case_;
};

nlohmann::ordered_json Numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

nlohmann::ordered_json JsonFromSets(const SetResults& sets) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [name, set] : sets)
    json[name] = {{"mean_displacement", Numbers(set.mean_displacement)},
                  {"reaction", Numbers(set.reaction)}};
  return json;
}

}  // namespace

TissueCase ReadCase(const std::filesystem::path& file) { return CaseReader(file).Read(); }

std::string JsonFromResult(const CaseResult& result) {
  nlohmann::ordered_json json;
  json["schema"] = "arthroscene.solve/1";
  json["converged"] = result.converged;
  json["residual"] = result.residual;
  json["iterations"] = result.iterations;
  json["linear_iterations"] = result.linear_iterations;
  json["wall_ms"] = result.wall_ms;
  json["sets"] = JsonFromSets(result.sets);
  json["energy"] = result.energy;
  json["inverted_elements"] = result.inverted_elements;
  json["used_fallback"] = result.used_fallback;
  json["history"] = nlohmann::ordered_json::array();
  for (const CaseMoment& moment : result.history)
    json["history"].push_back(
        {{"t", moment.t}, {"wall_ms", moment.wall_ms}, {"sets", JsonFromSets(moment.sets)}});
  return json.dump(2) + "\n";
}

}  // namespace arthro::simulation
