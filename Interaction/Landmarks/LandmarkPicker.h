// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Takes clicks in all render views while a person picks pairs of landmarks: first the tissue, then
/// where it was measured. A press that turns into a drag goes on to the camera, and so do the wheel
/// and the other buttons. A half pair is kept here, so that the fit sees whole pairs only.
#ifndef BrainShift_LandmarkPicker_h
#define BrainShift_LandmarkPicker_h

#include "Interaction/Views/CursorProbe.h"

#include <QObject>

#include <vector>

class pqDataRepresentation;
class pqPipelineSource;
class pqRenderView;
class vtkObject;
class vtkRenderWindowInteractor;

namespace brainshift
{
class LandmarkPicker : public QObject
{
  Q_OBJECT

public:
  /// The application has one hand, so it has one picker.
  static LandmarkPicker* instance();

  /// Picks pairs for a Free-Form Deformation from now on, and puts down the tool in hand.
  void start(pqPipelineSource* deformation);
  /// Forgets a half pair.
  void stop();
  /// The Free-Form Deformation that pairs are picked for. Null: none are picked.
  pqPipelineSource* deformation() const;

  /// The tissue of a half pair.
  struct Half
  {
    glm::dvec3 rest;  ///< mm, rest frame.
    glm::dvec3 drawn; ///< mm, where it is drawn.
  };
  const std::optional<Half>& half() const { return this->Picked; }

  /// Escape stops.
  bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
  /// Picking began or ended, or there is a half pair.
  void changed();

private:
  explicit LandmarkPicker(QObject* parent);

  void watch(pqRenderView* view);
  void forgetViews();

  /// Observer of an interactor. True: the event ends here.
  bool onPress(vtkObject* interactor, unsigned long event, void* data);
  /// Observer of an interactor. True: the event ends here.
  bool onMove(vtkObject* interactor, unsigned long event, void* data);
  /// Observer of an interactor. True: the event ends here.
  bool onRelease(vtkObject* interactor, unsigned long event, void* data);

  void pick(pqRenderView* view, const glm::ivec2& pixel);
  void request(const QString& before = QString());

  struct Watched
  {
    QPointer<pqRenderView> view;
    vtkSmartPointer<vtkRenderWindowInteractor> interactor;
    std::vector<unsigned long> observers;
  };
  const Watched* watched(vtkObject* interactor) const;

  std::vector<Watched> Views;
  QPointer<pqPipelineSource> Deformation;
  CursorProbe Probe;
  std::optional<Half> Picked;
  vtkObject* PressedIn = nullptr; ///< An interactor. Null: the button is up, or the camera's.
  glm::ivec2 PressedAt{ 0 };      ///< Pixels from the lower left corner.
  bool Passing = false;           ///< A press goes on to the camera right now.
};

// What the views show together of a bent volume and its reference.

/// Brings the slices of all views to a position (mm) where a Free-Form Deformation is drawn: those
/// of it, those of its volume as loaded to the same tissue, those of others to the position.
void bringCrosshairTo(pqPipelineSource* deformation, const glm::dvec3& drawn);

/// Whether a display shows neither the volume of a Free-Form Deformation at rest nor one of its
/// deformations, and is not moved, nor moved by a comparison with it: a landmark of it may be
/// measured there.
bool showsOther(pqPipelineSource* deformation, pqDataRepresentation* display);

/// Whether a view shows a reference: a comparison of the Free-Form Deformation, or another volume.
bool isReferenceShown(pqPipelineSource* deformation);
}

#endif
