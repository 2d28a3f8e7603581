// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Fuzz/Engine/Parsers.h"

#include "Formats/DICOM/DerivedHeader.h"

namespace brainshift::fuzz
{
void like(const Bytes& bytes)
{
  DICOMDataSet source;
  readLike(fileOf(bytes, ".dcm"), source);
  DerivedSet set = studyHeader(source);
  setNewSeries(source, set);
}
}
