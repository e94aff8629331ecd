// VTP surfaces and VTU volumes, through VTK's XML reader and writer. The one file of mesh_io that
// sees VTK.
#include <algorithm>
#include <array>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/formats/polygon_soup.h"
#include "simulation/scene/mesh_io.h"
#include "simulation/scene/tet_check.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

// Faults that VTK has named on this thread since reading began; null while nothing is read.
thread_local int* faults_of_reading = nullptr;

// VTK says its errors to one window of the whole process. This one takes those of a thread that is
// reading, and hands all others on to the window that was there before.
class ReadingOutput : public vtkOutputWindow {
 public:
  static ReadingOutput* New();
  vtkTypeMacro(ReadingOutput, vtkOutputWindow);

  void DisplayText(const char* text) override {
    if (!faults_of_reading) next_->DisplayText(text);
  }
  void DisplayErrorText(const char* text) override {
    faults_of_reading ? void(++*faults_of_reading) : next_->DisplayErrorText(text);
  }
  void DisplayWarningText(const char* text) override {
    faults_of_reading ? void(++*faults_of_reading) : next_->DisplayWarningText(text);
  }
  void DisplayGenericWarningText(const char* text) override {
    faults_of_reading ? void(++*faults_of_reading) : next_->DisplayGenericWarningText(text);
  }

 private:
  vtkSmartPointer<vtkOutputWindow> next_ = vtkOutputWindow::GetInstance();
};
vtkStandardNewMacro(ReadingOutput);

// Runs a reader over bytes in memory; false when VTK found any fault.
bool Run(vtkXMLReader* reader, std::string_view bytes) {
  static std::once_flag once;
  std::call_once(once, [] {
    vtkLogger::SetStderrVerbosity(
        vtkLogger::VERBOSITY_OFF);  // it prints before the window is asked
    vtkOutputWindow::SetInstance(vtkNew<ReadingOutput>());
  });
  int faults = 0;
  struct Listening {
    explicit Listening(int* count) { faults_of_reading = count; }
    ~Listening() { faults_of_reading = nullptr; }
  } listening(&faults);
  reader->ReadFromInputStringOn();
  reader->SetInputString(std::string(bytes));
  reader->Update();
  return faults == 0 && reader->GetErrorCode() == 0;
}

[[noreturn]] void RefuseDamaged(const char* kind, const fs::path& file) {
  throw Error(Code::kBadMesh,
              fmt::format("this is not a whole {} file: it is damaged, cut off or something else; "
                          "copy or export it again",
                          kind),
              file);
}

void AppendPoints(vtkPoints* points, std::vector<glm::dvec3>& to) {
  const vtkIdType count = points ? points->GetNumberOfPoints() : 0;
  to.reserve(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i) {
    double p[3];
    points->GetPoint(i, p);
    to.emplace_back(p[0], p[1], p[2]);
  }
}

// A cell's corners; VTK's reader checks the offsets but not where the corners point.
std::span<const vtkIdType> CellPoints(vtkCellArray* cells, vtkIdType cell, vtkIdType point_count,
                                      const fs::path& file) {
  vtkIdType size = 0;
  const vtkIdType* ids = nullptr;
  cells->GetCellAtId(cell, size, ids);
  for (vtkIdType i = 0; i < size; ++i)
    if (ids[i] < 0 || ids[i] >= point_count)
      throw Error(Code::kBadMesh,
                  fmt::format("cell {} names point {} but there are only {}; the file is damaged, "
                              "export it again",
                              cell, ids[i], point_count),
                  file);
  return {ids, static_cast<std::size_t>(size)};
}

}  // namespace

PolygonSoup ParseVtp(std::string_view bytes, const fs::path& file) {
  vtkNew<vtkXMLPolyDataReader> reader;
  if (!Run(reader, bytes)) RefuseDamaged("VTP", file);
  vtkPolyData* data = reader->GetOutput();
  PolygonSoup soup;
  AppendPoints(data->GetPoints(), soup.points);
  const vtkIdType count = data->GetNumberOfPoints();
  for (vtkIdType i = 0; i < data->GetPolys()->GetNumberOfCells(); ++i) {
    for (const vtkIdType id : CellPoints(data->GetPolys(), i, count, file))
      soup.corners.push_back(static_cast<int>(id));
    soup.ClosePolygon();
  }
  for (vtkIdType i = 0; i < data->GetStrips()->GetNumberOfCells(); ++i) {
    const auto strip = CellPoints(data->GetStrips(), i, count, file);
    for (std::size_t k = 0; k + 2 < strip.size(); ++k) {  // every other one is listed backwards
      const std::array<std::size_t, 3> order = {k, k + 1 + k % 2, k + 2 - k % 2};
      for (const std::size_t corner : order)
        soup.corners.push_back(static_cast<int>(strip[corner]));
      soup.ClosePolygon();
    }
  }
  return soup;
}

