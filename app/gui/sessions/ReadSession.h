// ReadSession.h - a session read for viewing: everything except the samples, and the data for its picture.
//
// Thread-safety: values; readSession() only reads the file, and runs on another thread.
#pragma once

#include <QString>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/theme/MarkLines.h"
#include "app/report/Figure.h"
#include "core/base/Result.h"
#include "core/base/Stream.h"
#include "core/session/SessionTypes.h"

namespace tacto::gui {

/// The data drawn for a session without trials and figures: what the fingertip felt and what was delivered.
struct SessionCourse {
    std::vector<double> frame_s, roughness, pressure;
    std::vector<double> train_s, amplitude;
    QString unit;  ///< unit of the amplitudes, "V" or "mA"
    [[nodiscard]] bool empty() const { return frame_s.empty() && train_s.empty(); }
};

struct ReadSession {
    std::filesystem::path path;
    SessionAbout about;
    SessionLabels labels;
    QString fixed;  ///< a sentence that says why the labels cannot be changed; empty if they can
    bool closed = false;
    bool elsewhere = false;  ///< another program is recording this session
    std::string head;
    Instant length{0};
    std::vector<std::string> marks;  ///< the marks from sessionMarks()
    std::vector<SessionVerdict> verdicts;
    std::vector<SessionTrial> trials;
    std::vector<SessionRow> events;
    std::vector<SessionRow> log;
    std::vector<SessionStreamInfo> streams;
    std::vector<SessionCaptureInfo> captures;
    std::map<std::string, nlohmann::json> settings;  ///< by name: "label", "unit", or a choice's displayed words
    std::optional<Figure> figure;                    ///< the report's first figure that is not a plane of trials
    QString caption;                                 ///< the figure's caption
    bool planeOfTrials = false;                      ///< draw the trials' amplitude against their interval
    SessionCourse course;                            ///< filled only without figure and plane
    std::uint64_t trains = 0;                        ///< trains delivered, without impedance checks
    double most = 0;                                 ///< largest amplitude in `unit`
    QString unit;
};
/// Errors: as SessionReader.
[[nodiscard]] Result<ReadSession> readSession(const std::filesystem::path& path);
/// Returns the operator's marks in order, on the session's time base.
[[nodiscard]] std::vector<PlotMark> operatorMarks(const ReadSession& session);

}  // namespace tacto::gui
