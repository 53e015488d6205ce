// ReportModel.h - the contents of a report, without layout. PDF and HTML are made from the same model, and the model
// from a session file alone (SessionReport.h).
#pragma once

#include <QJsonArray>
#include <QJsonObject>
#include <QString>
#include <QStringList>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "app/report/Figure.h"
#include "core/base/Words.h"

namespace tacto {

/// None: the protocol makes no judgement (run live).
enum class ReportVerdict { None, Pass, Fail, Indeterminate, Stopped };

struct ReportDevice {
    QString role;  ///< as a word: "stimulator"
    QString name;
    QString uri;
    QString serial;
    QString firmware;
    bool simulated = false;
    QString origin;  ///< one of the origins in core/session/Origin.h
    [[nodiscard]] bool is(Role wanted) const { return role == QLatin1String(nameOf(wanted).data()); }
};

/// A thing that was used, with its identification: {"separability.js", "sha256", "9f86d0…"}; {"Seed", "", "42"}.
struct ReportFact {
    QString name;
    QString value;
    bool isHash = false;  ///< printed in a monospaced font, may break anywhere
    bool isOpen = false;  ///< not known: printed as a ruled line to write on
};

struct ReportFigure {
    QString caption;
    Figure figure;
};

/// Rows of a script's `report.table`: objects with the columns as keys, which include the unit ("amplitude_v"). Values
/// are numbers, texts, statistics or estimates.
struct ReportTable {
    QString caption;
    QStringList columns;  ///< their order; empty: the order in the rows
    QJsonArray rows;
};

struct ReportText {
    QString text;
};

/// The matrix from a script's `report.matrix`: one quantity or limit per row, one load or condition per column. A row
/// is {"title", "note", "unit", "limit", "compare", "set" or "sets", "cells"}; a cell is null (not asked for) or
/// {"value", "expanded_uncertainty", "margin_pct", "verdict", "text"}. The members present are shown, the share of the
/// limit first.
struct ReportMatrix {
    QString caption;
    QStringList columns;
    QJsonArray rows;
};

/// The results of a run, shown as the tables of their kind.
struct ReportResults {
    nlohmann::json results;
};

using ReportItem = std::variant<ReportFigure, ReportTable, ReportMatrix, ReportText, ReportResults>;

/// A channel of an instrument, and its known accuracy.
struct ReportInstrument {
    QString name;
    QString channel;
    QString states;    ///< "gain ± 0.5 %, offset ± 0.02 V"; "unknown"
    QString statedBy;  ///< "data sheet of …", "gain by certificate 4711 …", "digital twin"; "unknown"
};

/// The basis of a verdict, for page 1 of a report.
struct ReportBasis {
    std::vector<ReportFact> rule;     ///< how a value, its uncertainty and a limit give a verdict
    std::vector<ReportFact> restsOn;  ///< references, calibration
    std::vector<ReportInstrument> instruments;
    QString certificate;       ///< of the oscilloscope, and whether it was used; empty: none
    QStringList notEvaluated;  ///< what and why, "net charge into 1 kΩ: …"; empty: nothing is known to be missing
    QString operatorName;      ///< this and the following as entered; empty: not recorded
    QString sample;
    QString reviewer;
    QString ambient;
    QString note;  ///< added to the session after the run
    QString tags;
};

/// The data that make the report of a stimulator's calibration a certificate (CertificatePages.h).
struct ReportCertificate {
    QJsonObject details;       ///< as entered: CertificateDetails.h; missing entries are blank lines
    QJsonObject results;       ///< from report.certificate(): quantities, calibrations before and after
    QJsonObject oscilloscope;  ///< the certificate used for the oscilloscope's accuracy; empty: none
};

/// A fault, refusal, stop or remark.
struct ReportEvent {
    double t_s = 0;  ///< on the time base of the session
    QString kind;    ///< "fault", "refused", "stop", ...
    QString text;
    int count = 1;  ///< number of similar consecutive events, printed as one
};

struct ReportModel {
    QString title;
    QString purpose;
    QString protocol;    ///< "separability"
    QString resultKind;  ///< as the protocol declares; used for results that name no kind
    QString session;     ///< the session's file name without its ending
    QString started;     ///< ISO 8601 UTC
    double duration_s = kUnknown;
    ReportVerdict verdict = ReportVerdict::None;
    QStringList reasons;     ///< reasons for the verdict, one sentence each
    bool simulated = false;  ///< any device of the session was simulated
    QStringList marks;       ///< from sessionMarks(): origin, calibration, flags and known limit of roughness R
    QString chainHead;       ///< hexadecimal; empty only if there is none yet
    QStringList damage;      ///< what verification finds wrong with the session; empty if intact
    ReportBasis basis;
    std::optional<ReportCertificate> certificate;
    std::vector<ReportDevice> devices;
    std::vector<ReportFact> settings;           ///< parameters with their units
    std::vector<ReportFact> identity;           ///< versions, seed, hashes
    std::vector<ReportItem> items;              ///< in the script's order
    std::vector<ExposureFigure::Row> exposure;  ///< computed by the gate from the trains that it approved
    std::vector<ReportEvent> events;
    QStringList reproduce;  ///< command lines
};

}  // namespace tacto
