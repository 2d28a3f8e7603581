// SPDX-License-Identifier: BSD-3-Clause
#include "vtkElectrodeGrids.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Common/Numbers.h"
#include "Common/RankAgreement.h"
#include "Common/RankInputs.h"
#include "Common/WorldAxes.h"
#include "Filters/Attached/InputAxes.h"
#include "Filters/Attached/MaskImage.h"
#include "Filters/Electrodes/ContactArrays.h"
#include "Filters/Electrodes/SheetFit.h"
#include "Filters/Measured/MeasuredPoints.h"
#include "Filters/Measured/RestCortex.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cmath>

using namespace brainshift;

namespace
{
constexpr int CortexPort = 1;
constexpr int OpeningPort = 2;
constexpr std::size_t MostNamed = 6;       // contacts in a sentence
constexpr std::size_t MostContacts = 5000; // of all electrodes: more are no contacts
constexpr double DeepestOnCortexMm = 15.0; // below it at rest: brains sink less
constexpr const char* NotRun = "The contacts were not fitted yet";

// The triangles of a surface; polygons become fans, strips are left out.
TriangleMesh meshOf(vtkPolyData* surface)
{
  TriangleMesh mesh;
  mesh.points = positionsOf(surface);
  vtkNew<vtkIdList> corners;
  vtkCellArray* polygons = surface->GetPolys();
  for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i)
  {
    polygons->GetCellAtId(i, corners);
    for (vtkIdType k = 2; k < corners->GetNumberOfIds(); ++k)
    {
      mesh.triangles.emplace_back(static_cast<int>(corners->GetId(0)),
        static_cast<int>(corners->GetId(k - 1)), static_cast<int>(corners->GetId(k)));
    }
  }
  return mesh;
}

// The axes of the contacts, or others if neither they nor their file say them.
NamedAxes axesOfContacts(vtkElectrodeGrids* filter, int otherwise)
{
  NamedAxes contacts = namedAxesOfInput("the contacts", filter, 0);
  if (contacts.axes == WorldAxes::Unknown)
  {
    contacts.axes = static_cast<WorldAxes>(otherwise);
  }
  return contacts;
}

// A point of the output.
struct Result
{
  SheetPlace place;
  glm::dvec3 measured{ 0.0 };
  std::string label;
  std::size_t array = 0; // number of the electrode
  int row = 0;           // from 1 on
  int column = 0;
  bool isMissing = false;
};

template <typename Array, typename Value>
void addArray(
  vtkPolyData* data, const char* name, const std::vector<Result>& results, const Value& valueOf)
{
  vtkNew<Array> array;
  array->SetName(name);
  for (const Result& result : results)
  {
    array->InsertNextValue(valueOf(result));
  }
  data->GetPointData()->AddArray(array);
}

template <typename Value>
void addVectors(
  vtkPolyData* data, const char* name, const std::vector<Result>& results, const Value& valueOf)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  for (const Result& result : results)
  {
    const glm::dvec3 value = valueOf(result);
    array->InsertNextTuple3(value.x, value.y, value.z);
  }
  data->GetPointData()->AddArray(array);
}

std::string joined(const std::vector<std::string>& parts, const char* between)
{
  std::string text;
  for (const std::string& part : parts)
  {
    text += (&part == parts.data() ? "" : between) + part;
  }
  return text;
}

// A sentence about contacts that are not on the cortex; empty if all are.
std::string doubtAboutOff(const std::vector<Result>& results)
{
  std::vector<std::string> names;
  std::size_t count = 0;
  for (const Result& result : results)
  {
    if (result.place.isOff())
    {
      ++count;
      if (names.size() < MostNamed)
      {
        names.push_back(result.label + " (" + roundedText(std::abs(result.place.outside)) + " mm " +
          (result.place.outside > 0.0 ? "above" : "buried") + ")");
      }
    }
  }
  return count == 0
    ? std::string()
    : "Not on the cortex that all other contacts show, and left out: " + joined(names, ", ") +
      (count > names.size() ? " and " + std::to_string(count - names.size()) + " others" : "");
}

