#include "app/report/ReportBasis.h"

#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <vector>

#include "app/report/CertificatePages.h"
#include "app/report/NumberText.h"
#include "app/report/ShownText.h"
#include "app/report/TableContent.h"
#include "core/analysis/statistics/Verdict.h"
#include "core/kinds/ResultKinds.h"

namespace tacto {

namespace {

constexpr qsizetype kMaxNamedAt = 8;  // number of unevaluated rows that are named; the others are counted

QString sentence(QString key) {
    key.replace('_', ' ');
    if (!key.isEmpty()) key[0] = key[0].toUpper();
    return key;
}

void readRule(const QJsonObject& results, const QString& kind, ReportBasis& basis) {
    basis.rule.clear();
    const auto stated = results.value("decision_rule");
    if (stated.isString()) basis.rule.push_back({"Decision rule", stated.toString()});
    if (stated.isArray()) {
        QStringList lines;
        for (const auto& line : stated.toArray()) lines << line.toString();
        basis.rule.push_back({"Decision rule", lines.join('\n')});
    }
    if (stated.isObject()) {
        const auto object = stated.toObject();
        for (auto it = object.begin(); it != object.end(); ++it)
            basis.rule.push_back({sentence(it.key()), cellText(it.value(), {})});
    }
    if (!basis.rule.empty()) return;
    const auto& traits = resultTraits(kind.toStdString());
    const auto& known = traits.decisionRule;
    basis.rule.push_back(
        {"Decision rule", known.empty() ? QString("As the script gives it in its reasons.")
                                        : QString::fromUtf8(known.data(), static_cast<qsizetype>(known.size()))});
    if (!traits.guardBanded) return;
    basis.rule.push_back({"Guard band", "U on the side of the limit (ISO 14253-1)"});
    basis.rule.push_back({"Coverage", "U is the expanded uncertainty for a coverage of 95\u202f% (GUM)"});
}

QString numberOrUnknown(const QJsonObject& object, const char* key, const QString& unit, const char* name,
                        bool plusMinus = true) {
    const auto value = object.value(QLatin1String(key));
    const auto known = [&] {
        return plusMinus ? "± " + toleranceText(value.toDouble(), unit) : quantityText(value.toDouble(), unit, 2);
    };
    const QString shown = value.isDouble() ? known() : "unknown";
    return QString("%1 %2").arg(QLatin1String(name), shown);
}

/// False for entries that only name a device.
bool saysAccuracy(const QJsonObject& entry) {
    return entry.contains("stated_by") || entry.contains("gain_pct") || entry.contains("timebase_ppm");
}

QString statesOf(const QJsonObject& entry) {
    QStringList states;
    const QString unit = entry.value("unit").toString();
    const auto add = [&](const char* key, const QString& of, const char* name, bool plusMinus = true) {
        if (entry.contains(QLatin1String(key))) states << numberOrUnknown(entry, key, of, name, plusMinus);
    };
    add("gain_pct", "%", "gain");
    add("offset", unit, "offset");
    add("lsb", unit, "step", false);
    add("probe_pct", "%", "probe or shunt");
    add("timebase_ppm", "ppm", "time base");
    return states.isEmpty() ? QString("unknown") : states.join(", ");
}

void readInstruments(const QJsonObject& results, ReportModel& model) {
    auto& instruments = model.basis.instruments;
    instruments.clear();
    for (const auto& element : results.value("instruments").toArray()) {
        const auto entry = element.toObject();
        if (!saysAccuracy(entry)) continue;
        const QString serial = entry.value("serial").toString(), by = entry.value("stated_by").toString();
        instruments.push_back({entry.value("name").toString() + (serial.isEmpty() ? QString() : " " + serial),
                               entry.value("channel").toString("–"), statesOf(entry),
                               by.isEmpty() ? QString("unknown") : by});
    }
    if (!instruments.empty()) return;
    for (const auto& device : model.devices) {
        if (!device.is(Role::Oscilloscope)) continue;
        instruments.push_back({device.name + (device.serial.isEmpty() ? QString() : " " + device.serial), "–",
                               "not in this session's results",
                               device.simulated ? QString("digital twin") : QString("unknown")});
    }
}

/// Sessions of older versions only say whether the check passed. A check that did not pass may have been indeterminate;
/// its numbers tell.
QString referenceVerdict(const QJsonObject& check) {
    if (check.value("verdict").isString()) return check.value("verdict").toString();
    const auto passed = check.value("passed");
    if (!passed.isBool()) return "not evaluated";
    if (passed.toBool()) return "pass";
    if (!check.contains("load_ohm")) return check.value("measured").isDouble() ? "fail" : "not evaluated";
    const auto number = [&](const char* key) { return check.value(QLatin1String(key)).toDouble(kUnknown); };
    const auto name =
        guardBandedName(number("deviation_pct"), number("expanded_uncertainty_pct"), number("allowed_pct"));
    return QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
}

void addReference(const QJsonObject& results, ReportBasis& basis) {
    const auto check = results.value("reference").toObject();
    const auto number = [&](const char* key) { return check.value(QLatin1String(key)).toDouble(kUnknown); };
    const QString outcome = referenceVerdict(check);
    if (check.contains("load_ohm")) {
        const QString read = std::isfinite(number("measured_ohm"))
                                 ? uncertainText(number("measured_ohm"), number("expanded_ohm"), "ohm")
                                 : QString("nothing");
        basis.restsOn.push_back({"Known load", QString("%1 read as %2; off by at most %3 is allowed: %4")
                                                   .arg(settingText(number("load_ohm"), "ohm"), read,
                                                        settingText(number("allowed_pct"), "%"), outcome)});
    } else if (check.contains("mass_g")) {
        const bool weighed = check.value("mass_g").isDouble();
        basis.restsOn.push_back({"Known weight", weighed ? QString("%1 g, %2: %3")
                                                               .arg(settingText(number("mass_g"), {}),
                                                                    quantityText(number("reference_n"), "N"), outcome)
                                                         : QString("not evaluated: no weight was given")});
    }
    for (const auto& element : results.value("rows").toArray()) {
        const auto row = element.toObject();
        const bool ofTime = row.value("item") == "time_reference";
        if (row.value("item") != "reference" && !ofTime) continue;
        const double value = row.value("value").toDouble(kUnknown);
        QString text = row.value("verdict").toString();
        if (std::isfinite(value)) {
            text =
                QString("%1 off by %2, at most %3 allowed: %4")
                    .arg(ofTime ? QString("interval by the computer's clock") : loadText(row.value("load").toString()),
                         uncertainText(value, row.value("expanded_uncertainty").toDouble(kUnknown), "%"),
                         settingText(row.value("limit").toDouble(kUnknown), "%"), text);
        }
        basis.restsOn.push_back({ofTime ? "Time base" : "Known load", text});
    }
}

void readRestsOn(const QJsonObject& results, ReportBasis& basis) {
    basis.restsOn.clear();
    addReference(results, basis);
    QStringList lines;
    for (const auto& line : results.value("rests_on").toArray()) lines << cellText(line, {});
    if (!lines.isEmpty()) basis.restsOn.push_back({"Rests on", lines.join('\n')});
}

/// Combines loads on which a quantity was not evaluated for the same reason into one sentence: "current density into
/// 100 ohm, 500 ohm and in the worst case was not evaluated: …".
QStringList notEvaluatedOn(const QJsonArray& rows) {
    struct Sentence {
        QString before, after;
        QStringList loads;
        bool worst = false;
    };
    std::vector<Sentence> all;
    for (const auto& element : rows) {
        const auto row = element.toObject();
        const QString load = row.value("load").toString(), reason = row.value("reason").toString();
        if (row.value("verdict") != "not evaluated" || reason.isEmpty()) continue;
        const qsizetype into = reason.indexOf(" into " + load + ' '), over = reason.indexOf(" over " + load + ' ');
        const qsizetype at = std::max(into, over);
        const QString before = at < 0 ? reason : reason.left(at);
        const QString after = at < 0 ? QString() : reason.mid(at + QString(" into ").size() + load.size());
        auto same = std::ranges::find_if(
            all, [&](const Sentence& other) { return other.before == before && other.after == after; });
        if (same == all.end()) same = all.insert(all.end(), {before, after, {}, false});
        if (into >= 0)
            same->loads << load;
        else
            same->worst = over >= 0;
    }
    QStringList texts;
    for (const auto& each : all) {
        QStringList places;
        if (!each.loads.isEmpty()) places << "into " + each.loads.join(", ");
        if (each.worst) places << "in the worst case";
        texts << each.before + (places.isEmpty() ? QString() : ' ' + places.join(" and ")) + each.after;
    }
    return texts;
}

void readNotEvaluated(const QJsonObject& results, ReportBasis& basis) {
    QStringList found;
    const auto add = [&](const QString& text) {
        if (!text.isEmpty() && !found.contains(text)) found << text;
    };
    for (const auto& element : results.value("not_evaluated").toArray()) {
        const auto object = element.toObject();
        const QString title = object.value("title").toString(), reason = object.value("reason").toString();
        add(element.isString() ? element.toString() : reason.isEmpty() ? title : title + ": " + reason);
    }
    const auto worst = results.value("worst_case").toObject();
    if (!results.contains("not_evaluated")) {
        QJsonArray rows = results.value("rows").toArray();
        for (const auto& row : worst.value("rows").toArray()) rows << row;
        for (const auto& text : notEvaluatedOn(rows)) add(text);
    }
    if (found.size() > kMaxNamedAt) {
        const auto more = found.size() - kMaxNamedAt;
        found = found.mid(0, kMaxNamedAt);
        found << QString("and %1 more, which stand among the results").arg(more);
    }
    // The page prints "Not evaluated" next to these sentences, so they need only the quantity and the reason.
    static const QRegularExpression saidBefore(" (?:was|were) not evaluated\\b");
    for (auto& each : found) each = withSigns(each.remove(saidBefore));
    basis.notEvaluated = found;
}

}  // namespace

void readBasis(const QJsonObject& results, ReportModel& model) {
    const QString kind = results.value("kind").toString(model.resultKind);
    readRule(results, kind, model.basis);
    readInstruments(results, model);
    readRestsOn(results, model.basis);
    readNotEvaluated(results, model.basis);
}

namespace {

constexpr auto kNotRecorded = "not recorded";

QString orNotRecorded(const QString& text) { return text.isEmpty() ? QString(kNotRecorded) : text; }

bool has(const ReportModel& model, Role role) {
    return std::any_of(model.devices.begin(), model.devices.end(),
                       [role](const ReportDevice& device) { return device.is(role); });
}

TableBlock instrumentsTable(const ReportModel& model, const QString& caption) {
    TableBlock table;
    table.caption = caption;
    table.columns = {{"Instrument"}, {"Channel"}, {"Accuracy"}, {"Stated by"}};
    for (const auto& each : model.basis.instruments)
        table.rows.push_back({capitalised(each.name), each.channel, each.states, each.statedBy});
    return table;
}

FactsBlock factsOf(const ReportModel& model) {
    FactsBlock block;
    block.oneColumn = true;
    const auto& basis = model.basis;
    const bool certified = isCertificate(model);  // a certificate's first page already says part of this
    block.facts = certified ? certificateMethod(model) : basis.rule;
    block.facts.insert(block.facts.end(), basis.restsOn.begin(), basis.restsOn.end());
    if (has(model, Role::Oscilloscope)) {
        block.facts.push_back(
            {"Certificate", basis.certificate.isEmpty() ? QString("none of the oscilloscope") : basis.certificate});
    }
    QStringList open = basis.notEvaluated;
    // A run that broke off or approved no train has no exposure: this is stated here, not in an empty section.
    if (has(model, Role::Stimulator) && model.exposure.empty())
        open << "exposure: this session holds no approved train";
    block.facts.push_back(
        {"Not evaluated", open.isEmpty() ? QString("nothing, as far as this session says") : open.join(";\n") + "."});
    if (!certified) block.facts.push_back({"Sample", orNotRecorded(basis.sample)});
    if (!basis.note.isEmpty()) block.facts.push_back({"Note, added after the recording", basis.note});
    if (!basis.tags.isEmpty()) block.facts.push_back({"Tags, added after the recording", basis.tags});
    if (!certified) block.facts.push_back({"Ambient conditions", orNotRecorded(basis.ambient)});
    return block;
}

}  // namespace

void addFrontPage(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks) {
    blocks.emplace_back(captions.heading(isCertificate(model) ? "Method, traceability and what the values rest on"
                                                              : "How it was decided, and what that rests on"));
    blocks.emplace_back(factsOf(model));
    if (!model.basis.instruments.empty())
        blocks.emplace_back(instrumentsTable(model, captions.table("Instruments, and what their accuracy rests on")));
    const auto& basis = model.basis;
    blocks.emplace_back(
        SignaturesBlock{{"Operator", "Reviewer"}, {"Name", "Date", "Signature"}, {basis.operatorName, basis.reviewer}});
}

}  // namespace tacto
