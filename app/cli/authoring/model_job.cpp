// arthroscene model KIND -o model.ply: a structure of the knee from its published sizes, torn if
// asked for, as a surface or as a tissue of a scene.
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/steps/tissue/library/torn_surface.h"
#include "authoring/models/meniscus_tear.h"
#include "authoring/models/model_in_scene.h"
#include "authoring/models/model_library.h"
#include "authoring/models/model_report.h"
#include "authoring/project/document_io.h"
#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/folders/temporary_folder.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/mesh/mesh_io.h"

namespace arthro::app {
namespace {

using authoring::KneeSide;
using authoring::LibraryModel;

struct ModelArguments {
  std::string kind, side = "right", tear, output, report, scene, save_scene, budget = "default";
  std::map<std::string, double> sizes;  // value per field, in memory's unit
  std::map<std::string, double> tear_sizes;
  std::vector<double> towards{0, 0};  // degrees of latitude and longitude
};

// Fields of the options of all kinds under one name.
struct SharedField {
  std::string unit, help, kinds;
  Range range{0, 0};
  bool is_whole = false;
};

struct FieldCollector {
  const std::string& kind;
  std::map<std::string, SharedField>& fields;

  template <class T, class Rule>
  void operator()(const char* name, T& value, const Rule& rule, const char* unit,
                  const char* help) const {
    if constexpr (std::is_same_v<Rule, Range> && !std::is_enum_v<T>) {
      const double factor = PersonBorder(unit).factor;
      auto [entry, is_new] = fields.try_emplace(name);
      SharedField& field = entry->second;
      if (is_new) field = {unit, help, "", rule, std::is_same_v<T, int>};
      field.range.min = std::min(field.range.min, rule.min);
      field.range.max = std::max(field.range.max, rule.max);
      field.kinds += fmt::format("{}{} {:.4g} to {:.4g}, {:.4g}", field.kinds.empty() ? "" : "; ",
                                 kind, rule.min * factor, rule.max * factor, value * factor);
    }
  }
};

// Sets the fields that were given, and takes them off the list.
struct FieldSetter {
  std::map<std::string, double>& given;

