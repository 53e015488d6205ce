#include "app/report/SessionReport.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "app/report/NumberText.h"
#include "app/report/Report.h"
#include "app/report/ReportBasis.h"
#include "app/report/TableContent.h"
#include "core/base/JsonText.h"
#include "core/dsp/RoughnessFlags.h"
#include "core/results/ResultTable.h"
#include "core/session/Origin.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionVerify.h"

namespace tacto {
namespace {

QString text(const std::string& value) { return QString::fromStdString(value); }

QString plainText(const QJsonValue& value) {
    if (value.isString()) return value.toString();
    if (value.isDouble()) return settingText(value.toDouble(), {});
    if (value.isBool()) return value.toBool() ? "yes" : "no";
    if (value.isNull() || value.isUndefined()) return "–";
    return QString::fromUtf8(value.isArray() ? QJsonDocument(value.toArray()).toJson(QJsonDocument::Compact)
                                             : QJsonDocument(value.toObject()).toJson(QJsonDocument::Compact));
}

/// Quotes the word so that a shell takes it as a single word.
QString shellWord(const QString& word) {
    static const QString plain("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+:./,@%");
    const bool harmless =
        !word.isEmpty() && std::all_of(word.begin(), word.end(), [](QChar c) { return plain.contains(c); });
    if (harmless) return word;
    QString quoted = word;
    return "'" + quoted.replace("'", "'\\''") + "'";
}

/// Returns the profile's description of the electrode (Profile.h): "TENS-40, 4 cm², Ag/AgCl, hydrogel".
QString electrodeOf(const SessionAbout& about) {
    const auto profile = parseJson(about.profileJson, "the profile");
    if (!profile || !memberAt(*profile, "electrode").is_object()) return {};
    const auto word = [&](const char* key) { return text(textOr(memberAt(*profile, "electrode"), key)); };
    const auto& area = memberAt(*profile, "safety.electrode_area_cm2");
    QStringList said{word("name"), area.is_number() ? settingText(area.get<double>(), "cm²") : QString(),
                     word("material"), word("medium")};
    said.removeAll(QString());
    return said.join(", ");
}

void fillAbout(const SessionReader& reader, const std::filesystem::path& file, ReportModel& model) {
    const auto& about = reader.about();
    model.protocol = text(about.protocol);
    model.resultKind = model.protocol;  // sessions from before protocols declared the kind of their results
    model.session = text(file.stem().string());
    model.started = text(about.wallStart);
    model.simulated = about.simulated;
    model.chainHead = text(reader.chainHead());
    QString command = "tactoscope-cli run " + shellWord(model.protocol);
    for (const auto& device : about.devices) {
        model.devices.push_back({text(device.role), text(device.name), text(device.uri), text(device.serial),
                                 text(device.firmware), device.simulated, text(originOf(device))});
        model.simulated = model.simulated || device.simulated;
        const QString option = " --device " + shellWord(text(device.uri));
        if (!command.contains(option)) command += option;
    }
    const auto parameters = qtObject(about.parameters);
    for (auto it = parameters.begin(); it != parameters.end(); ++it) {
        const QString value =
            it.value().isDouble() ? QString::number(it.value().toDouble(), 'g', 17) : plainText(it.value());
        // 17 digits distinguish all doubles; most numbers need far fewer.
        const QString brief = it.value().isDouble() ? QString::number(it.value().toDouble(), 'g', 10) : value;
        const bool same = !it.value().isDouble() || brief.toDouble() == it.value().toDouble();
        command += " --set " + shellWord(it.key() + "=" + (same ? brief : value));
        model.settings.push_back({it.key(), plainText(it.value())});
    }
    command += QString(" --seed %1").arg(about.seed);
    if (!about.virtualClock && model.simulated) command += " --realtime";
    if (!about.protocol.empty()) model.reproduce << command;
    model.reproduce << "tactoscope-cli verify " + shellWord(text(file.filename().string()));

    model.identity.push_back({"Program", "Tactoscope " + text(about.programVersion)});
    model.identity.push_back({"Seed", QString::number(about.seed)});
    model.identity.push_back({"Clock", about.virtualClock ? "virtual: time ran as fast as the computer" : "real time"});
    if (!about.mode.empty()) model.identity.push_back({"Output mode", text(about.mode)});
    if (const auto electrode = electrodeOf(about); !electrode.isEmpty())
        model.identity.push_back({"Electrode", electrode});
    const auto hash = [&](const QString& name, const std::string& value) {
        if (!value.empty()) model.identity.push_back({name, text(value), true});
    };
    if (!about.protocolFrom.empty()) model.identity.push_back({"Script from", text(about.protocolFrom)});
    for (const auto& set : about.limitSets) {
        if (set.from.empty()) continue;
        model.identity.push_back({"Limits beside the built-in ones", text(set.id + " (" + set.from + ")")});
    }
    hash("Script " + model.protocol, about.protocolSha256);
    hash("Encoding profile", about.profileSha256);
    for (const auto& set : about.limitSets) hash("Limits, " + limitSetTitle(text(set.id)), set.sha256);
}

bool judgeTheSame(const ExposureFigure::Row& a, const ExposureFigure::Row& b) {
    return a.name == b.name && a.source == b.source && !(a.limit < b.limit) && !(a.limit > b.limit);
}

/// Keeps the worse of two similar rows: an unevaluated row, else the row with the larger share of its limit.
void addExposure(ReportModel& model, const ExposureFigure::Row& row) {
    for (auto& known : model.exposure) {
        if (!judgeTheSame(known, row)) continue;
        if (!std::isfinite(known.value)) return;
        const bool newlyOver = row.over() && !known.over();
        if (!row.evaluated() || newlyOver || std::abs(row.value) > std::abs(known.value)) known = row;
        return;
    }
    model.exposure.push_back(row);
}

class ItemReader {
public:
    ItemReader(const SessionReader& reader, ReportModel& model) : reader_(reader), model_(model) {}

