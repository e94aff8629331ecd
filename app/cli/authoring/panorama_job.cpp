// arthroscene panorama FOOTAGE -o pano.png: a clip becomes one picture [paper, 3.1].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/cli/flags/number_flags.h"
#include "app/cli/flags/options_cli.h"
#include "app/cli/flags/pixel_flags.h"
#include "app/cli/input_files.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/state/footage/footage_optics.h"
#include "app/state/footage/footage_source.h"
#include "app/state/footage/measured_backdrop.h"
#include "authoring/adjustment/crop_backdrop.h"
#include "authoring/footage/resized_picture.h"
#include "authoring/panorama/crop_panorama.h"
#include "authoring/panorama/make_panorama.h"
#include "authoring/panorama/report_io.h"
#include "authoring/panorama/ties/tie_file.h"
#include "authoring/project/document_io.h"
#include "authoring/project/estimated_depth.h"
#include "authoring/relief/make/relief_panorama.h"
#include "simulation/core/error.h"
#include "simulation/core/input_file.h"
#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct PanoramaJob {
  std::string lens, output, thumbnail, report, scene, ties, places;
  std::vector<std::string> joined;
  std::optional<authoring::PixelBox> crop;
  // Whether the panorama lies over a measured relief; auto: where frames fit no plane, the clip
  // determines depth, and the expected error is smaller.
  std::string relief = "auto";
  Backdrop backdrop;  // gives the scene its medium
  std::vector<int> excluded;
  authoring::PanoramaRequest request;
};

// Flag for the medium of a backdrop, with the words and the help of its field.
struct MediumFlag {
  CLI::App& job;
  template <class T, class Rule>
  void operator()(const char* name, T& field, const Rule& rule, const char* unit,
                  const char* help) {
    if constexpr (std::is_same_v<T, Medium>) CliVisitor{job}(name, field, rule.rule, unit, help);
  }
};

// pano.png, pano-2.png, pano-3.png …
fs::path PieceName(const fs::path& output, std::size_t number) {
  fs::path name = output;
  name.replace_filename(
      fmt::format("{}-{}{}", output.stem().string(), number, output.extension().string()));
  return name;
}

void WriteThumbnail(const fs::path& file, const authoring::RgbaPicture& panorama) {
  constexpr int kWidth = 320;  // px; as the start page shows scenes
  const ColourImage picture = OnBlack(panorama);
  const int width = std::min(kWidth, picture.width);
  const double height = static_cast<double>(width) * picture.height / picture.width;
  WriteColourImage(
      file, authoring::Resized(picture, width, std::max(1, static_cast<int>(std::lround(height)))));
}

// A scene that can be practised in at once: the panorama with the paper's depth map and its noise.
void WriteScene(const PanoramaJob& job, const authoring::PanoramaReport& report,
                const Progress& progress) {
  const fs::path panorama = job.output;
  authoring::Document document = authoring::DocumentFromPanorama(panorama);
  document.scene.title = panorama.stem().string();
  document.scene.backdrop.projection = ProjectionOf(report.panorama);
  document.scene.backdrop.medium = job.backdrop.medium;
  PutFootage(document, Share(RecordOf(job.request, report)));
  TakeFootageLens(document, report.lens, report.is_lens_guessed);
  try {
    SetEstimatedDepth(document,
                      authoring::EstimateDepth(*document.panorama, document.depth_options, nullptr,
                                               document.scene.backdrop, {{}, progress.stop}));
  } catch (const Error& error) {
    if (error.code() != Code::kCancelled) throw;
    throw Error(Code::kCancelled, "stopped; the panorama was written, and no scene", panorama);
  }
  authoring::SaveDocument(document, job.scene);
}

// Report of an earlier run: a file of --report, or the one that a scene keeps.
authoring::PanoramaReport ReadKnown(const fs::path& place) {
  if (!fs::is_directory(place) && !IsArchive(place))
    return authoring::ReportFromJson(ReadWholeFile(place, kMostJsonBytes), place);
  const authoring::Document document = authoring::OpenDocument(place);
  if (!document.footage || document.footage->report.empty())
    throw Error(Code::kBadScene,
                "the scene does not say how its panorama was made; give a report of "
                "`panorama --report`",
                place);
  return authoring::ReportFromJson(document.footage->report, place);
}

authoring::ReliefResult MeasureRelief(const PanoramaJob& job, const Progress& progress) {
  authoring::ReliefRequest request;
  request.footage = job.request.footage;
  request.lens = *job.request.lens;
  return authoring::MakeRelief(request, progress);
}

// Sentence about a clip that does not determine depth.
std::string WordsOf(const authoring::ReliefVerdict& verdict) {
  return fmt::format("no relief was measured ({}: {} {:.2f}, limit {:.2f}): {}", verdict.kind,
                     verdict.test, verdict.value, verdict.limit, verdict.sentence);
}

