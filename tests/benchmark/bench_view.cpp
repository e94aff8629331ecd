// How long a frame of the arthroscopic view takes, with how far its pixels are from where the
// closed form puts them: a 4096 x 2048 panorama with relief, 20 000 triangles of tissue that move
// every frame, the probe. `cpu` is the process's time over all threads; `wall` is what a user
// waits.
#include <ctime>

#include <fmt/format.h>

#include "tests/app/view/view_scene.h"
#include "tests/benchmark/bench_report.h"
#include "tests/support/grid_picture.h"

namespace {

using namespace arthro;
using namespace arthro::test;
using app::ArthroscopicView;
using app::Picture;

double CpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

template <class F>
void MeasureFrames(const BenchReport& report, const std::string& name, const std::string& error,
                   F&& frame) {
  const int warm_up = report.quick() ? 1 : 5, frames = report.quick() ? 3 : 60;
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

}  // namespace

int main(int argc, char** argv) {
  BenchReport report("view", argc, argv);
  app::OffscreenContext context;
  std::printf("# drawn by %s\n", context.description().c_str());
  ArthroscopicView view;

  GridPanorama grid;
  grid.width = 4096;
  grid.height = 2048;
  grid.spacing = 128;
  grid.line_sigma = 5;
  Backdrop backdrop;
  backdrop.projection.centre_px = {2047.5, 1023.5};
  backdrop.projection.focal_px = 1500;
  view.SetBackdrop(grid.Draw(), DepthMap(grid.width, grid.height, 0.004f), backdrop);
  const SurfaceMesh ring = Ring(0.007, 0.0024, 100, 100);
  Tissue tissue;
  tissue.pose = MakeViewScene(64, 64).scene.tissues[0].pose;

  Picture picture = app::PictureFromPose({-0.1, 0.05, 0.2, 0.008}, 0.5236, 1.5707963);
  for (const int size : {512, 1024}) {
    view.SetTissues({}, {});
    picture.instrument.reset();
    picture.plain = true;
    view.Render(picture, size);
    const GridAgreement agreement =
        CompareWithGrid(view.ReadPixels(), grid, backdrop, picture.view, picture.field_of_view);
    const std::string error = fmt::format("grid lines rms {:.3f} px, max {:.3f} px of {}",
                                          agreement.rms_px, agreement.max_px, agreement.crossings);
    const auto render = [&] {
      view.Render(picture, size);
      KeepAlive(view.ReadDistances().front());  // waits until the frame is drawn
    };
    MeasureFrames(report, fmt::format("{0}x{0} plain backdrop", size), error, render);
    picture.plain = false;
    MeasureFrames(report, fmt::format("{0}x{0} lit backdrop", size), error, render);

    view.SetTissues(std::span(&tissue, 1), std::span(&ring, 1));
    picture.instrument = ProbeInFront();
    MeasureFrames(report, fmt::format("{0}x{0} with resting tissue and probe", size), error,
                  render);
    std::vector<glm::dvec3> vertices = ring.vertices;
    int frame = 0;
    MeasureFrames(
        report, fmt::format("{0}x{0} with 20k moving triangles and probe", size), error, [&] {
          for (std::size_t i = 0; i < vertices.size(); ++i)
            vertices[i].z = ring.vertices[i].z + 1e-4 * std::sin(0.3 * frame + 900 * vertices[i].x);
          ++frame;
          view.SetTissueShape(0, vertices);
          render();
        });
  }
  return 0;
}
