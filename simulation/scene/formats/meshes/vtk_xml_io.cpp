// VTP surfaces and VTU volumes: read by VtkXmlFile, written by VTK's writer.
#include <algorithm>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataObject.h>
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
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkXMLWriter.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/formats/meshes/polygon_soup.h"
#include "simulation/scene/formats/meshes/vtk_xml_file.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/mesh/tet_check.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

thread_local bool is_reading = false;

// VTK says its errors to one window of the whole process. This one drops those of a thread that is
// reading, and hands all others on to the window that was there before.
class ReadingOutput : public vtkOutputWindow {
 public:
  static ReadingOutput* New();
  vtkTypeMacro(ReadingOutput, vtkOutputWindow);

  void DisplayText(const char* text) override {
    if (!is_reading) next_->DisplayText(text);
  }
  void DisplayErrorText(const char* text) override {
    if (!is_reading) next_->DisplayErrorText(text);
  }
  void DisplayWarningText(const char* text) override {
    if (!is_reading) next_->DisplayWarningText(text);
  }
  void DisplayGenericWarningText(const char* text) override {
    if (!is_reading) next_->DisplayGenericWarningText(text);
  }

 private:
  vtkSmartPointer<vtkOutputWindow> next_ = vtkOutputWindow::GetInstance();
};
vtkStandardNewMacro(ReadingOutput);

// While it lives, what VTK says on this thread goes nowhere.
struct VtkSilence {
  VtkSilence() {
    static std::once_flag once;
    std::call_once(once, [] {
      vtkLogger::SetStderrVerbosity(
          vtkLogger::VERBOSITY_OFF);  // it prints before the window is asked
      vtkOutputWindow::SetInstance(vtkNew<ReadingOutput>());
    });
    is_reading = true;
  }
  ~VtkSilence() { is_reading = false; }
  VtkSilence(const VtkSilence&) = delete;
  VtkSilence& operator=(const VtkSilence&) = delete;
};

std::string NameOfCellType(std::int64_t type) {
  if (type < 0 || type > VTK_NUMBER_OF_CELL_TYPES) return fmt::format("cell of type {}", type);
  return vtkCellTypes::GetClassNameFromTypeId(static_cast<int>(type));
}

// Behind those of the pieces before.
void AppendPoints(VtkXmlFile& xml, const VtkXmlPiece& piece, std::vector<glm::dvec3>& to) {
  const std::size_t count = piece.Count("NumberOfPoints");
  if (count == 0) return;
  const VtkXmlArray* points = piece.Find("Points", "");
  if (!points || points->components != 3) xml.RefuseDamaged();
  const std::vector<double> values = xml.Numbers(*points, 3 * count);
  to.reserve(to.size() + count);
  for (std::size_t i = 0; i < count; ++i)
    to.emplace_back(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
}

// Corners of the cells of one group of a piece, as indices into its points.
struct CellCorners {
  std::vector<std::int64_t> corners, ends;  // ends: one past the last corner of each cell

  std::size_t size() const { return ends.size(); }
  std::span<const std::int64_t> operator[](std::size_t cell) const {
    const std::size_t begin = cell == 0 ? 0 : static_cast<std::size_t>(ends[cell - 1]);
    return std::span(corners).subspan(begin, static_cast<std::size_t>(ends[cell]) - begin);
  }
};

CellCorners CellsOf(VtkXmlFile& xml, const VtkXmlPiece& piece, std::string_view group,
                    std::size_t count, const fs::path& file) {
  CellCorners cells;
  if (count == 0) return cells;
  const VtkXmlArray* corners = piece.Find(group, "connectivity");
  const VtkXmlArray* ends = piece.Find(group, "offsets");
  if (!corners || !ends) xml.RefuseDamaged();
  cells.ends = xml.Integers(*ends, count);
  if (cells.ends.front() < 0 || !std::ranges::is_sorted(cells.ends)) xml.RefuseDamaged();
  cells.corners = xml.Integers(*corners, static_cast<std::size_t>(cells.ends.back()));
  const auto points = static_cast<std::int64_t>(piece.Count("NumberOfPoints"));
  for (std::size_t i = 0; i < count; ++i)
    for (const std::int64_t corner : cells[i])
      if (corner < 0 || corner >= points)
        throw Error(Code::kBadMesh,
                    fmt::format("cell {} names point {} but there are only {}; the file is "
                                "damaged, export it again",
                                i, corner, points),
                    file);
  return cells;
}

// The point arrays of a piece that hold nothing but 0 and 1.
void AppendSets(VtkXmlFile& xml, const VtkXmlPiece& piece, std::size_t points_before,
                std::map<std::string, std::vector<std::uint8_t>>& sets) {
  const auto group = piece.arrays.find("PointData");
  if (group == piece.arrays.end()) return;
  for (const VtkXmlArray& array : group->second) {
    if (array.name.empty() || array.components != 1 || array.type == "String") continue;
    const std::vector<double> values = xml.Numbers(array, piece.Count("NumberOfPoints"));
    if (!std::ranges::all_of(values, [](double value) { return value == 0.0 || value == 1.0; }))
      continue;
    std::vector<std::uint8_t>& flags = sets[array.name];
    flags.resize(points_before);
    for (const double value : values) flags.push_back(value == 1.0);
  }
}

void FillPoints(const std::vector<glm::dvec3>& places, vtkPoints* points) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i)
    coordinates->SetTypedTuple(static_cast<vtkIdType>(i), &places[i].x);
  points->SetData(coordinates);
}

void AddLabels(const std::map<std::string, std::vector<std::uint8_t>>& labels, vtkPointData* data) {
  for (const auto& [name, numbers] : labels) {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfTuples(static_cast<vtkIdType>(numbers.size()));
    std::copy(numbers.begin(), numbers.end(), array->GetPointer(0));
    data->AddArray(array);
  }
}