// Whether a position is too near to the opening for the cortex to be held: that of a mask, or a
// ball without one.
std::function<bool(const glm::dvec3&)> openingOf(vtkImageData* image, const OpeningBall& ball)
{
  if (!image)
  {
    return [ball](const glm::dvec3& rest) {
      return glm::distance(rest, ball.centre) < ball.radiusMm + AnchorMarginMm;
    };
  }
  const auto opening = std::make_shared<const Mask>(
    readMask(image, {}, gridOf(image), { "opening", "cortex", "labels" }));
  const auto near = std::make_shared<const NearMask>(*opening, AnchorMarginMm);
  return [opening, near](const glm::dvec3& rest) { return near->holds(rest); };
}

// Whether a sheet has contacts in two rows and in two columns: one line of them can turn.
bool isSpread(const ContactArray& array)
{
  std::vector<bool> rows(array.rows, false);
  std::vector<bool> columns(array.columns, false);
  for (std::size_t k = 0; k < array.contacts.size(); ++k)
  {
    if (array.contacts[k])
    {
      rows[k / array.columns] = true;
      columns[k % array.columns] = true;
    }
  }
  return std::count(rows.begin(), rows.end(), true) > 1 &&
    std::count(columns.begin(), columns.end(), true) > 1;
}
}

struct vtkElectrodeGrids::State
{
  CortexSource Images;
  RestCortex Surface; // of triangles
  vtkPolyData* SurfaceOf = nullptr;
  vtkMTimeType SurfaceTime = 0; // without SurfaceOf: the version of Images
  const RestCortex* Cortex = nullptr;
  std::vector<Contact> Contacts;
  std::vector<ContactArray> Arrays;
  std::vector<double> DeepestMm; // below the cortex at rest, of each electrode
  std::vector<Result> Results;
  std::string Problem = NotRun;
  std::string Warning;
  std::string WarnedOf;

  void findDeepest(const DepthBelowCortex& depth)
  {
    this->DeepestMm.clear();
    for (const ContactArray& array : this->Arrays)
    {
      double deepest = 0.0;
      for (const std::size_t contact : array.members)
      {
        deepest = std::max(deepest, depth(this->Contacts[contact].position));
      }
      this->DeepestMm.push_back(deepest);
    }
  }

  // Puts a contact that is on no grid where it was measured.
  void addAlone(std::size_t contact, std::size_t array)
  {
    Result& result = this->Results[contact];
    result.place.rest = result.place.bent = result.measured = this->Contacts[contact].position;
    result.place.deviation = result.place.outside = result.place.leftOut = NaN;
    result.place.outsideDeviation = NaN;
    result.label = this->Contacts[contact].label;
    result.array = array;
  }

  // Takes the places of a sheet; missing ones come at the end.
  void add(const std::vector<SheetPlace>& places, std::size_t number)
  {
    const ContactArray& array = this->Arrays[number];
    for (std::size_t k = 0; k < places.size(); ++k)
    {
      Result result;
      result.place = places[k];
      result.label = array.labels[k];
      result.array = number;
      result.row = static_cast<int>(k) / array.columns + 1;
      result.column = static_cast<int>(k) % array.columns + 1;
      if (const std::optional<std::size_t> contact = array.contacts[k])
      {
        result.measured = this->Contacts[*contact].position;
        this->Results[*contact] = result;
      }
      else
      {
        result.isMissing = true;
        result.measured = places[k].bent;
        this->Results.push_back(result);
      }
    }
  }

  void warn(const std::string& sides)
  {
    std::vector<std::string> sentences;
    if (!sides.empty())
    {
      sentences.push_back(sides);
    }
    for (const ContactArray& array : this->Arrays)
    {
      sentences.insert(sentences.end(), array.doubts.begin(), array.doubts.end());
    }
    const std::string off = doubtAboutOff(this->Results);
    if (!off.empty())
    {
      sentences.push_back(off);
    }
    this->Warning = joined(sentences, ". ");
  }

  // Whether a contact lies on the cortex: one of a grid that is not off, or of a strip or an
  // electrode without an order that does not go deep, as a shaft that bends would.
  bool isOnCortex(const Result& result) const
  {
    const ArrayKind kind = this->Arrays[result.array].kind;
    const bool isFlat = kind == ArrayKind::Strip || kind == ArrayKind::Unknown;
    return isFlat ? this->DeepestMm[result.array] < DeepestOnCortexMm
                  : result.row > 0 && !result.place.isOff();
  }

