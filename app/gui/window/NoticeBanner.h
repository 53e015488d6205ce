// NoticeBanner.h - what went wrong, until it is dismissed or over, with what it means for the output; the line at the
// bottom says it too, and keeps it.
//
// It lies over the lower edge of the workspace, so that nothing moves, beside a procedure's path with its Run and above
// what can be done with a result.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QFrame>

#include "app/gui/controller/BenchController.h"

class QLabel;

namespace tacto::gui {

class RecordingLine;

class NoticeBanner final : public QFrame {
    Q_OBJECT
public:
    /// All outlive this. Shows what the controller reports. `over`: the widget at whose lower edge it lies.
    NoticeBanner(BenchController& controller, RecordingLine& line, QWidget& over);
    void complain(const QString& what);
    /// As often as telemetry is read: states and faults, into the log.
    void refresh(const Telemetry& telemetry);

protected:
    bool event(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    /// The part of the workspace that it may lie over: the page may be another with each frame.
    [[nodiscard]] QRect room() const;
    void lieDown();
    void sayState(const Telemetry& telemetry);
    void sayFault(const Telemetry& telemetry);
    void sayEnd(const std::shared_ptr<const FinishedRun>& run);

    BenchController& controller_;
    RecordingLine& line_;
    QWidget& over_;
    QLabel* text_;
    bool saidArmed_ = false;       ///< and nothing since that it is over
    int framesWithoutReason_ = 0;  ///< since the bench disarmed
    int faultedFrames_ = 0;        ///< since the bench faulted
};

}  // namespace tacto::gui
