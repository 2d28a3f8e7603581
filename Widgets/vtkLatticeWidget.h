// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLatticeWidget
 * @brief   passes mouse events to a tool before the camera gets them
 *
 * The meaning of an event depends on the tissue under the cursor, and only ParaView's client can
 * ask for that. So the widget passes each event to its handler. If the handler takes the event, the
 * camera does not get it. After the handler took a press, it gets all events until the release.
 */
#ifndef vtkLatticeWidget_h
#define vtkLatticeWidget_h

#include "vtkAbstractWidget.h"
#include "vtkBrainShiftWidgetsModule.h" // for the export macro

#include <functional>

class vtkLatticeRepresentation;

namespace brainshift
{
/// An event of the mouse.
struct HandEvent
{
  enum class Kind
  {
    Move,
    Press,
    Release,
    Wheel,
    Leave,
  };
  Kind kind = Kind::Move;
  int x = 0; ///< Pixels from the lower left corner of the window.
  int y = 0;
  int clicks = 0; ///< Wheel: 1 forward (away from the user), -1 backward.
  bool shift = false;
  bool control = false;
  bool alt = false;
};
}

class VTKBRAINSHIFTWIDGETS_EXPORT vtkLatticeWidget : public vtkAbstractWidget
{
public:
  static vtkLatticeWidget* New();
  vtkTypeMacro(vtkLatticeWidget, vtkAbstractWidget);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Returns true if it takes the event. */
  using HandlerType = std::function<bool(const brainshift::HandEvent&)>;
  void SetHandler(HandlerType handler);

  /** Ends a press that the handler took; the next events go to the camera again. */
  void LetGo();

  void SetRepresentation(vtkLatticeRepresentation* representation);

  void SetEnabled(int enabling) override;
  void CreateDefaultRepresentation() override;

protected:
  vtkLatticeWidget();
  ~vtkLatticeWidget() override;

private:
  vtkLatticeWidget(const vtkLatticeWidget&) = delete;
  void operator=(const vtkLatticeWidget&) = delete;

  template <brainshift::HandEvent::Kind kind, int clicks = 0>
  void Listen(unsigned long vtkEvent, unsigned long widgetEvent);
  void Pass(brainshift::HandEvent::Kind kind, int clicks);

  HandlerType Handler;
  bool Holding = false;
};

#endif