struct MadePanorama {
  authoring::PanoramaResult panorama;
  std::optional<authoring::ReliefResult> relief;  // set for a panorama over it
};

MadePanorama OverMeasuredRelief(const PanoramaJob& job, const Progress& progress) {
  authoring::ReliefResult relief = MeasureRelief(job, progress);
  if (!relief.report.verdict.is_measured())
    throw Error(Code::kBadImage, WordsOf(relief.report.verdict), job.request.footage);
  return {authoring::PanoramaFromRelief(relief, *job.request.lens), std::move(relief)};
}

// The plane first; a relief only where the frames fit no plane.
MadePanorama BestPanorama(const PanoramaJob& job, const Progress& progress) {
  if (job.relief == "yes") return OverMeasuredRelief(job, progress);
  MadePanorama made{authoring::MakePanorama(job.request, progress), {}};
  constexpr double kFitsPlane = 2.0;  // px of the rectified picture
  // A relief is measured from one clip, and knows no tie points.
  const bool is_one_clip = job.request.joined.empty() && job.request.ties.empty();
  if (job.relief == "no" || !is_one_clip || !job.request.lens ||
      made.panorama.report.mean_error_px < kFitsPlane)
    return made;
  auto& warnings = made.panorama.report.warnings;
  try {
    authoring::ReliefResult relief = MeasureRelief(job, progress);
    if (!relief.report.verdict.is_measured()) {
      warnings.push_back(WordsOf(relief.report.verdict));
      return made;
    }
    if (!relief.report.has_pivot) {
      warnings.push_back(
          "a relief was measured, but its shafts do not meet in one portal; the "
          "frames were joined on a plane");
      return made;
    }
    authoring::PanoramaResult over = authoring::PanoramaFromRelief(relief, *job.request.lens);
    if (ExpectedErrorAngle(over.report) >= ExpectedErrorAngle(made.panorama.report)) return made;
    return {std::move(over), std::move(relief)};
  } catch (const Error& error) {
    if (error.code() == Code::kCancelled) throw;
    warnings.push_back(fmt::format("no relief was measured: {}", error.sentence()));
    return made;
  }
}

void Run(PanoramaJob job) {
  authoring::CheckPanoramaName(job.output);
  if (job.thumbnail == "-")
    throw Error(Code::kBadArgument,
                "the small picture goes to a file; give --thumbnail a name instead of -");
  if (!job.thumbnail.empty()) authoring::CheckPanoramaName(job.thumbnail);
  if (!job.scene.empty() && job.output == "-")
    throw Error(Code::kBadArgument,
                "a scene is made from the panorama's file; give -o a name instead of -");
  if (job.output == "-" && job.report == "-")
    throw Error(Code::kBadArgument,
                "only one of the panorama and its report can go to standard output");
  if (!job.lens.empty()) job.request.lens = ReadLens(job.lens);
  job.request.excluded = {job.excluded.begin(), job.excluded.end()};
  job.request.joined = {job.joined.begin(), job.joined.end()};
  if (!job.places.empty()) {
    const auto known = std::make_shared<const authoring::PanoramaReport>(ReadKnown(job.places));
    // Self-calibration may have replaced the lens.
    if (!known->is_lens_guessed) job.request.lens = known->lens;
    job.request.options.self_calibrate = false;
    job.relief = "no";
    job.request.known = known;
  }
  if (!job.ties.empty()) job.request.ties = authoring::ReadTies(job.ties);
  const Progress progress = TerminalProgress();
  MadePanorama made = BestPanorama(job, progress);
  authoring::PanoramaResult& result = made.panorama;
  if (job.crop) authoring::CropPanorama(result, *job.crop);

  // The panorama last: where it is, all of it is.
  progress.Step("writing", 0.99);
  auto& report = result.report;
  std::size_t number = 1;
  for (std::size_t i = 0; i < result.pieces.size(); ++i) {
    if (job.output == "-" || result.pieces[i].empty()) continue;
    const fs::path file = PieceName(job.output, ++number);
    authoring::WritePanorama(file, result.pieces[i]);
    report.pieces[i].file = file.filename().string();
  }
  if (!job.report.empty()) authoring::WriteReport(job.report, report);
  if (!job.thumbnail.empty()) WriteThumbnail(job.thumbnail, result.picture);
  authoring::WritePanorama(job.output, result.picture);
  if (!job.scene.empty() && made.relief) {
    authoring::Document document =
        DocumentFromRelief(*made.relief, report.lens, authoring::ReliefOptions().view_angle);
    document.scene.title = fs::path(job.output).stem().string();
    document.scene.backdrop.medium = job.backdrop.medium;
    PutFootage(document, Share(RecordOf(job.request, report)));
    if (job.crop) authoring::CropBackdrop(document, *job.crop);
    authoring::SaveDocument(document, job.scene);
  } else if (!job.scene.empty()) {
    WriteScene(job, report, progress);
  }
  progress.Step("done", 1.0);

  for (const std::string& warning : report.warnings)
    fmt::print(stderr, "warning: {}\n", PrintableLine(warning));
  if (job.output == "-" || job.report == "-") return;  // standard output holds one of them
  fmt::print("{}: {} x {} px, {}; expected error {:.2f} px on average, {:.2f} px at most\n",
             job.output, result.picture.width, result.picture.height, report.summary,
             report.mean_error_px, report.max_error_px);
  for (const auto& piece : report.pieces)
    if (!piece.file.empty())
      fmt::print("{}: a separate piece of {} frames\n", piece.file, piece.frames);
}

}  // namespace

