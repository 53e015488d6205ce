// ReadSession.h - a session read for looking at: everything but the samples, and what its picture is made of.
//
// Thread-safety: values; readSession() is pure but for the file, and runs beside the window.
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

/// The data to draw for a session without trials and figures: what the fingertip felt and what was delivered.
struct SessionCourse {
    std::vector<double> frame_s, roughness, pressure;
    std::vector<double> train_s, amplitude;
    QString unit;  ///< the amplitudes' unit, "V" or "mA"
    [[nodiscard]] bool empty() const { return frame_s.empty() && train_s.empty(); }
};

struct ReadSession {
    std::filesystem::path path;
    SessionAbout about;
    SessionLabels labels;
    QString fixed;  ///< why the labels cannot be changed, a sentence; empty when they can
    bool closed = false;
    bool elsewhere = false;  ///< another program is recording it
    std::string head;
    Instant length{0};
    std::vector<std::string> marks;  ///< the marks from sessionMarks()
    std::vector<SessionVerdict> verdicts;
    std::vector<SessionTrial> trials;
    std::vector<SessionRow> events;
    std::vector<SessionRow> log;
    std::vector<SessionStreamInfo> streams;
    std::vector<SessionCaptureInfo> captures;
    std::map<std::string, nlohmann::json> settings;  ///< values by name: "label", "unit", or words shown for a choice
    std::optional<Figure> figure;                    ///< the first of its report that is not a plane of trials
    QString caption;                                 ///< the figure's caption
    bool planeOfTrials = false;                      ///< draws the trials' amplitude over their interval
    SessionCourse course;                            ///< filled in where there is no figure and no plane
    std::uint64_t trains = 0;                        ///< delivered, impedance checks apart
    double most = 0;                                 ///< largest amplitude, in `unit`
    QString unit;
};
/// Errors: as SessionReader.
[[nodiscard]] Result<ReadSession> readSession(const std::filesystem::path& path);
/// The operator's marks on the session's time base, in its order.
[[nodiscard]] std::vector<PlotMark> operatorMarks(const ReadSession& session);

}  // namespace tacto::gui
