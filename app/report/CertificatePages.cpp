#include "app/report/CertificatePages.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/report/NumberText.h"
#include "app/report/ShownText.h"
#include "core/base/QuantityText.h"
#include "core/calibration/CertificateDetails.h"
#include "core/encoding/StimulatorCalibration.h"
#include "core/session/Origin.h"

namespace tacto {
namespace {

QString fromUtf8(std::string_view text) { return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size())); }

QJsonArray quantitiesOf(const ReportModel& model) { return model.certificate->results["quantities"].toArray(); }

const ReportDevice* deviceOf(const ReportModel& model, Role role) {
    const auto found = std::ranges::find_if(model.devices, [role](const ReportDevice& each) { return each.is(role); });
    return found == model.devices.end() ? nullptr : &*found;
}

/// Returns the entry under `key`; else the value that the program knows; else a line to write on.
ReportFact detailFact(const ReportModel& model, std::string_view key, const QString& known = {}) {
    const auto detail = std::ranges::find(kCertificateDetails, key, &CertificateDetail::key);
    const QString given = shownText(model.certificate->details[fromUtf8(key)].toString(), kShownCell);
    QString text = given.isEmpty() ? known : given;
    // An entry does not replace what the device reports about itself.
    if (!given.isEmpty() && !known.isEmpty() && given != known) text += QString(" (the device reports %1)").arg(known);
    return {fromUtf8(detail->title), text, false, text.isEmpty()};
}

/// Returns the deviations from the method, as far as the program knows them.
QString deviations(const ReportModel& model) {
    QStringList all;
    const auto quantities = quantitiesOf(model);
    for (const auto& one : kCalibratedQuantities) {
        const bool calibrated = std::ranges::any_of(
            quantities, [&](const QJsonValue& each) { return each[u"quantity"].toString() == fromUtf8(one.id); });
        if (!calibrated) all << fromUtf8(one.title) + " was not calibrated";
    }
    for (const auto& each : quantities) {
        for (const auto& warning : each[u"warnings"].toArray())
            all << each[u"title"].toString() + ": " + warning.toString();
    }
    return all.isEmpty() ? QString("none that the program knows of") : shownText(all.join(";\n"), kShownCell) + ".";
}

/// Returns one value of an instrument as its certificate states it: "voltage gain U = 0.5 % (k = 2)".
QString certified(const QJsonObject& certificate, const char* key, const char* what, const char* unit) {
    const auto u = certificate[QLatin1String(key)];
    if (!u.isDouble()) return {};
    return QString("%1, U = %2 (k = 2)").arg(QLatin1String(what), settingText(u.toDouble(), unit));
}

/// A figure that an oscilloscope's certificate states for a reading.
struct CertifiedFigure {
    const char* key;
    const char* what;
    const char* unit;
};
const std::vector<CertifiedFigure> kOfVoltage{{"gain_u_pct", "voltage gain", "%"}, {"probe_u_pct", "probe", "%"}},
    kOfCurrent{{"gain_u_pct", "voltage gain", "%"}, {"shunt_u_pct", "shunt", "%"}},
    kOfTime{{"timebase_u_ppm", "time base", "ppm"}};

struct Traced {
    QStringList by, lacking;
};

QString tracedText(const Traced& traced, const QString& certificate) {
    if (traced.by.isEmpty()) return "not traceable: " + traced.lacking.join("; ") + ".";
    QString text = "through " + certificate + ": " + traced.by.join("; ") + ".";
    if (!traced.lacking.isEmpty()) text += " Not traceable: " + traced.lacking.join("; ") + ".";
    return text;
}