void AddPanoramaJob(CLI::App& program) {
  CLI::App* job = program.add_subcommand(
      "panorama", "Join the frames of a clip into one panorama, with a report of every frame.");
  const auto own = std::make_shared<PanoramaJob>();
  const auto files = JobFiles::Of(*job);
  files
      ->Input(job->add_option("FOOTAGE", own->request.footage,
                              "Video, folder of pictures, or pattern such as frames/%04d.png."),
              kFootageInput)
      ->required();
  files->Input(job->add_option(
      "--lens", own->lens,
      "Lens file of `arthroscene lens`. Without it the pictures are used unrectified."));
  files
      ->OutputPieces(job->add_option("-o,--output", own->output,
                                     "Panorama to write: PNG with the imaged region as alpha, or "
                                     "JPEG; - is standard output."),
                     kPictureFile)
      ->required();
  files->Output(job->add_option("--thumbnail", own->thumbnail,
                                "Also write the panorama as a small picture, at most 320 px wide."),
                kPictureFile);
  files->Output(job->add_option(
                    "--report", own->report,
                    "Report as JSON: the place of each frame, or the reason why it was rejected."),
                {"a report", FileForm::kJson, "arthroscene.panorama/"});
  files->OutputScene(job->add_option("--scene", own->scene,
                                     "Also write a scene with the panorama into this folder."),
                     SceneFile);
  job->add_option("--relief", own->relief,
                  "Lay the frames over a relief measured from their motion; auto: where they fit "
                  "no plane and --lens is given.")
      ->check(CLI::IsMember({"auto", "yes", "no"}))
      ->capture_default_str();
  files->Input(job->add_option("--join", own->joined,
                               "A further clip of the same joint through the same lens; may be "
                               "given several times. Its frames are counted on."),
               kFootageInput);
  files->Input(job->add_option("--ties", own->ties,
                               "JSON: two or more pairs of points for each frame that did not "
                               "register; `check --ties-schema` describes it."));
  CLI::Option* places = files->Input(job->add_option(
      "--places", own->places,
      "Report of an earlier run, or a scene that keeps it: its frames keep their places, and only "
      "frames of --ties are placed. Frames that were tied before need their ties again."));
  places->excludes("--lens");
  job->add_option_function<std::vector<std::string>>(
         "--mask",
         [own](const std::vector<std::string>& boxes) {
           own->request.masked.clear();
           for (const std::string& words : boxes)
             own->request.masked.push_back(BoxFromWords("--mask", words));
         },
         "Rectangle of every raw picture that shows no tissue, such as text; may be given several "
         "times.")
      ->type_name("X,Y,W,H");
  job->add_option_function<std::string>(
         "--crop", [own](const std::string& words) { own->crop = BoxFromWords("--crop", words); },
         "Part of the panorama to write, in its pixels; the report describes that part.")
      ->type_name("X,Y,W,H");
  own->backdrop.Visit(MediumFlag{*job});
  AddNumbers(*job, "--leave-out", own->excluded, {0, kAnyWholeNumber.max}, "",
             "Numbers of frames to leave out, separated by commas.");
  AddOptions(*job, own->request.options);
  files->Run([own, job] {
    // Whoever names a detector wants it used; on its own, pairs are aligned without one.
    if (job->count("--detector") > 0 && job->count("--method") == 0)
      own->request.options.registration.method = authoring::PairMethod::kFeaturesThenDirect;
    if (job->count("--medium") > 0 && own->scene.empty())
      throw CLI::ValidationError("--medium", "is kept in a scene; name its folder with --scene");
    if (own->relief == "yes" && !(own->joined.empty() && own->ties.empty()))
      throw CLI::ValidationError(
          "--relief",
          "a relief is measured from one clip without tie points; leave out --join and "
          "--ties, or say --relief no");
    if (own->relief == "yes" && !own->places.empty())
      throw CLI::ValidationError("--relief", "yes measures all places anew; leave out --places");
    if (own->relief == "yes" && own->lens.empty())
      throw CLI::ValidationError("--relief", "yes needs --lens; calibrate one with `lens`");
    Run(*own);
  });
}

}  // namespace arthro::app