  template <class T, class Rule>
  void operator()(const char* name, T& value, const Rule&, const char*, const char*) const {
    if constexpr (std::is_arithmetic_v<T>) {
      const auto entry = given.find(name);
      if (entry == given.end()) return;
      value = static_cast<T>(entry->second);
      given.erase(entry);
    }
  }
};

std::string FlagOf(const std::string& field, const std::string& unit) {
  std::string flag = "--" + field + PersonBorder(unit).suffix;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

void AddFields(CLI::App& job, const std::map<std::string, SharedField>& fields,
               std::map<std::string, double>& target, const char* group) {
  for (const auto& [name, field] : fields) {
    const double factor = PersonBorder(field.unit).factor;
    AddNumberOption(job, FlagOf(name, field.unit),
                    {{Shown(field.range.min * factor), Shown(field.range.max * factor)},
                     UnitShown(field.unit),
                     field.is_whole},
                    field.kinds.empty() ? field.help : field.help + " [" + field.kinds + "]",
                    [&target, key = name, factor](double shown) { target[key] = shown / factor; })
        ->group(group);
  }
}

const authoring::ModelEntry& EntryOf(const std::string& word) {
  for (const authoring::ModelEntry& entry : authoring::ModelEntries())
    if (entry.word == word) return entry;
  throw Error(Code::kBadArgument, "\"" + word + "\" is no model of the library");
}

authoring::ModelOptions OptionsOf(const ModelArguments& arguments) {
  authoring::ModelOptions options = authoring::DefaultOptionsOf(EntryOf(arguments.kind).kind);
  std::map<std::string, double> given = arguments.sizes;
  std::visit([&](auto& chosen) { chosen.Visit(FieldSetter{given}); }, options);
  if (!given.empty())
    throw Error(Code::kBadArgument,
                fmt::format("{} is no size of {}; `arthroscene model --help` lists which kind has "
                            "which",
                            FlagOf(given.begin()->first, ""), arguments.kind));
  return options;
}

// The tear that was asked for; nothing where there is none.
std::optional<authoring::TearOptions> TearOf(const ModelArguments& arguments) {
  if (arguments.tear.empty()) {
    if (!arguments.tear_sizes.empty())
      throw Error(Code::kBadArgument,
                  "a size of a tear is given but no tear; name its kind with --tear");
    return std::nullopt;
  }
  if (!authoring::IsMeniscus(EntryOf(arguments.kind).kind))
    throw Error(Code::kBadArgument,
                fmt::format("only a meniscus is torn; leave out --tear, or choose medial-meniscus "
                            "or lateral-meniscus instead of {}",
                            arguments.kind));
  for (const authoring::TearEntry& entry : authoring::TearEntries())
    if (entry.word == arguments.tear) {
      authoring::TearOptions tear(entry.kind);
      std::map<std::string, double> given = arguments.tear_sizes;
      tear.Visit(FieldSetter{given});
      if (tear.displacement > 0 && tear.kind != authoring::TearKind::kBucketHandle)
        throw Error(Code::kBadArgument,
                    "only the handle of a bucket-handle tear is displaced; leave out "
                    "--tear-displacement-mm");
      return tear;
    }
  throw Error(Code::kBadArgument, "\"" + arguments.tear + "\" is no kind of tear");
}

void SaveInScene(const ModelArguments& arguments, const LibraryModel& model,
                 const std::vector<Cut>& cuts, const Progress& progress) {
  authoring::Document document = authoring::OpenDocument(arguments.scene);
  const double latitude = RadiansFromDegrees(arguments.towards[0]);
  const double longitude = RadiansFromDegrees(arguments.towards[1]);
  const glm::dvec3 direction(std::cos(latitude) * std::sin(longitude), -std::sin(latitude),
                             std::cos(latitude) * std::cos(longitude));
  const Pose pose = authoring::PoseOnRelief(model, document, glm::dvec3(0), direction);
  const TemporaryFolder folder;
  std::filesystem::path mesh;
  // Thin layers and solids need no tetrahedra.
  if (!model.is_solid && model.material != "cartilage") {
    authoring::MeshWish wish;
    for (const authoring::MeshBudget& budget : authoring::MeshBudgets())
      if (budget.name == arguments.budget) wish.elements = budget.elements;
    wish.fixed = model.fixed;
    authoring::SurfaceSource source;
    source.file = model.name;
    mesh = folder.path() / "model.vtu";
    WriteTetMesh(mesh,
                 authoring::TetrahedralizeToBudget(model.surface, source, wish, nullptr, progress));
  }
  authoring::AddModel(document, model, pose, cuts, mesh);
  authoring::SaveDocument(document, arguments.save_scene);
}

void RunJob(const ModelArguments& arguments) {
  if (arguments.output.empty() && arguments.save_scene.empty())
    throw Error(Code::kBadArgument,
                "nothing would be written; give -o, or --scene and --save-scene");
  if (arguments.scene.empty() != arguments.save_scene.empty())
    throw Error(Code::kBadArgument,
                "--scene says which scene the model is added to and --save-scene where the result "
                "goes; give both");
  const KneeSide side = arguments.side == "left" ? KneeSide::kLeft : KneeSide::kRight;
  const authoring::ModelOptions options = OptionsOf(arguments);
  const LibraryModel model = authoring::MakeModel(options, side);
  const std::optional<authoring::TearOptions> tear = TearOf(arguments);
  std::vector<Cut> cuts;
  if (tear) cuts = authoring::TearCuts(model.surface, *tear);
  const bool is_displaced = tear && tear->displacement > 0;
  double removed = 0;
  SurfaceMesh torn;
  if (is_displaced)
    torn = DisplacedHandle(model.surface, *tear, model.fixed, &removed, TerminalProgress());
  else if (tear)
    torn = TornSurface(model.surface, cuts, model.fixed, &removed);
  if (!arguments.save_scene.empty()) {
    // A displaced handle is another shape; its slot is part of that.
    LibraryModel in_scene = model;
    if (is_displaced) in_scene.surface = torn;
    SaveInScene(arguments, in_scene, is_displaced ? std::vector<Cut>() : cuts, TerminalProgress());
  }
  if (!arguments.output.empty()) {
    SurfaceLabels labels;
    if (cuts.empty() && !model.zones.of_vertex.empty())
      labels = {{"third", model.thirds.of_vertex}, {"zone", model.zones.of_vertex}};
    WriteSurface(arguments.output, cuts.empty() ? model.surface : torn, labels);
  }
  if (!arguments.report.empty())
    WriteAtomically(arguments.report,
                    authoring::ModelReportText(model, options, side, cuts, removed));
  for (const authoring::MeasuredSize& size : model.sizes)
    fmt::print(arguments.report == "-" ? stderr : stdout,
               "{}: {:.1f} mm, published {:.1f} to {:.1f} mm ({})\n", size.published->quantity,
               MmFromMetres(size.value), MmFromMetres(size.published->least),
               MmFromMetres(size.published->most), size.published->source->author);
}

std::vector<std::string> ModelWords() {
  std::vector<std::string> words;
  for (const authoring::ModelEntry& entry : authoring::ModelEntries())
    words.emplace_back(entry.word);
  return words;
}
std::vector<std::string> TearWords() {
  std::vector<std::string> words;
  for (const authoring::TearEntry& entry : authoring::TearEntries()) words.emplace_back(entry.word);
  return words;
}
std::vector<std::string> BudgetNames() {
  std::vector<std::string> names;
  for (const authoring::MeshBudget& budget : authoring::MeshBudgets())
    names.emplace_back(budget.name);
  return names;
}

}  // namespace

void AddModelJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "model", "Make a structure of the knee from published sizes, as a surface or in a scene.");
  const auto own = std::make_shared<ModelArguments>();
  const auto files = JobFiles::Of(*job);
  job->add_option("KIND", own->kind, "Model of the library.")
      ->required()
      ->check(CLI::IsMember(ModelWords()));
  job->add_option("--side", own->side, "Knee.")
      ->check(CLI::IsMember({"left", "right"}))
      ->capture_default_str();
  files->Output(
      job->add_option("-o,--output", own->output,
                      "Surface to write: .ply, .obj, .stl, or .vtp, which also holds the "
                      "thirds and zones of a meniscus; in metres. A tear is cut into it."),
      {"a surface", FileForm::kUnique});
  files->Output(
      job->add_option("--report", own->report,
                      "Report as JSON: sizes with their sources, volume, parts, regions."),
      {"a report", FileForm::kJson, "arthroscene.model/"});
  files->Input(job->add_option("--scene", own->scene,
                               "Scene to which the model is added; it stays as it is."),
               kSceneInput);
  files->OutputScene(
      job->add_option("--save-scene", own->save_scene,
                      "Scene with the model on its relief to write: a folder, or a new "
                      ".arthro archive."),
      SceneFile);
  AddNumbers(*job, "--towards-deg", own->towards, Range{-180, 180}, "degrees",
             "Latitude and longitude, from the scope's portal, at which it lies on the relief.");
  job->add_option("--budget", own->budget, "Size of the tetrahedral mesh in the scene.")
      ->check(CLI::IsMember(BudgetNames()))
      ->capture_default_str();
  std::map<std::string, SharedField> fields;
  for (const authoring::ModelEntry& entry : authoring::ModelEntries()) {
    authoring::ModelOptions options = authoring::DefaultOptionsOf(entry.kind);
    const std::string kind = entry.word;
    std::visit([&](auto& chosen) { chosen.Visit(FieldCollector{kind, fields}); }, options);
  }
  AddFields(*job, fields, own->sizes, "Sizes [kind: range, default]");
  job->add_option("--tear", own->tear, "Kind of a tear of a meniscus.")
      ->check(CLI::IsMember(TearWords()))
      ->group("Tear");
  std::map<std::string, SharedField> tear_fields;
  authoring::TearOptions tear;
  const std::string every_kind;
  tear.Visit(FieldCollector{every_kind, tear_fields});
  for (auto& [name, field] : tear_fields) field.kinds.clear();
  AddFields(*job, tear_fields, own->tear_sizes, "Tear");
  files->Run([own] {
    if (own->towards.size() != 2)
      throw CLI::ValidationError("--towards-deg", "two angles are needed: LATITUDE,LONGITUDE");
    RunJob(*own);
  });
}

}  // namespace arthro::app