void addTraceability(const ReportModel& model, std::vector<ReportFact>& facts) {
    const auto& certificate = model.certificate->oscilloscope;
    if (model.simulated) {
        facts.push_back({"Traceability", "not traceable: SIMULATED, nothing was measured on hardware."});
        return;
    }
    if (certificate.isEmpty()) {
        const QString why = model.basis.certificate.isEmpty()
                                ? QString("no calibration certificate of the oscilloscope is known to the program")
                                : model.basis.certificate;
        facts.push_back({"Traceability", "not traceable: " + why + "."});
        return;
    }
    const QString named =
        QString("certificate %1 of %2, dated %3, due %4, of the oscilloscope %5 %6")
            .arg(certificate["number"].toString(), certificate["by"].toString(), certificate["date"].toString(),
                 certificate["due"].toString(), certificate["instrument"].toString(), certificate["serial"].toString());
    QStringList said;
    bool timesSaid = false;
    for (const auto& each : quantitiesOf(model)) {
        const bool amplitude = each[u"quantity"].toString() == "amplitude";
        if (!amplitude && std::exchange(timesSaid, true)) continue;
        const bool current = each[u"unit"].toString() == "mA";
        const auto& figures = amplitude ? (current ? kOfCurrent : kOfVoltage) : kOfTime;
        Traced traced;
        for (const auto& [key, what, unit] : figures) {
            // A value that the operator stated replaces the value in the certificate.
            const auto share =
                each[u"stated_by"].toString() == "the operator" ? QString() : certified(certificate, key, what, unit);
            if (!share.isEmpty())
                traced.by << share;
            else
                traced.lacking << QString("the %1, which is not from this certificate").arg(QLatin1String(what));
        }
        said << (amplitude ? "Amplitude: " : "Times: ") + tracedText(traced, named);
    }
    facts.push_back({"Traceability", said.join('\n')});
}

QString dayOf(const QString& started) { return started.left(10) + " (UTC)"; }

/// Returns the specification to which conformity is stated.
QString specification(const ReportModel& model) {
    QStringList all;
    for (const auto& each : quantitiesOf(model)) {
        all << QString("%1 ± %2 of the set value")
                   .arg(each[u"title"].toString().toLower(),
                        settingText(each[u"tolerance_pct"].toDouble(kUnknown), "%"));
    }
    return capitalised(all.join("; ")) + ", at each level; the tolerances that this calibration was ordered with.";
}

/// A column of numbers with one prefix; each number has its own number of decimals.
class CertifiedColumns {
public:
    CertifiedColumns(const QJsonArray& rows, const QString& unit) : rows_(rows) {
        double set = 0, error = 0, tolerance = 0;
        for (const auto& row : rows) {
            const double u = numberIn(row, "expanded_uncertainty");
            set = std::fmax(set, std::abs(numberIn(row, "commanded")));
            tolerance = std::fmax(tolerance, std::abs(numberIn(row, "tolerance")));
            error = std::fmax(error, std::abs(numberIn(row, "error")));
            // Room for two digits of the expanded uncertainty, without useless zeros.
            if (u > 0) error = std::fmax(error, std::pow(10.0, decimalExponent(u, 2) + 1));
        }
        set_ = axisUnit(set, unit);
        error_ = axisUnit(error, unit);
        // The tolerance has the unit of the error, for comparison, unless that takes too many digits.
        constexpr double kFourDigits = 1e4;
        tolerance_ = tolerance * error_.factor < kFourDigits ? error_ : axisUnit(tolerance, unit);
    }

