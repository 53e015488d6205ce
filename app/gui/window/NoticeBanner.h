// NoticeBanner.h - what went wrong, with what it means for the output, until it is dismissed or what it says of the
// output is over; the line at the bottom says it too, and keeps it.
//
// It lies over the lower edge of the workspace, so that nothing moves, beside a procedure's path with its Run and above
// what can be done with a result.
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
    /// The arguments outlive this. Shows what the controller reports. `over`: the widget at whose lower edge it lies.
    NoticeBanner(BenchController& controller, RecordingLine& line, QWidget& over);
    void complain(const QString& what);
    /// Shows the text until it is dismissed or `holds` turns from true to false; empty: until it is dismissed.
    void sayWhile(const QString& text, std::function<bool(const Telemetry&)> holds);
    /// Called as often as telemetry is read: puts states and faults into the log.
    void refresh(const Telemetry& telemetry);

protected:
    bool event(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    /// The part of the workspace that it may lie over: the page may be another with each frame.
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
    std::function<bool(const Telemetry&)> holds_;  ///< the condition that the text tells of the output
    bool held_ = false;                            ///< held at the last refresh()
    bool saidArmed_ = false;                       ///< the bench was said to be armed, and not yet said to be over
    int framesWithoutReason_ = 0;                  ///< frames without a reason since the bench disarmed
    int faultedFrames_ = 0;                        ///< frames since the bench faulted
};

}  // namespace tacto::gui
