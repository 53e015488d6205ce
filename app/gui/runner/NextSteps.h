// NextSteps.h - the steps offered after a result: one recommended step, and other sensible ones.
//
// Thread-safety: the GUI thread; nextStepsAfter() is pure.
#pragma once

#include <QMenu>
#include <QPushButton>
#include <QWidget>
#include <functional>
#include <vector>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

enum class NextStep {
    ResetFault,     ///< reset the fault in which the run left the stimulator, and run again
    WithoutFault,   ///< run again on the simulated devices without their faults
    UseProfile,     ///< use the profile that the run made
    Check,          ///< check the stored calibration at a few levels
    Calibrate,      ///< calibrate fully
    SafetyCheck,    ///< open the safety check workspace
    Live,           ///< open the Live workspace
    Sign,           ///< sign the report
    Report,         ///< show the report, to print or save it
    Session,        ///< view the whole recorded session
    ChangeSettings  ///< change the settings and run again
};

/// Returns the steps, the recommended one first. Leaves out steps that need a session if the run left none.
[[nodiscard]] std::vector<NextStep> nextStepsAfter(const FinishedRun& run);

/// Buttons in a row, the first one filled; beside the report, a menu to save, find and print it. If the row is too
/// narrow, the buttons lose their icons and move closer; if still too narrow, they wrap to several rows.
class NextStepBar final : public QWidget {
    Q_OBJECT
public:
    explicit NextStepBar(QWidget* parent = nullptr);
    void show(const std::vector<NextStep>& steps);
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;
    /// The width of one line of buttons without their icons.
    [[nodiscard]] int lineWidth() const;

signals:
    void chosen(tacto::gui::NextStep step);
    /// The menu beside the report is about to be shown, and is to be filled.
    void reportMenuWanted(QMenu& menu);

private:
    struct Button {
        QPushButton* button;
        QIcon icon;
        int bare, whole;  ///< widths without and with the icon
    };
    QPushButton* add(const QString& text, const QString& tip, const QString& icon);
    void measure();
    /// Returns the width with all buttons in one row.
    [[nodiscard]] int across(int Button::*width, int apart) const;
    void fit();
    /// Places each button in rows of the present width. Returns the height of the rows.
    int flow(const std::function<void(const Button&, const QRect&)>& place = {}) const;
    std::vector<Button> buttons_;
};

}  // namespace tacto::gui