    [[nodiscard]] TableBlock table(const QString& caption) const {
        TableBlock out;
        out.caption = caption;
        out.columns = {{"Verdict"},
                       {"Set (" + set_.unit + ")", true},
                       {"Delivered (" + set_.unit + ")", true},
                       {"Error (" + error_.unit + ")", true},
                       {"U (" + error_.unit + ")", true},
                       {"k", true},
                       {"Coverage (%)", true},
                       {"Tolerance (" + tolerance_.unit + ")", true}};
        out.naming = 1;
        std::vector<QStringList> columns(out.columns.size());
        for (const auto& row : rows_) {
            const double set = numberIn(row, "commanded"), error = numberIn(row, "error");
            const double u = numberIn(row, "expanded_uncertainty"), k = numberIn(row, "coverage_factor");
            columns[0] << verdictCell(row[u"verdict"].toString());
            columns[1] << settingText(set * set_.factor, {});
            columns[2] << atPlace(set + error, u, set_);
            columns[3] << atPlace(error, u, error_);
            columns[4] << (std::isfinite(u) ? atPlace(u, u, error_) : QString("not known"));
            columns[5] << (std::isfinite(k) ? QString::number(k, 'f', 2) : QString("–"));
            columns[6] << (std::isfinite(u) ? QString("95") : QString("–"));
            columns[7] << "± " + settingText(numberIn(row, "tolerance") * tolerance_.factor, {});
        }
        for (auto& cells : columns) alignPoints(cells);
        for (qsizetype r = 0; r < rows_.size(); ++r) {
            out.rows.emplace_back();
            for (const auto& cells : columns) out.rows.back() << cells[r];
        }
        return out;
    }

private:
    static double numberIn(const QJsonValue& row, const char* key) {
        return row[QLatin1String(key)].toDouble(kUnknown);
    }
    /// Rounds to the second digit of the expanded uncertainty; to four digits if that is not known.
    static QString atPlace(double value, double u, const AxisUnit& axis) {
        if (!std::isfinite(value)) return "not measured";
        if (!(u > 0)) return quantityText(value * axis.factor, {});
        const int decimals = std::max(0, 1 - decimalExponent(u * axis.factor, 2));
        return QString::fromStdString(decimalText(value * axis.factor, decimals)).replace('-', QString("−"));
    }

    QJsonArray rows_;
    AxisUnit set_, error_, tolerance_;
};

}  // namespace

std::optional<QString> whyNoCertificate(const ReportModel& model) {
    if (!model.certificate) return {};
    if (!model.damage.isEmpty()) return "the session is not what was recorded";
    if (model.verdict == ReportVerdict::None || model.verdict == ReportVerdict::Stopped)
        return "the run did not come to its verdict";
    for (const auto& device : model.devices) {
        if (device.origin != QLatin1String(origin::kHardware) && device.origin != QLatin1String(origin::kSimulated))
            return "its readings come from files";
    }
    return QString();
}

QString certificateTitle(const ReportModel& model) {
    return model.simulated ? "Calibration certificate – SIMULATED" : "Calibration certificate";
}

void addCertificateItem(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks) {
    if (model.simulated) {
        blocks.emplace_back(
            ParagraphBlock{"SIMULATED: this shows what a certificate would say. No device was calibrated, and it is "
                           "not to be issued."});
    }
    blocks.emplace_back(captions.heading("Laboratory, customer and item"));
    FactsBlock who;
    who.oneColumn = true;
    for (const char* key : {"laboratory", "address", "number", "customer", "contact"})
        who.facts.push_back(detailFact(model, key));
    const auto* item = deviceOf(model, Role::Stimulator);
    who.facts.push_back(
        {"Item", "stimulator" + (model.basis.sample.isEmpty() ? QString() : ", " + model.basis.sample)});
    who.facts.push_back(detailFact(model, "make"));
    who.facts.push_back(detailFact(model, "model", item == nullptr ? QString() : item->name));
    who.facts.push_back(detailFact(model, "serial", item == nullptr ? QString() : item->serial));
    who.facts.push_back(detailFact(model, "condition"));
    blocks.emplace_back(std::move(who));

    blocks.emplace_back(captions.heading("Calibration"));
    FactsBlock how;
    how.oneColumn = true;
    how.facts.push_back(detailFact(model, "place"));
    how.facts.push_back(detailFact(model, "received"));
    how.facts.push_back({"Calibrated on", dayOf(model.started)});
    how.facts.push_back(detailFact(model, "issued"));
    how.facts.push_back({"Conditions during it", model.basis.ambient, false, model.basis.ambient.isEmpty()});
    blocks.emplace_back(std::move(how));
}

