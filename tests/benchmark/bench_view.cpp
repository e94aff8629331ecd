// How long a frame of the arthroscopic view takes, with what it adds in error: by resolution,
// search for the relief, samples, size of the panorama, tissue, lamp and disturbance. Errors are
// held against the double-precision ray tracer at random pixels of the very picture that is timed
// (distance and colour), and for the samples against where the closed form puts grid lines. `cpu`
// is the process's time over all threads; `wall` is what a user waits.
#include <ctime>
#include <random>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/bench/view/grid_picture.h"
#include "app/bench/view/reference_tracer.h"
#include "app/view/instruments/tool_mesh.h"
#include "tests/app/view/view_scene.h"
#include "tests/benchmark/bench_report.h"

namespace {

using namespace arthro;
using namespace arthro::test;
using namespace arthro::app;

double CpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

template <class F>
void MeasureFrames(const BenchReport& report, const std::string& name, const std::string& error,
                   F&& frame) {
  const int warm_up = report.quick() ? 1 : 5, frames = report.quick() ? 2 : 60;
  for (int i = 0; i < warm_up; ++i) frame();
  std::vector<double> wall, cpu;
  for (int i = 0; i < frames; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = CpuSeconds();
    frame();
    cpu.push_back(CpuSeconds() - cpu_start);
    wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  const auto timing = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    return Timing{values[values.size() / 2], values[(values.size() * 99 + 99) / 100 - 1]};
  };
  report.Row(name + ", wall", timing(wall), error);
  report.Row(name + ", cpu", timing(cpu));
}

// A bulge, waves and a step of 4 mm, under slowly changing colours.
LoadedScene BenchScene(int width) {
  LoadedScene loaded = MakeViewScene(width, width / 2);
  loaded.scene.backdrop.projection.focal_px = 1500.0 * width / 4096;
  for (int y = 0; y < loaded.depth.height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = double(x) / width, v = 2.0 * y / width;
      const double du = u - 0.55, dv = 0.5 * (v - 0.6);
      loaded.depth.at(x, y) = static_cast<float>(
          0.004 + 0.008 * std::exp(-60 * (du * du + dv * dv)) +
          0.003 * std::sin(25 * u) * std::sin(18 * v) + (u + v / 6 < 0.56 ? 0.004 : 0.0));
    }
  return loaded;
}

Picture BenchPicture() { return app::PictureFromPose({-0.1, 0.05, 0.2, 0.008}, 0.5236, 1.5707963); }

// Against the tracer, at pixels well inside window and panorama.
std::string ErrorOf(ArthroscopicView& view, const LoadedScene& loaded, Picture picture, int size,
                    int pixels) {
  const Backdrop& backdrop = loaded.scene.backdrop;
  picture.plain = true;
  view.Render(picture, size);
  const std::vector<float> distances = view.ReadDistances();
  const ColourImage drawn = view.ReadPixels();
  std::mt19937 random(7);
  int compared = 0, elsewhere = 0, off_colour = 0;
  double sum2 = 0;
  while (compared < pixels) {
    const int x = static_cast<int>(random() % static_cast<unsigned>(size)),
              y = static_cast<int>(random() % static_cast<unsigned>(size));
    const auto ray = ReferenceRay(picture.view, picture.field_of_view, size, {x, y});
    if (!ray || std::hypot(x - 0.5 * size, y - 0.5 * size) > 0.48 * size) continue;
    const auto hit = ReferenceReliefHit(backdrop, loaded.depth, picture.view.tip, *ray);
    const auto place = hit ? ReferencePixel(backdrop.projection, *hit) : std::nullopt;
    if (!place || place->x < 9 || place->y < 9 || place->x > loaded.depth.width - 10 ||
        place->y > loaded.depth.height - 10)
      continue;
    ++compared;
    const double off =
        std::abs(double(distances[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) +
                                  static_cast<std::size_t>(x)]) -
                 glm::dot(*hit - picture.view.tip, *ray));
    const glm::dvec3 colour = ReferenceColour(loaded.panorama, *place);
    double worst = 0;
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(drawn.at(x, y)[c] - colour[c]));
    off_colour += worst > 8 ? 1 : 0;
    elsewhere += off > 1e-4 ? 1 : 0;
    if (off <= 1e-4) sum2 += off * off;
  }
  return fmt::format("{:.2f} % of {} px > 0.1 mm off, others rms {:.4f} mm; {:.2f} % > 8/255 off",
                     100.0 * elsewhere / compared, compared,
                     1e3 * std::sqrt(sum2 / std::max(1, compared - elsewhere)),
                     100.0 * off_colour / compared);
}

