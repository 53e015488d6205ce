// NoticeBanner.h - shows what went wrong and what that means for the output, until the user dismisses it or it is no
// longer true. The line at the bottom shows and logs the same text.
//
// Lies over the lower edge of the workspace, so that nothing moves; next to a procedure's path with its Run button, and
// above the buttons for a result.
#pragma once

#include <QFrame>
#include <functional>

#include "app/gui/controller/BenchController.h"

class QLabel;

namespace tacto::gui {

class RecordingLine;

class NoticeBanner final : public QFrame {
    Q_OBJECT
public:
    /// All arguments outlive this. Shows what the controller reports. `over`: the widget at whose lower edge it lies.
    NoticeBanner(BenchController& controller, RecordingLine& line, QWidget& over);
    void complain(const QString& what);
    /// Shows the text until the user dismisses it or `holds` turns from true to false. `holds` may be empty.
    void sayWhile(const QString& text, std::function<bool(const Telemetry&)> holds);
    /// Called as often as telemetry is read. Logs states and faults.
    void refresh(const Telemetry& telemetry);

protected:
    bool event(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    /// The part of the workspace that the banner may cover; it can change with the page in every frame.
    [[nodiscard]] QRect room() const;
    void lieDown();
    void sayState(const Telemetry& telemetry);
    void sayOn(InterlockState state);
    void sayFault(const Telemetry& telemetry);
    void sayEnd(const std::shared_ptr<const FinishedRun>& run);

    BenchController& controller_;
    RecordingLine& line_;
    QWidget& over_;
    QLabel* text_;
    std::function<bool(const Telemetry&)> holds_;  ///< the condition of the output of which the text speaks
    bool held_ = false;                            ///< the condition was true at the last refresh()
    bool saidArmed_ = false;                       ///< "Armed." was shown, and its end was not yet reported
    int framesWithoutReason_ = 0;                  ///< frames since the bench disarmed without a known reason
    int faultedFrames_ = 0;                        ///< frames since the bench faulted
};

}  // namespace tacto::gui
