// ReadSession.h - a session read for viewing: everything except the samples and commands, and the data for its picture.
//
// Thread-safety: values; readSession() only reads the file, and runs on another thread.
#pragma once

#include <QString>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/runner/SheetView.h"
#include "app/gui/theme/MarkLines.h"
#include "app/report/CompareSessions.h"
#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/session/SessionSignature.h"
#include "core/session/SessionTypes.h"

namespace tacto::gui {

/// The data drawn for a session without trials and figures: what the fingertip felt and what was delivered. A long
/// session has no more of them than a picture shows.
struct SessionCourse {
    std::vector<double> frame_s, roughness, pressure;
    std::vector<double> train_s, amplitude;
    QString unit;              ///< unit of the amplitudes, "V" or "mA"
    std::int64_t oneIn = 1;    ///< of so many stretches, frames hold one
    std::size_t perTrain = 1;  ///< of so many trains, the largest amplitude is here
    [[nodiscard]] bool empty() const { return frame_s.empty() && train_s.empty(); }
};

/// A capture with what it is of, as far as the session says so.
struct ReadCapture : SessionCaptureInfo {
    QString load;     ///< "1 kΩ": of its trial, as set for the run, or as the stimulator measured it
    QString command;  ///< "40 V every 500 ms"; of a trial with several, "10 to 40 V every 500 ms"
};

struct ReadSession : ComparedSession, SessionFigure {
    std::filesystem::path path;
    std::vector<CheckedSignature> signatures;  ///< of its reports
    QString fixed;           ///< a sentence that says why the labels cannot be changed; empty if they can
    bool elsewhere = false;  ///< another program is recording this session
    std::string head;
    std::vector<std::string> marks;  ///< the marks from sessionMarks()
    std::vector<SessionRow> events;
    std::vector<SessionRow> log;
    std::vector<SessionStreamInfo> streams;
    std::vector<ReadCapture> captures;
    SessionCourse course;  ///< filled only without figure and plane
};
/// Errors: as SessionReader.
[[nodiscard]] Result<ReadSession> readSession(const std::filesystem::path& path);
/// Returns the operator's marks in order, on the session's time base.
[[nodiscard]] std::vector<PlotMark> operatorMarks(const ReadSession& session);

}  // namespace tacto::gui
