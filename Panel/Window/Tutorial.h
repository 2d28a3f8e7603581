// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A guided start in seven steps: open, look, stamp, soft, pull, compare, save. Each step gives
/// one instruction, waits until it is done, and can be skipped. The window stays usable all the
/// time.
#ifndef BrainShift_Tutorial_h
#define BrainShift_Tutorial_h

#include <QDialog>
#include <QTimer>

#include <vector>

class QLabel;
class QObject;
class QProgressBar;
class QPushButton;

namespace brainshift
{
// ParaView's window of welcome. It waits for an answer and locks the main window until then.

/// Closes it if it is open. Returns whether it was.
bool closeWelcome();

/// Closes it as soon as it opens, in the next seconds, while `owner` lives.
void keepWelcomeAway(QObject* owner);

class Tutorial : public QDialog
{
  Q_OBJECT

public:
  /// Opens it at the first step, or brings the open one to the front.
  static void begin();

private:
  explicit Tutorial(QWidget* window);

  void addTexts();
  void addButtons();
  void help();
  void go(int step);
  void belongToWindow();
  void watch();
  bool isDone() const;
  void placeInCorner();

  int Step = 0;
  int StrokesBefore = 0;            ///< of the step's tool, when the step began
  std::vector<double> ColorsBefore; ///< of the volume, when the step began
  int ComparedBefore = 0;           ///< how often the volume was shown as loaded, when it began
  bool Saved = false;
  QProgressBar* Progress = nullptr;
  QLabel* Title = nullptr;
  QLabel* Text = nullptr;
  QPushButton* Help = nullptr; ///< does the step's first part
  QPushButton* Back = nullptr;
  QPushButton* Skip = nullptr;
  QTimer Watch;
  WId Owner = 0; ///< The main window's number, for which this window was shown as a tool.
};
}

#endif
