// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNRRDVolumeReader.h"

#include "Filters/Fields/FieldFile.h"
#include "Filters/Volumes/TextHeaderVolume.h"

#include "vtkObjectFactory.h"
#include "vtkStringArray.h"

#include <memory>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkNRRDVolumeReader);

vtkNRRDVolumeReader::vtkNRRDVolumeReader()
  : vtkNRRDVolumeReader(
      std::make_unique<brainshift::TextHeaderVolume>(brainshift::TextFormat::NRRD).release())
{
}

vtkNRRDVolumeReader::vtkNRRDVolumeReader(brainshift::TextHeaderVolume* volume)
  : vtkVolumeFileReader(std::unique_ptr<brainshift::VolumeFile>(volume))
  , Volume(volume)
{
}

vtkNRRDVolumeReader::~vtkNRRDVolumeReader() = default;

void vtkNRRDVolumeReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Layer: " << this->Layer << "\n";
}

int vtkNRRDVolumeReader::CanReadFile(const char* fileName)
{
  using namespace brainshift;
  const bool isVolume = fileName && isTextHeaderVolume(fileName, TextFormat::NRRD);
  return isVolume && !isFieldFile(fileName) ? 1 : 0;
}

void vtkNRRDVolumeReader::SetLayer(const char* name)
{
  const std::string layer = name ? name : "";
  if (layer == this->Layer)
  {
    return;
  }
  // ParaView writes the name of the layer that is shown into the property. The file need not be
  // read again for that.
  const std::vector<std::string>& names = this->Volume->layerNames();
  const bool isShown = this->Layer.empty() && !names.empty() && names.front() == layer;
  this->Layer = layer;
  this->Volume->setLayer(layer);
  if (!isShown)
  {
    this->Modified();
  }
}

vtkStringArray* vtkNRRDVolumeReader::GetLayerList()
{
  this->LayerList->Initialize();
  for (const std::string& name : this->Volume->layerNames())
  {
    this->LayerList->InsertNextValue(name);
  }
  return this->LayerList;
}