std::vector<ReportFact> certificateMethod(const ReportModel& model) {
    const auto fact = [&](const QString& name) {
        const auto found = std::ranges::find(model.identity, name, &ReportFact::name);
        return found == model.identity.end() ? QString() : found->value;
    };
    const QString from = fact("Script from");
    std::vector<ReportFact> facts{
        {"Method", QString("%1.js%2, %3; definitions and uncertainty: science.md section 9")
                       .arg(model.protocol, from.isEmpty() ? QString() : " (" + from + ")", fact("Program"))},
        {"Its edition, SHA-256", fact("Script " + model.protocol), true},
        {"Deviations from it", deviations(model)}};
    addTraceability(model, facts);
    return facts;
}

void addCertificateConformity(const ReportModel& model, Captions&, std::vector<ReportBlock>& blocks) {
    FactsBlock rule;
    rule.oneColumn = true;
    rule.facts.push_back({"Specification", specification(model)});
    rule.facts.insert(rule.facts.end(), model.basis.rule.begin(), model.basis.rule.end());
    blocks.emplace_back(std::move(rule));
    QStringList statements{
        "The results relate only to the items calibrated.",
        "This certificate shall not be reproduced except in full without approval of the laboratory.",
        "Laboratory, customer, make, condition, conditions, and days of receipt and issue are as they were entered; "
        "the "
        "program measured none of them.",
        "How long this bench applies a stored correction is its own setting; no interval of calibration is "
        "recommended."};
    blocks.emplace_back(ParagraphBlock{statements.join('\n')});
    const auto detail = [&](const char* key) { return model.certificate->details[QLatin1String(key)].toString(); };
    SignaturesBlock sign{{"Authorised by"}, {"Name", "Function", "Date", "Signature"}, {detail("authorised_by")}};
    sign.second = detail("function");
    sign.open = true;
    blocks.emplace_back(std::move(sign));
}

void addCertificateResults(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks) {
    const QJsonObject& results = model.certificate->results;
    const bool corrected = results["before"][u"made"].isString(), kept = results["kept"].isObject();
    blocks.emplace_back(captions.heading("Results, as found and as left"));
    QStringList said{
        "Error: what is delivered less what is set, in the worse direction of the sweep. U: its expanded uncertainty, "
        "k "
        "times the standard uncertainty, for a coverage probability of 95 %; k stands beside it. What is delivered has "
        "the same U."};
    const auto applied = results["correction_in_readings"].toArray();
    if (!applied.isEmpty()) {
        said
            << "As found: the stored correction was applied before this run, and to the readings: as found is what was "
               "measured with it.";
    } else if (corrected) {
        said << QString(
                    "As found: before this run the correction of %1 was applied. The readings were taken without a "
                    "correction; what was delivered with it is computed from them and was not measured.")
                    .arg(results["before"][u"made"].toString());
    } else {
        said << "As found: no correction was applied before this run, and none to the readings: as found is what was "
                "measured.";
    }
    if (kept) {
        said << QString(
                    "As left: the correction of %1 is stored and will be applied. What is delivered with it is "
                    "computed from the readings and was not measured.")
                    .arg(results["kept"][u"made"].toString());
    } else {
        said << "As left: no adjustment was made, and no correction was stored: as left is as found.";
    }
    blocks.emplace_back(ParagraphBlock{said.join('\n')});
    for (const auto& each : quantitiesOf(model)) {
        const auto add = [&](const char* key, const QString& what) {
            if (!each[QLatin1String(key)].isArray()) return;
            const CertifiedColumns columns(each[QLatin1String(key)].toArray(), each[u"unit"].toString());
            blocks.emplace_back(columns.table(captions.table(each[u"title"].toString() + what)));
        };
        const bool inReadings = applied.contains(each[u"quantity"]);
        add("measured", inReadings  ? QString(", as found, with the stored correction, measured")
                        : corrected ? QString(" without a correction, measured")
                                    : QString(kept ? ", as found, measured" : ", as found and as left, measured"));
        add("found", ", as found, computed");
        add("left", ", as left, computed");
    }
}

}  // namespace tacto
