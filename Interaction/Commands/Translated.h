// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Translates texts of functions that belong to no QObject.
#ifndef BrainShift_Translated_h
#define BrainShift_Translated_h

#include <QCoreApplication>
#include <QString>

namespace brainshift
{
inline QString tr(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}
}

#endif
