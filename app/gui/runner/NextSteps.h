// NextSteps.h - what comes after a result: one thing that goes on, and what else makes sense.
//
// Thread-safety: the GUI thread; nextStepsAfter() is pure.
#pragma once

#include <QHBoxLayout>
#include <QWidget>
#include <vector>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

enum class NextStep {
    UseProfile,     ///< the profile that the run made comes into force
    Check,          ///< the stored calibration is checked, at a few levels
    Calibrate,      ///< in full
    SafetyCheck,    ///< its workspace
    Live,           ///< its workspace
    Sign,           ///< the report, to be signed
    Session,        ///< everything that was recorded
    ChangeSettings  ///< and run again
};

/// The first one is what goes on from here. Nothing that would need a session where the run left none.
[[nodiscard]] std::vector<NextStep> nextStepsAfter(const FinishedRun& run);

/// As buttons in a row, the first one filled.
class NextStepBar final : public QWidget {
    Q_OBJECT
public:
    explicit NextStepBar(QWidget* parent = nullptr);
    void show(const std::vector<NextStep>& steps);

signals:
    void chosen(tacto::gui::NextStep step);

private:
    QHBoxLayout* row_;
};

}  // namespace tacto::gui
