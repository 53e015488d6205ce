// NoticeBanner.h - what went wrong, above the workspaces until it is dismissed or over, with what it means for the
// output; the line at the bottom says it too, and keeps it.
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
    /// Both outlive this. Shows what the controller reports.
    NoticeBanner(BenchController& controller, RecordingLine& line, QWidget* parent);
    void complain(const QString& what);
    /// As often as telemetry is read: states and faults, into the log.
    void refresh(const Telemetry& telemetry);

private:
    void sayState(const Telemetry& telemetry);
    void sayFault(const Telemetry& telemetry);
    void sayEnd(const std::shared_ptr<const FinishedRun>& run);

    BenchController& controller_;
    RecordingLine& line_;
    QLabel* text_;
    bool saidArmed_ = false;       ///< and nothing since that it is over
    int framesWithoutReason_ = 0;  ///< since the bench disarmed
    int faultedFrames_ = 0;        ///< since the bench faulted
};

}  // namespace tacto::gui