void MeasureRelief(const BenchReport& report, ArthroscopicView& view) {
  for (const int width : {1024, 4096}) {
    const LoadedScene loaded = BenchScene(width);
    view.SetBackdrop(loaded.panorama, loaded.depth, loaded.scene.backdrop);
    for (const int size : {512, 1024}) {
      if (width == 1024 && size == 1024) continue;
      for (const app::ReliefSearch relief :
           {app::ReliefSearch{0, 1}, {64, 16}, app::kUsualRelief, {64, 4}, {64, 1}, {256, 1}}) {
        Picture picture = BenchPicture();
        picture.relief = relief;
        picture.samples = 2;
        const std::string error = ErrorOf(view, loaded, picture, size, report.quick() ? 20 : 3000);
        MeasureFrames(report,
                      fmt::format("{} px, panorama {}, {} steps, cells of {}", size, width,
                                  relief.steps, relief.cell),
                      error, [&] {
                        picture.view.tip.x += 1e-7;
                        view.Render(picture, size);
                        view.Finish();
                      });
      }
    }
  }
}

void MeasureSamples(const BenchReport& report, ArthroscopicView& view) {
  GridPanorama grid;
  grid.width = 4096;
  grid.height = 2048;
  grid.spacing = 128;
  grid.line_sigma = 5;
  Backdrop backdrop;
  backdrop.projection.centre_px = {2047.5, 1023.5};
  backdrop.projection.focal_px = 1500;
  view.SetBackdrop(grid.Draw(), {}, backdrop);
  for (const int size : {512, 1024})
    for (const int samples : {1, 2, 4, 8}) {
      Picture picture = BenchPicture();
      picture.samples = samples;
      picture.plain = true;
      view.Render(picture, size);
      const GridAgreement agreement =
          CompareWithGrid(view.ReadPixels(), grid, backdrop, picture.view, picture.field_of_view);
      picture.plain = false;
      MeasureFrames(report, fmt::format("{} px, sphere, {} samples a pixel", size, samples),
                    fmt::format("grid lines rms {:.3f} px, max {:.3f} px of {}", agreement.rms_px,
                                agreement.max_px, agreement.crossings),
                    [&] {
                      view.Render(picture, size);
                      view.Finish();
                    });
    }
}

// What a trainee sees: relief, tissue that moves in every frame, two instruments (the second one as
// a resting surface), lamp.
void MeasureScenes(const BenchReport& report, ArthroscopicView& view) {
  LoadedScene loaded = BenchScene(4096);
  struct Kind {
    const char* name;
    int around;
    double relight;
    bool is_disturbed;
  };
  const SurfaceMesh second = app::MakeToolMesh(simulation::ToolKind::kPunch).body;
  for (const int size : {512, 1024})
    for (const Kind& kind : {Kind{"no tissue", 0, 0, false},
                             {"20k triangles", 100, 0, false},
                             {"100k triangles", 223, 0, false},
                             {"20k triangles, own lamp", 100, 1, false},
                             {"20k triangles, own lamp, haze and bubbles", 100, 1, true}}) {
      loaded.scene.backdrop.relight = kind.relight;
      view.SetBackdrop(loaded.panorama, loaded.depth, loaded.scene.backdrop);
      Picture picture = BenchPicture();
      picture.relief = app::kUsualRelief;
      picture.samples = 2;
      if (kind.is_disturbed) picture.disturbances = app::ParseDisturbances("haze=0.4,bubbles=0.4");
      SurfaceMesh ring;
      std::vector<Tissue> tissues;
      std::vector<SurfaceMesh> surfaces;
      if (kind.around > 0) {
        ring = Ring(0.007, 0.0024, kind.around, kind.around);
        picture.instrument = ProbeInFront();
        tissues.resize(2);
        tissues[0].pose = loaded.scene.tissues[0].pose;
        tissues[1].pose.position = {-0.004, 0.003, 0.026};
        surfaces = {ring, second};
      }
      view.SetTissues(tissues, surfaces);
      std::vector<glm::dvec3> vertices = ring.vertices;
      int frame = 0;
      MeasureFrames(report, fmt::format("{} px, {}", size, kind.name), "as above", [&] {
        ++frame;
        for (std::size_t i = 0; i < vertices.size(); ++i)
          vertices[i].z = ring.vertices[i].z + 1e-4 * std::sin(0.3 * frame + 900 * vertices[i].x);
        if (!vertices.empty()) view.SetTissueShape(0, vertices);
        picture.view.tip.x += 1e-7;
        picture.disturbances.time += 0.03;
        view.Render(picture, size);
        view.Finish();
      });
    }
}

}  // namespace

int main(int argc, char** argv) {
  BenchReport report("view", argc, argv);
  app::OffscreenContext context;
  std::printf("# drawn by %s\n", context.description().c_str());
  ArthroscopicView view;
  MeasureScenes(report, view);
  view.SetTissues({}, {});
  MeasureRelief(report, view);
  MeasureSamples(report, view);
  return 0;
}
