// ReportModel.h - what a report says, before it is known how it looks. The PDF and the HTML page are made from
// the same model, and the model from a session file alone (SessionReport.h).
//
// Thread-safety: values.
#pragma once

#include <QJsonArray>
#include <QJsonObject>
#include <QString>
#include <QStringList>
#include <variant>
#include <vector>

#include "app/report/Figure.h"

namespace tacto {

/// None: the protocol judges nothing (run live).
enum class ReportVerdict { None, Pass, Fail, Indeterminate, Stopped };

struct ReportDevice {
    QString role;  ///< "stimulator", "oscilloscope", ...
    QString name;
    QString uri;
    QString serial;
    QString firmware;
    bool simulated = false;
    QString origin;  ///< "real", "simulated", "replayed, origin not stated", ...
};

/// A thing used and what identifies it: {"separability.js", "sha256", "9f86d0…"}; {"Seed", "", "42"}.
struct ReportFact {
    QString name;
    QString value;
    bool isHash = false;  ///< set in a monospaced face, broken anywhere
};

struct ReportFigure {
    QString caption;
    Figure figure;
};

/// Rows of a script's `report.table`: objects whose keys are the columns and carry the unit ("amplitude_v"); values
/// may be numbers, texts, statistics or estimates.
struct ReportTable {
    QString caption;
    QStringList columns;  ///< their order; empty: as met in the rows
    QJsonArray rows;
};

struct ReportText {
    QString text;
};

using ReportItem = std::variant<ReportFigure, ReportTable, ReportText>;

/// A fault, refusal, stop or remark.
struct ReportEvent {
    double t_s = 0;  ///< on the session's time base
    QString kind;    ///< "fault", "refused", "stop", ...
    QString text;
    int count = 1;  ///< alike events in a row are counted, not repeated
};

struct ReportModel {
    QString title;
    QString purpose;
    QString protocol;  ///< "separability"
    QString session;   ///< the session's name: its file name without the ending
    QString started;   ///< ISO 8601 UTC
    double duration_s = kUnknown;
    ReportVerdict verdict = ReportVerdict::None;
    QStringList reasons;     ///< why that verdict; one sentence each
    bool simulated = false;  ///< any device of the session was simulated
    QStringList marks;       ///< what is simulated, replayed and real, a sentence each
    QString chainHead;       ///< hex; empty only when there is none yet
    QStringList damage;      ///< what verify finds wrong with the session; empty when it is intact
    std::vector<ReportDevice> devices;
    std::vector<ReportFact> settings;  ///< parameters with their units
    std::vector<ReportFact> identity;  ///< versions, seed, hashes
    std::vector<ReportItem> items;     ///< in the script's order
    std::vector<ExposureFigure::Row> exposure;
    std::vector<ReportEvent> events;
    QStringList reproduce;  ///< command lines
};

}  // namespace tacto