    void take(const QJsonObject& item) {
        const QString kind = item["kind"].toString();
        if (kind == "about") {
            takeAbout(item);
        } else if (kind == "figure") {
            takeFigure(item);
        } else if (kind == "table") {
            QStringList columns;
            for (const auto& column : item["columns"].toArray()) columns << column.toString();
            model_.items.emplace_back(ReportTable{item["caption"].toString(), columns, item["rows"].toArray()});
        } else if (kind == "matrix") {
            QStringList columns;
            for (const auto& column : item["columns"].toArray()) columns << column.toString();
            model_.items.emplace_back(ReportMatrix{item["caption"].toString(), columns, item["rows"].toArray()});
        } else if (kind == "basis") {
            readBasis(item["results"].toObject(), model_);
        } else if (kind == "notes") {
            auto& basis = model_.basis;
            for (const auto& [key, into] :
                 {std::pair("operator", &basis.operatorName), std::pair("sample", &basis.sample),
                  std::pair("reviewer", &basis.reviewer), std::pair("ambient", &basis.ambient)})
                if (item.contains(QLatin1String(key))) *into = item[QLatin1String(key)].toString();
        } else if (kind == "certificate") {
            if (!model_.certificate) model_.certificate.emplace();
            model_.certificate->results = item;
        } else if (kind == "certificate details") {
            details_ = item;
        } else if (kind == "text") {
            model_.items.emplace_back(ReportText{item["text"].toString()});
        } else {
            model_.items.emplace_back(ReportText{
                QString("An item of kind “%1” cannot be shown; known are about, figure, table, matrix and text.")
                    .arg(kind)});
        }
    }

    /// Adds entries for a certificate; only a run with a certificate needs them.
    void finish() {
        if (model_.certificate) model_.certificate->details = details_;
    }

private:
    /// Returns a choice or a 0 in the protocol's words: "1 MS/s" for "1M", "from the profile" for 0.
    static QString settingOf(const QJsonObject& parameter) {
        if (parameter.contains("shown")) return parameter["shown"].toString();
        const auto value = parameter["value"];
        return value.isDouble() ? settingText(value.toDouble(), parameter["unit"].toString()) : plainText(value);
    }

    void takeAbout(const QJsonObject& item) {
        if (item.contains("title")) model_.title = item["title"].toString();
        if (item.contains("purpose")) model_.purpose = item["purpose"].toString();
        if (item.contains("result_kind")) {
            model_.resultKind = item["result_kind"].toString();
            readBasis({}, model_);
        }
        if (!item.contains("parameters")) return;
        model_.settings.clear();
        for (const auto& element : item["parameters"].toArray()) {
            const auto parameter = element.toObject();
            model_.settings.push_back({parameter["label"].toString(), settingOf(parameter)});
        }
    }

