// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/Lineage.h"

#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QJsonDocument>
#include <QUuid>

namespace brainshift
{
namespace
{
constexpr const char* Identity = "BrainShift.Identity";
constexpr const char* Fitted = "BrainShift.Fitted";

vtkSMProxy* inputOf(vtkSMProxy* proxy, const char* name)
{
  if (!proxy || !proxy->GetProperty(name))
  {
    return nullptr;
  }
  const vtkSMPropertyHelper input(proxy, name);
  return input.GetNumberOfElements() > 0 ? input.GetAsProxy() : nullptr;
}

QString fileOf(vtkSMProxy* source)
{
  for (const char* name : { "FileName", "FileNames" })
  {
    if (source->GetProperty(name))
    {
      const vtkSMPropertyHelper file(source, name);
      return file.GetNumberOfElements() > 0 ? QString(file.GetAsString()) : QString();
    }
  }
  return {};
}

// The number of a proxy is another one once a state brings it back, so it gets an identity.
QJsonArray identityOf(vtkSMProxy* source)
{
  if (!source)
  {
    return {};
  }
  if (!source->HasAnnotation(Identity))
  {
    source->SetAnnotation(Identity, QUuid::createUuid().toString(QUuid::Id128).toUtf8().data());
  }
  return { QString(source->GetAnnotation(Identity)), fileOf(source) };
}

QJsonArray numbersOf(vtkSMProxy* proxy, const char* name)
{
  QJsonArray found;
  for (const double number : vtkSMPropertyHelper(proxy, name).GetDoubleArray())
  {
    found.append(number);
  }
  return found;
}
}

QJsonArray landmarksFittedBy(vtkSMProxy* lattice)
{
  QJsonArray found;
  for (; lattice; lattice = inputOf(lattice, "Base"))
  {
    if (lattice->HasAnnotation(Fitted))
    {
      for (const QJsonValue one : QJsonDocument::fromJson(lattice->GetAnnotation(Fitted)).array())
      {
        found.append(one);
      }
    }
    if (vtkSMProxy* rest = inputOf(lattice, "RestLandmarks"))
    {
      found.append(identityOf(rest));
    }
  }
  return found;
}

void keepFitted(vtkSMProxy* lattice, const QJsonArray& landmarks)
{
  lattice->SetAnnotation(Fitted, QJsonDocument(landmarks).toJson(QJsonDocument::Compact).data());
}

QJsonObject comparedBy(vtkSMProxy* deformation, vtkSMProxy* comparison)
{
  QJsonArray pose = numbersOf(comparison, "ReferenceTranslation");
  for (const QJsonValue angle : numbersOf(comparison, "ReferenceRotation"))
  {
    pose.append(angle);
  }
  return { { "volume", identityOf(inputOf(deformation, "Input")) },
    { "reference", identityOf(inputOf(comparison, "Reference")) },
    { "cavity", identityOf(inputOf(comparison, "Cavity")) }, { "pose", pose },
    { "labels", numbersOf(comparison, "CavityLabels") } };
}
}
