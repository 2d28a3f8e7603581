// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLatticeWidget
 * @brief   tells a tool of the mouse before the camera hears of it
 *
 * What the mouse means depends on the tissue under it, which only ParaView's client can ask for. So
 * the widget passes each event on to its handler and keeps it from the camera if the handler takes
 * it. While a button is held that was taken, all events are the handler's.
 */
#ifndef vtkLatticeWidget_h
#define vtkLatticeWidget_h

#include "vtkAbstractWidget.h"
#include "vtkBrainShiftWidgetsModule.h" // for the export macro

#include <functional>

class vtkLatticeRepresentation;

namespace brainshift
{
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
  int x = 0; // pixels from the window's lower left corner
  int y = 0;
  int clicks = 0; // Wheel: 1 forward (away from the user), -1 backward
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

  /** The button that is held is not the handler's any more. */
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