  // Contacts on the cortex where they were measured, to be traced points.
  void writeOnCortex(vtkPolyData* output) const
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> vertices;
    vtkNew<vtkStringArray> labels;
    labels->SetName("Label");
    for (const Result& result : this->Results)
    {
      if (!result.isMissing && this->isOnCortex(result))
      {
        const glm::dvec3& at = result.measured;
        const vtkIdType number = points->InsertNextPoint(at.x, at.y, at.z);
        vertices->InsertNextCell(1, &number);
        labels->InsertNextValue(result.label);
      }
    }
    output->SetPoints(points);
    output->SetVerts(vertices);
    output->GetPointData()->AddArray(labels);
  }

  void write(vtkPolyData* output, bool withMissing) const
  {
    std::vector<Result> results = this->Results;
    if (!withMissing)
    {
      results.resize(this->Contacts.size());
    }
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> vertices;
    for (const Result& result : results)
    {
      const glm::dvec3& rest = result.place.rest;
      const vtkIdType number = points->InsertNextPoint(rest.x, rest.y, rest.z);
      vertices->InsertNextCell(1, &number);
    }
    output->SetPoints(points);
    output->SetVerts(vertices);
    addArray<vtkStringArray>(
      output, "Label", results, [](const Result& result) { return result.label; });
    addArray<vtkStringArray>(output, "Array", results,
      [&](const Result& result) { return this->Arrays[result.array].name; });
    addArray<vtkIntArray>(output, "Electrode", results,
      [](const Result& result) { return static_cast<int>(result.array) + 1; });
    addArray<vtkStringArray>(output, "Kind", results,
      [&](const Result& result) { return std::string(nameOf(this->Arrays[result.array].kind)); });
    addArray<vtkIntArray>(output, "Row", results, [](const Result& result) { return result.row; });
    addArray<vtkIntArray>(
      output, "Column", results, [](const Result& result) { return result.column; });
    addArray<vtkIntArray>(
      output, "Missing", results, [](const Result& result) { return result.isMissing ? 1 : 0; });
    addVectors(output, "Measured", results, [](const Result& result) { return result.measured; });
    addVectors(output, "Bent", results, [](const Result& result) { return result.place.bent; });
    addArray<vtkDoubleArray>(
      output, "Outside", results, [](const Result& result) { return result.place.outside; });
    addArray<vtkDoubleArray>(
      output, "Deviation", results, [](const Result& result) { return result.place.deviation; });
    addArray<vtkDoubleArray>(
      output, "LeftOut", results, [](const Result& result) { return result.place.leftOut; });
    addArray<vtkDoubleArray>(output, "Weight", results, [](const Result& result) {
      const bool isKnown = result.row > 0 && !result.place.isOff();
      return isKnown ? 1.0 : 0.0;
    });
  }
};

vtkStandardNewMacro(vtkElectrodeGrids);
brainshiftGuardRequestsMacro(vtkElectrodeGrids);
brainshiftInputsOfAllRanksMacro(vtkElectrodeGrids);

vtkElectrodeGrids::vtkElectrodeGrids()
  : Internal(std::make_unique<State>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(2);
}

vtkElectrodeGrids::~vtkElectrodeGrids() = default;

void vtkElectrodeGrids::AddContactName(const char* name)
{
  this->ContactNames.emplace_back(name ? name : "");
  this->Modified();
}

void vtkElectrodeGrids::ClearContactNames()
{
  this->ContactNames.clear();
  this->Modified();
}

void vtkElectrodeGrids::AddContactGroup(const char* name)
{
  this->ContactGroups.emplace_back(name ? name : "");
  this->Modified();
}

void vtkElectrodeGrids::ClearContactGroups()
{
  this->ContactGroups.clear();
  this->Modified();
}

void vtkElectrodeGrids::AddShape(const char* hint)
{
  this->Shapes.emplace_back(hint ? hint : "");
  this->Modified();
}

void vtkElectrodeGrids::ClearShapes()
{
  this->Shapes.clear();
  this->Modified();
}

std::string vtkElectrodeGrids::GetElectrodes() const
{
  std::string text;
  for (const ContactArray& array : this->Internal->Arrays)
  {
    std::vector<std::string> missing;
    for (std::size_t k = 0; k < array.contacts.size(); ++k)
    {
      if (!array.contacts[k])
      {
        missing.push_back(array.labels[k]);
      }
    }
    text += (text.empty() ? "" : "\n") + array.name + "\t" + nameOf(array.kind) + "\t" +
      std::to_string(array.rows) + "\t" + std::to_string(array.columns) + "\t" +
      numberText(array.pitchMm) + "\t" + (array.byLabels ? "1" : "0") + "\t" +
      joined(array.labels, ",") + "\t" + joined(missing, ",");
  }
  return text;
}