std::string TextOf(vtkXMLWriter* writer, vtkDataObject* data) {
  writer->SetInputDataObject(data);
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToNone();  // other tools, and people, read it more easily
  writer->SetHeaderTypeToUInt64();
  writer->WriteToOutputStringOn();
  if (!writer->Write()) throw Error(Code::kFile, "the mesh could not be put into VTK's XML format");
  return writer->GetOutputString();
}

}  // namespace

std::string VtpBytes(const SurfaceMesh& surface, const SurfaceLabels& labels) {
  const vtkNew<vtkPoints> points;
  FillPoints(surface.vertices, points);
  vtkNew<vtkPolyData> polygons;
  polygons->SetPoints(points);
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : surface.triangles) {
    const vtkIdType ids[] = {a, b, c};
    triangles->InsertNextCell(3, ids);
  }
  polygons->SetPolys(triangles);
  AddLabels(labels, polygons->GetPointData());
  const vtkNew<vtkXMLPolyDataWriter> writer;
  return TextOf(writer, polygons);
}

PolygonSoup ParseVtp(std::string_view bytes, const fs::path& file) {
  const VtkSilence silence;
  VtkXmlFile xml(bytes, "PolyData", file);
  PolygonSoup soup;
  for (const VtkXmlPiece& piece : xml.pieces()) {
    const auto first = static_cast<std::int64_t>(soup.points.size());
    AppendPoints(xml, piece, soup.points);
    const auto push = [&](std::int64_t corner) {
      soup.corners.push_back(static_cast<int>(first + corner));
    };
    const CellCorners polygons = CellsOf(xml, piece, "Polys", piece.Count("NumberOfPolys"), file);
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      for (const std::int64_t corner : polygons[i]) push(corner);
      soup.ClosePolygon();
    }
    const CellCorners strips = CellsOf(xml, piece, "Strips", piece.Count("NumberOfStrips"), file);
    for (std::size_t i = 0; i < strips.size(); ++i) {
      const auto strip = strips[i];
      for (std::size_t k = 0; k + 2 < strip.size(); ++k) {  // every other one is listed backwards
        for (const std::size_t corner : {k, k + 1 + k % 2, k + 2 - k % 2}) push(strip[corner]);
        soup.ClosePolygon();
      }
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
  const VtkSilence silence;
  VtkXmlFile xml(bytes, "UnstructuredGrid", file);

  // All cells of one kind, four or ten nodes each.
  TetMesh mesh;
  std::optional<std::int64_t> kind;
  std::int64_t cell = 0;
  for (const VtkXmlPiece& piece : xml.pieces()) {
    const std::size_t first = mesh.rest_positions.size(), count = piece.Count("NumberOfCells");
    AppendPoints(xml, piece, mesh.rest_positions);
    AppendSets(xml, piece, first, mesh.sets);
    if (count == 0) continue;
    const VtkXmlArray* types_of = piece.Find("Cells", "types");
    if (!types_of) xml.RefuseDamaged();
    const std::vector<std::int64_t> types = xml.Integers(*types_of, count);
    const CellCorners cells = CellsOf(xml, piece, "Cells", count, file);
    for (std::size_t i = 0; i < count; ++i, ++cell) {
      if (types[i] != VTK_TETRA && types[i] != VTK_QUADRATIC_TETRA)
        throw Error(Code::kBadMesh,
                    fmt::format("cell {} is a {}; only tetrahedra of 4 or 10 nodes can be used",
                                cell, NameOfCellType(types[i])),
                    file);
      if (!kind) kind = types[i];
      if (types[i] != *kind)
        throw Error(Code::kBadMesh,
                    fmt::format("cell {} has another number of nodes than cell 0; linear and "
                                "quadratic tetrahedra cannot be mixed",
                                cell),
                    file);
      mesh.order = *kind == VTK_QUADRATIC_TETRA ? 2 : 1;
      const auto corners = cells[i];
      if (static_cast<int>(corners.size()) != mesh.NodesPerElement()) xml.RefuseDamaged();
      for (const std::int64_t corner : corners)
        mesh.elements.push_back(static_cast<int>(static_cast<std::int64_t>(first) + corner));
    }
  }
  if (!kind)
    throw Error(Code::kBadMesh,
                "there is no tetrahedron in this file; make it again with `arthroscene "
                "tetrahedralize`",
                file);
  // A set of only some pieces is no set of the whole.
  std::erase_if(mesh.sets,
                [&](const auto& set) { return set.second.size() != mesh.rest_positions.size(); });
  TetReadReport changed;
  CheckAndRepair(mesh, file, &changed);
  if (report) *report = std::move(changed);
  return mesh;
}

void WriteTetMesh(const fs::path& file, const TetMesh& mesh) {
  if (file != "-" && file.extension() != ".vtu")
    throw Error(Code::kBadArgument, "a volume is written as VTK's XML format; name it .vtu", file);
  const vtkNew<vtkPoints> points;
  FillPoints(mesh.rest_positions, points);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  const int nodes = mesh.NodesPerElement();
  grid->Allocate(mesh.ElementCount());
  std::vector<vtkIdType> ids(static_cast<std::size_t>(nodes));
  for (int i = 0; i < mesh.ElementCount(); ++i) {
    for (int k = 0; k < nodes; ++k) ids[k] = mesh.elements[static_cast<std::size_t>(i) * nodes + k];
    grid->InsertNextCell(mesh.order == 2 ? VTK_QUADRATIC_TETRA : VTK_TETRA, nodes, ids.data());
  }
  AddLabels(mesh.sets, grid->GetPointData());
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  WriteAtomically(file, TextOf(writer, grid));
}

}  // namespace arthro