TetMesh ReadTetMesh(const fs::path& file, TetReadReport* report) {
  std::string bytes;
  try {
    bytes = ReadWholeFile(file);
  } catch (const Error& error) {
    throw Error(Code::kBadMesh, error.sentence(), file);
  }
  if (file.extension() != ".vtu")
    throw Error(Code::kBadMesh,
                fmt::format("\"{}\" is not a volume format that can be read; make a .vtu with "
                            "`arthroscene tetrahedralize`",
                            file.extension().string()),
                file);
  if (bytes.empty())
    throw Error(Code::kBadMesh, "this volume is empty (0 bytes); export it again", file);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!Run(reader, bytes)) RefuseDamaged("VTU", file);
  vtkUnstructuredGrid* grid = reader->GetOutput();
  const vtkIdType cells = grid->GetNumberOfCells(), points = grid->GetNumberOfPoints();
  if (cells == 0)
    throw Error(Code::kBadMesh,
                "there is no tetrahedron in this file; make it again with `arthroscene "
                "tetrahedralize`",
                file);

  // All cells of one kind, four or ten nodes each.
  TetMesh mesh;
  const int type = grid->GetCellType(0);
  mesh.order = type == VTK_QUADRATIC_TETRA ? 2 : 1;
  for (vtkIdType i = 0; i < cells; ++i) {
    if (grid->GetCellType(i) != VTK_TETRA && grid->GetCellType(i) != VTK_QUADRATIC_TETRA)
      throw Error(Code::kBadMesh,
                  fmt::format("cell {} is a {}; only tetrahedra of 4 or 10 nodes can be used", i,
                              vtkCellTypes::GetClassNameFromTypeId(grid->GetCellType(i))),
                  file);
    if (grid->GetCellType(i) != type)
      throw Error(Code::kBadMesh,
                  fmt::format("cell {} has another number of nodes than cell 0; linear and "
                              "quadratic tetrahedra cannot be mixed",
                              i),
                  file);
    const auto ids = CellPoints(grid->GetCells(), i, points, file);
    if (static_cast<int>(ids.size()) != mesh.NodesPerElement()) RefuseDamaged("VTU", file);
    for (const vtkIdType id : ids) mesh.elements.push_back(static_cast<int>(id));
  }
  AppendPoints(grid->GetPoints(), mesh.rest_positions);

  // Point arrays that hold nothing but 0 and 1 are sets.
  vtkPointData* data = grid->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data->GetArray(i);
    if (!array || !array->GetName() || array->GetNumberOfComponents() != 1 ||
        array->GetNumberOfTuples() != points)
      continue;
    std::vector<std::uint8_t> flags(static_cast<std::size_t>(points));
    bool is_set = true;
    for (vtkIdType k = 0; k < points && is_set; ++k) {
      const double value = array->GetComponent(k, 0);
      is_set = value == 0.0 || value == 1.0;
      flags[static_cast<std::size_t>(k)] = value == 1.0;
    }
    if (is_set) mesh.sets[array->GetName()] = std::move(flags);
  }
  TetReadReport changed;
  CheckAndRepair(mesh, file, &changed);
  if (report) *report = std::move(changed);
  return mesh;
}

void WriteTetMesh(const fs::path& file, const TetMesh& mesh) {
  if (file != "-" && file.extension() != ".vtu")
    throw Error(Code::kBadArgument, "a volume is written as VTK's XML format; name it .vtu", file);
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(mesh.rest_positions.size()));
  for (std::size_t i = 0; i < mesh.rest_positions.size(); ++i)
    coordinates->SetTypedTuple(static_cast<vtkIdType>(i), &mesh.rest_positions[i].x);
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  const int nodes = mesh.NodesPerElement();
  grid->Allocate(mesh.ElementCount());
  std::vector<vtkIdType> ids(static_cast<std::size_t>(nodes));
  for (int i = 0; i < mesh.ElementCount(); ++i) {
    for (int k = 0; k < nodes; ++k) ids[k] = mesh.elements[static_cast<std::size_t>(i) * nodes + k];
    grid->InsertNextCell(mesh.order == 2 ? VTK_QUADRATIC_TETRA : VTK_TETRA, nodes, ids.data());
  }
  for (const auto& [name, flags] : mesh.sets) {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfTuples(static_cast<vtkIdType>(flags.size()));
    std::copy(flags.begin(), flags.end(), array->GetPointer(0));
    grid->GetPointData()->AddArray(array);
  }
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToNone();  // other tools, and people, read it more easily
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (!writer->Write()) throw Error(Code::kFile, "the volume could not be put into VTU", file);
  WriteAtomically(file, writer->GetOutputString());
}

}  // namespace arthro