std::string vtkElectrodeGrids::GetWarning() const
{
  return this->Internal->Warning;
}

std::string vtkElectrodeGrids::GetProblem() const
{
  return this->Internal->Problem;
}

int vtkElectrodeGrids::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPointSet" : "vtkImageData");
  if (port == CortexPort)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  }
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port == OpeningPort ? 1 : 0);
  return 1;
}

int vtkElectrodeGrids::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  this->Internal->Problem = NotRun; // if something upstream fails, RequestData is never called
  askForOwnPoints(inputs[0]->GetInformationObject(0));
  if (vtkImageData::GetData(inputs[CortexPort]))
  {
    updateWholeExtent(inputs[CortexPort]->GetInformationObject(0));
  }
  updateWholeExtent(inputs[OpeningPort]->GetInformationObject(0));
  return 1;
}

void vtkElectrodeGrids::ReadContacts(vtkInformationVector** inputs)
{
  State& state = *this->Internal;
  const vtkSmartPointer<vtkPointSet> points = pointsOfAllRanks(vtkPointSet::GetData(inputs[0]));
  const std::vector<glm::dvec3> positions = positionsOf(points);
  auto* labels = points
    ? vtkStringArray::SafeDownCast(points->GetPointData()->GetAbstractArray("Label"))
    : nullptr;
  if (positions.empty() || positions.size() > MostContacts)
  {
    throw Problem("There are " + std::to_string(positions.size()) +
      " contacts; the limits are 1 and " + std::to_string(MostContacts));
  }
  state.Contacts.clear();
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    constexpr double FarthestMm = 1e6;
    if (!(glm::length(positions[i]) < FarthestMm)) // also rejects NaN
    {
      throw Problem("Contact " + std::to_string(i + 1) + " has no finite position");
    }
    Contact contact{ positions[i], "", "" };
    if (labels)
    {
      contact.label = labels->GetValue(static_cast<vtkIdType>(i));
    }
    else if (i < this->ContactNames.size())
    {
      contact.label = this->ContactNames[i];
    }
    if (i < this->ContactGroups.size())
    {
      contact.group = this->ContactGroups[i];
    }
    state.Contacts.push_back(std::move(contact));
  }
}

void vtkElectrodeGrids::FindCortex(vtkInformationVector** inputs)
{
  State& state = *this->Internal;
  if (vtkImageData* image = vtkImageData::GetData(inputs[CortexPort]))
  {
    const bool byLabel = this->SurfaceBy != 0;
    state.Images.find({ image, "volume", this->SurfaceArray, true, byLabel,
      byLabel ? this->Label : this->Threshold });
    if (state.SurfaceOf || state.SurfaceTime != state.Images.version())
    {
      state.Surface = state.Images.cortex().smoothed();
      state.SurfaceOf = nullptr;
      state.SurfaceTime = state.Images.version();
    }
    state.Cortex = &state.Surface;
    return;
  }
  vtkPolyData* surface = vtkPolyData::GetData(inputs[CortexPort]);
  if (!surface || surface->GetNumberOfPolys() == 0)
  {
    throw Problem("The cortex has no triangles");
  }
  if (state.SurfaceOf != surface || state.SurfaceTime != surface->GetMTime())
  {
    state.Surface = RestCortex(meshOf(surface));
    state.SurfaceOf = surface;
    state.SurfaceTime = surface->GetMTime();
  }
  state.Cortex = &state.Surface;
}

