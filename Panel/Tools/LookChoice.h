// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The looks (presets) of a volume, as panel and toolbar offer and apply them.
#ifndef BrainShift_LookChoice_h
#define BrainShift_LookChoice_h

#include <QIcon>
#include <QMenu>
#include <QString>
#include <QStringList>

class pqDataRepresentation;

namespace brainshift
{
/// A small picture of a look.
QIcon iconOfLook(const QString& name);

/// The tooltip of a look, one sentence.
QString tipOfLook(const QString& name);

/// The looks that a display can have. "Brain" is one of them also where a mask or label map is open
/// that is not yet the Segmentation; its name follows if there are several: "Brain: tumour.nii".
QStringList looksOf(pqDataRepresentation* display);

/// Gives a display a look, as one step to undo, and remembers it for volumes of its kind. A look of
/// a label map that is open makes it the Segmentation.
void chooseLook(pqDataRepresentation* display, const QString& name);

/// Menu of the toolbar with the looks of the volume that the active view shows. It reads the volume
/// when it opens.
class LookMenu : public QMenu
{
  Q_OBJECT

public:
  LookMenu(QWidget* parent = nullptr);

private:
  void offer();
};
}

#endif
