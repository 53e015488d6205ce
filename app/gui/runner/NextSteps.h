// NextSteps.h - what comes after a result: one step that leads on, and others that make sense.
//
// Thread-safety: the GUI thread; nextStepsAfter() is pure.
#pragma once

#include <QPushButton>
#include <QWidget>
#include <functional>
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
    ChangeSettings  ///< change the settings and run again
};

/// The first step leads on from here. Leaves out steps that would need a session where the run left none.
[[nodiscard]] std::vector<NextStep> nextStepsAfter(const FinishedRun& run);

/// Buttons in a row, the first one filled. Where the row is too narrow for their icons they have none, and stand
/// closer; where it is too narrow for that they stand in several rows.
class NextStepBar final : public QWidget {
    Q_OBJECT
public:
    explicit NextStepBar(QWidget* parent = nullptr);
    void show(const std::vector<NextStep>& steps);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

signals:
    void chosen(tacto::gui::NextStep step);

private:
    struct Button {
        QPushButton* button;
        QIcon icon;
        int bare, whole;  ///< widths without and with it
    };
    void measure();
    /// The width with all buttons in one row.
    [[nodiscard]] int across(int Button::*width, int apart) const;
    void fit();
    /// Each button's place in rows of the present width. Returns their height.
    int flow(const std::function<void(const Button&, const QRect&)>& place = {}) const;
    std::vector<Button> buttons_;
};

}  // namespace tacto::gui
