// ReportModel.h - what a report says, before it is known how it looks. The PDF and the HTML page are made from
// the same model, and the model from a session file alone (SessionReport.h).
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

/// None: the protocol judges nothing (run live).
enum class ReportVerdict { None, Pass, Fail, Indeterminate, Stopped };

struct ReportDevice {
    QString role;  ///< its word
    QString name;
    QString uri;
    QString serial;
    QString firmware;
    bool simulated = false;
    QString origin;  ///< the origin: one of core/session/Origin.h
    [[nodiscard]] bool is(Role wanted) const { return role == QLatin1String(nameOf(wanted).data()); }
};

/// A thing used and what identifies it: {"separability.js", "sha256", "9f86d0…"}; {"Seed", "", "42"}.
struct ReportFact {
    QString name;
    QString value;
    bool isHash = false;  ///< set in a monospaced face, broken anywhere
    bool isOpen = false;  ///< not known: printed as a ruled line to write on
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

/// What a script's `report.matrix` gives: one quantity or limit per row, one load or condition per column. A row is an
/// object {"title", "note", "unit", "limit", "compare", "set" or "sets", "cells"}; a cell null (nothing asked there) or
/// {"value", "expanded_uncertainty", "margin_pct", "verdict", "text"}: what is there is shown, the share of the limit
/// first.
struct ReportMatrix {
    QString caption;
    QStringList columns;
    QJsonArray rows;
};

/// The results of a run, to be shown as the tables of its kind.
struct ReportResults {
    nlohmann::json results;
};

using ReportItem = std::variant<ReportFigure, ReportTable, ReportMatrix, ReportText, ReportResults>;

/// One channel of an instrument, and what is known about its accuracy.
struct ReportInstrument {
    QString name;
    QString channel;
    QString states;    ///< "gain ± 0.5 %, offset ± 0.02 V"; "unknown"
    QString statedBy;  ///< "data sheet of …", "gain by certificate 4711 …", "digital twin"; "unknown"
};

/// The basis of a verdict; page 1 of a report.
struct ReportBasis {
    std::vector<ReportFact> rule;     ///< how a value, its uncertainty and a limit become a verdict
    std::vector<ReportFact> restsOn;  ///< references, calibration
    std::vector<ReportInstrument> instruments;
    QString certificate;       ///< the oscilloscope's, and whether it was used; empty: none
    QStringList notEvaluated;  ///< what and why, "net charge into 1 kΩ: …"; empty: nothing is known to be left out
    QString operatorName;      ///< these as they were entered; empty: not recorded
    QString sample;
    QString reviewer;
    QString ambient;
    QString note;  ///< added to the session afterwards
    QString tags;
};

/// The parts that make the report of a stimulator's calibration a certificate (CertificatePages.h).
struct ReportCertificate {
    QJsonObject details;       ///< as entered: CertificateDetails.h; missing ones are open lines
    QJsonObject results;       ///< written by report.certificate(): quantities, before, kept
    QJsonObject oscilloscope;  ///< the certificate that the oscilloscope's figures are from; empty: none is used
};

/// A fault, refusal, stop or remark.
struct ReportEvent {
    double t_s = 0;  ///< on the session's time base
    QString kind;    ///< "fault", "refused", "stop", ...
    QString text;
    int count = 1;  ///< similar events in a row are counted, not repeated
};

struct ReportModel {
    QString title;
    QString purpose;
    QString protocol;    ///< "separability"
    QString resultKind;  ///< as the protocol declares it; what results are that do not say it themselves
    QString session;     ///< the session's name: its file name without the ending
    QString started;     ///< ISO 8601 UTC
    double duration_s = kUnknown;
    ReportVerdict verdict = ReportVerdict::None;
    QStringList reasons;     ///< why that verdict; one sentence each
    bool simulated = false;  ///< any device of the session was simulated
    QStringList marks;       ///< the marks from sessionMarks(): origin, calibration, the flags of R, its known limit
    QString chainHead;       ///< hex; empty only before there is one
    QStringList damage;      ///< what verify finds wrong with the session; empty when it is intact
    ReportBasis basis;
    std::optional<ReportCertificate> certificate;
    std::vector<ReportDevice> devices;
    std::vector<ReportFact> settings;           ///< parameters with their units
    std::vector<ReportFact> identity;           ///< versions, seed, hashes
    std::vector<ReportItem> items;              ///< in the script's order
    std::vector<ExposureFigure::Row> exposure;  ///< as the gate computed it from the trains it approved
    std::vector<ReportEvent> events;
    QStringList reproduce;  ///< command lines
};

}  // namespace tacto