void vtkElectrodeGrids::Fit(vtkInformationVector** inputs)
{
  State& state = *this->Internal;
  std::vector<ArrayHint> hints;
  hints.reserve(this->Shapes.size());
  std::transform(this->Shapes.begin(), this->Shapes.end(), std::back_inserter(hints), hintIn);
  int hint = -1;
  const auto depth = [&](const glm::dvec3& position) {
    const std::optional<SurfacePoint> foot = state.Cortex->nearest(position, hint);
    return foot ? glm::dot(foot->normal, foot->position - position) : 0.0;
  };
  state.Arrays = recogniseArrays(state.Contacts, hints, depth);
  state.Results.assign(state.Contacts.size(), {});
  state.findDeepest(depth);
  std::vector<Sheet> sheets;
  std::vector<std::size_t> numbers;
  std::vector<glm::dvec3> onGrids;
  for (std::size_t number = 0; number < state.Arrays.size(); ++number)
  {
    const ContactArray& array = state.Arrays[number];
    for (const std::size_t contact : array.members)
    {
      state.addAlone(contact, number);
    }
    if (array.kind != ArrayKind::Grid || !isSpread(array))
    {
      continue;
    }
    Sheet sheet{ array.rows, array.columns, array.pitchMm, {} };
    for (const std::optional<std::size_t>& contact : array.contacts)
    {
      sheet.contacts.push_back(
        contact ? std::optional<glm::dvec3>(state.Contacts[*contact].position) : std::nullopt);
      if (contact)
      {
        onGrids.push_back(state.Contacts[*contact].position);
      }
    }
    sheets.push_back(std::move(sheet));
    numbers.push_back(number);
  }
  SheetSettings settings;
  settings.stiffness = this->Stiffness;
  settings.contactDeviation = this->ContactDeviation;
  const OpeningBall given{
    { this->OpeningCentre[0], this->OpeningCentre[1], this->OpeningCentre[2] }, this->OpeningRadius
  };
  const std::vector<SurfacePoint> anchors = chooseAnchors(state.Cortex->points(),
    openingOf(vtkImageData::GetData(inputs[OpeningPort]),
      this->OpeningRadius > 0.0 ? given : ballAround(onGrids)));
  std::vector<int> hintsOfPlaces(MostSheetPlaces, -1);
  const RestSurface surface = [&](const glm::dvec3& rest, std::size_t place) {
    return state.Cortex->nearest(rest, hintsOfPlaces[place]);
  };
  const std::vector<std::vector<SheetPlace>> places = fitSheets(sheets, surface, anchors, settings);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    state.add(places[i], numbers[i]);
  }
}

std::string vtkElectrodeGrids::DoubtsAboutSides(vtkInformationVector** inputs)
{
  NamedAxes contacts = axesOfContacts(this, this->PointAxes);
  contacts.space = Template::None;
  for (const auto& [port, noun] :
    { std::pair<int, const char*>{ CortexPort, "the cortex" }, { OpeningPort, "the opening" } })
  {
    // Surfaces come from many tools, which do not name their axes, and from scripts.
    vtkDataObject* given = vtkDataObject::GetData(inputs[port]);
    NamedAxes surface = namedAxesOfInput(noun, this, port);
    surface.space = Template::None;
    const bool isComparable = given && contacts.axes != WorldAxes::Unknown &&
      (surface.axes != WorldAxes::Unknown || vtkImageData::SafeDownCast(given));
    const std::string words = isComparable ? wordsOnSides(surface, contacts) : std::string();
    if (!words.empty())
    {
      return words; // one sentence is enough
    }
  }
  return {};
}

int vtkElectrodeGrids::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  State& state = *this->Internal;
  state.Problem = NotRun; // if memory runs out, this stays
  state.Arrays.clear();
  state.Results.clear();
  state.Warning.clear();
  try
  {
    this->ReadContacts(inputs);
    this->FindCortex(inputs);
    this->Fit(inputs);
    state.Problem.clear();
  }
  catch (const Problem& problem)
  {
    state.Arrays.clear();
    state.Problem = problem.what();
    throw;
  }
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  vtkPolyData* onCortex = vtkPolyData::GetData(outputs, 1);
  if (isFirstRank()) // all ranks fitted all contacts, which must not count once for each rank
  {
    state.write(output, this->ShowMissing);
    state.writeOnCortex(onCortex);
  }
  for (vtkPolyData* each : { output, onCortex })
  {
    nameWorldAxes(each, axesOfContacts(this, this->PointAxes).axes);
  }
  state.warn(this->DoubtsAboutSides(inputs));
  warnAnew(this, state.Warning, state.WarnedOf);
  return 1;
}

void vtkElectrodeGrids::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SurfaceBy: " << (this->SurfaceBy ? "Label" : "Threshold") << "\n"
     << indent << "Stiffness: " << this->Stiffness << "\n"
     << indent << "ContactDeviation: " << this->ContactDeviation << "\n"
     << indent << "PointAxes: " << this->PointAxes << "\n"
     << indent << "Electrodes: " << this->GetElectrodes() << "\n";
}