    void takeFigure(const QJsonObject& item) {
        QString caption = item["caption"].toString();
        auto figure = parseFigure(item["figure"].toObject());
        if (figure) {
            if (const auto* exposure = std::get_if<ExposureFigure>(&figure->content)) {
                // The program's own record has its own section and must not appear twice.
                if (recorded(*exposure)) return;
                caption += " (computed from approved trains)";
            }
            const auto resolved = resolveCaptures(*figure, [&](qint64 id) { return reader_.capture(id); });
            if (resolved) {
                model_.items.emplace_back(ReportFigure{caption, std::move(*figure)});
                return;
            }
            model_.items.emplace_back(missing(caption, resolved.error()));
            return;
        }
        model_.items.emplace_back(missing(caption, figure.error()));
    }

    /// True if the program's own record includes this figure: the same limits, and values at least as high.
    [[nodiscard]] bool recorded(const ExposureFigure& figure) const {
        return std::all_of(figure.rows.begin(), figure.rows.end(), [&](const auto& row) {
            return std::any_of(model_.exposure.begin(), model_.exposure.end(), [&](const auto& own) {
                return judgeTheSame(own, row) && (!own.evaluated() || std::abs(row.value) <= std::abs(own.value));
            });
        });
    }

    /// A figure that cannot be drawn is replaced by a sentence, never left out.
    static ReportText missing(const QString& caption, const Error& error) {
        return {QString("The figure “%1” could not be drawn: %2").arg(caption, text(error.message))};
    }

    const SessionReader& reader_;
    ReportModel& model_;
    QJsonObject details_;
};

ReportVerdict verdictNamed(const std::string& name) {
    if (name == "pass") return ReportVerdict::Pass;
    if (name == "fail") return ReportVerdict::Fail;
    if (name == "indeterminate") return ReportVerdict::Indeterminate;
    if (name == "stopped") return ReportVerdict::Stopped;
    return ReportVerdict::None;
}

bool isQuiet(const std::string& kind) {
    static const std::vector<std::string> quiet{
        "arming",   "settings", "arming",   "settings",  "open",           "opened",      "armed",
        "arm",      "disarmed", "disarm",   "checking",  "check",          "started",     "start",
        "finished", "closed",   "close",    "end",       "delivering",     "state",       "interlock",
        "rounding", "rounded",  "progress", "paused",    "resumed",        "calibration", "drive",
        "profile",  "capture",  kMarkEvent, kMarksEvent, kCertificateEvent};
    return std::find(quiet.begin(), quiet.end(), kind) != quiet.end();
}

/// A run with such an event and no verdict was not completed. The last but one is from older versions.
bool endsARun(const std::string& kind) {
    return kind == "stop" || kind == "stopped" || kind == "fault" || kind == "script abandoned" ||
           kind == "script ended by an error";
}

/// Returns the sentence of an event: the event's own text, or one made of its fields.
QString sentenceOf(const QJsonObject& body) {
    for (const char* key : {"text", "message", "reason"}) {
        if (!body[QLatin1String(key)].isString()) continue;
        const auto said = body[QLatin1String(key)].toString();
        const auto gap = body["longest_gap_s"];  // longest time between two keep-alives
        return gap.isDouble() ? said + ": " + quantityText(gap.toDouble(), "s", 3) : said;
    }
    QStringList parts;
    for (auto it = body.begin(); it != body.end(); ++it) parts << it.key() + " " + plainText(it.value());
    return parts.join(", ");
}

void addEvent(ReportModel& model, const SessionRow& row) {
    ReportEvent event{toSeconds(row.at), text(row.name), sentenceOf(qtObject(row.body))};
    if (!model.events.empty() && row.name != kOperatorMarkEvent) {  // every mark stays a separate moment
        auto& last = model.events.back();
        if (last.kind == event.kind && last.text == event.text) {
            ++last.count;
            return;
        }
    }
    model.events.push_back(std::move(event));
}

/// Marks labels that were added after the session's end, to distinguish them from labels entered before it.
void takeLabels(const SessionLabels& labels, ReportBasis& basis) {
    const auto later = [](const std::string& now, QString& shown) {
        if (text(now) == shown) return;
        shown = now.empty() ? QString() : text(now) + " (entered after the recording ended)";
    };
    later(labels.operatorName, basis.operatorName);
    later(labels.sample, basis.sample);
    basis.note = text(labels.note);
    QStringList tags;
    for (const auto& tag : labels.tags) tags << text(tag);
    basis.tags = tags.join(", ");
}

Result<void> fillVerdict(const SessionReader& reader, ReportModel& model, const std::vector<SessionRow>& events) {
    const auto verdicts = reader.verdicts();
    if (!verdicts) return failure(verdicts);
    if (!verdicts->empty()) {
        model.verdict = verdictNamed(verdicts->back().verdict);
        for (const auto& reason : verdicts->back().reasons) model.reasons << text(reason);
        readBasis(qtObject(verdicts->back().results), model);
    } else {
        for (const auto& event : events) {
            if (!endsARun(event.name)) continue;
            model.verdict = ReportVerdict::Stopped;
            model.reasons = QStringList{sentenceOf(qtObject(event.body))};
        }
    }
    if (!reader.closed()) {
        model.certificate.reset();
        // H9: an interrupted run proves nothing, whatever its last verdict.
        if (model.verdict != ReportVerdict::Fail) model.verdict = ReportVerdict::Stopped;
        model.reasons.prepend("The session was not closed: the run was interrupted, or is still going on.");
    }
    return {};
}

}  // namespace

Result<ReportModel> readSessionReport(const std::filesystem::path& sessionFile) {
    const auto verified = verifySession(sessionFile);
    if (!verified) return failure(verified);
    const auto reader = SessionReader::open(sessionFile);
    if (!reader) return failure(reader);
    ReportModel model;
    for (const auto& problem : verified->problems) model.damage << text(problem);
    fillAbout(*reader, sessionFile, model);

    const auto marks = sessionMarks(*reader);
    if (!marks) return failure(marks);
    for (const auto& mark : *marks) model.marks << text(flagSentence(mark));
    const auto measurements = reader->measurements();
    if (!measurements) return failure(measurements);
    for (const auto& row : *measurements) {
        if (row.name != kExposureMeasurement) continue;
        QJsonObject body = qtObject(row.body);
        body["type"] = "exposure";
        const auto figure = parseFigure(body);
        if (!figure) return failure(figure);
        for (const auto& exposure : std::get<ExposureFigure>(figure->content).rows) addExposure(model, exposure);
    }
    const auto items = reader->reportItems();
    if (!items) return failure(items);
    readBasis({}, model);
    ItemReader itemReader(*reader, model);
    for (const auto& row : *items) {
        if (const auto& found = memberAt(row.body, "results");
            textOr(row.body, "kind") == "results" && found.is_object())
            model.items.emplace_back(ReportResults{found});
        else
            itemReader.take(qtObject(row.body));
    }
    itemReader.finish();

    const auto labels = reader->labels();
    if (!labels) return failure(labels);
    takeLabels(*labels, model.basis);

    const auto events = reader->events();
    if (!events) return failure(events);
    Instant last{0};
    QString calibration;
    for (const auto& row : *events) {
        if (row.name == "calibration") calibration = sentenceOf(qtObject(row.body));
        if (row.name == kCertificateEvent) {
            const auto body = qtObject(row.body);
            model.basis.certificate = sentenceOf(body);
            if (model.certificate) model.certificate->oscilloscope = body["certificate"].toObject();
        }
        last = std::max(last, row.at);
        if (!isQuiet(row.name)) addEvent(model, row);
    }
    for (const auto& row : *measurements) last = std::max(last, row.at);
    for (const auto& row : *items) last = std::max(last, row.at);
    const bool stimulates = std::any_of(model.devices.begin(), model.devices.end(),
                                        [](const ReportDevice& device) { return device.is(Role::Stimulator); });
    if (stimulates) {
        model.identity.insert(model.identity.begin(),
                              {"Stimulator calibration",
                               calibration.isEmpty() ? "not calibrated, as far as this session says" : calibration});
    }
    model.duration_s = toSeconds(last);
    if (auto filled = fillVerdict(*reader, model, *events); !filled) return failure(filled);
    return model;
}

Result<QStringList> writeSessionReport(const QString& sessionFile, const QStringList& paths) {
    for (const auto& path : paths)
        if (const auto format = reportFormat(path); !format) return failure(format);
    const auto model = readSessionReport(sessionFile.toStdString());
    if (!model) return failure(model);
    Result<void> all;
    for (const auto& path : paths)
        if (auto written = writeReport(*model, path); !written && all) all = std::move(written);
    if (!all) return failure(all);
    return model->damage;
}

}  // namespace tacto
