#include "app/gui/sessions/SessionWords.h"

#include <QLocale>
#include <algorithm>
#include <map>

#include "app/gui/theme/ScriptPlace.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/gui/theme/VerdictBlock.h"
#include "app/report/NumberText.h"
#include "core/base/JsonText.h"
#include "core/base/QuantityText.h"
#include "core/dsp/RoughnessFlags.h"

namespace tacto::gui {

namespace {

constexpr int kShortValues = 60;  // most characters of values after an event's own text

QString words(const char* text) { return QObject::tr(text); }

/// The words for known kinds of events; other kinds are shown by their own name.
const std::map<std::string, const char*>& titles() {
    static const std::map<std::string, const char*> all{
        {"fault", QT_TR_NOOP("Fault")},
        {"refused", QT_TR_NOOP("A train was refused")},
        {"stale", QT_TR_NOOP("The fingertip fell silent")},
        {"records lost", QT_TR_NOOP("Records were lost")},
        {"device report", QT_TR_NOOP("A device reports")},
        {"calibration", QT_TR_NOOP("Stimulator calibration")},
        {kCertificateEvent, QT_TR_NOOP("Oscilloscope certificate")},
        {kMarkEvent, QT_TR_NOOP("R drove the output, flagged")},
        {kMeasuredBeyondEvent, QT_TR_NOOP("Output was not as set")},
        {"operator", QT_TR_NOOP("The operator answered")},
        {"script not started", QT_TR_NOOP("The script was not started")},
        {"capture warning", QT_TR_NOOP("Oscilloscope")},
        {"unattended", QT_TR_NOOP("Output ended")},
        {"unrecorded", QT_TR_NOOP("Output ended")},
        {"sleep", QT_TR_NOOP("Output ended")},
        {"arming", QT_TR_NOOP("Arming")},
    };
    return all;
}

/// Returns "Encoding: A max, interval ratio per train; roughness: surfaces" for "encoding.A_max_v" and so on.
QString fieldNames(const std::vector<std::string>& places) {
    std::vector<std::pair<QString, QStringList>> sections;
    const auto within = [](const QString& title) {
        return title.size() > 1 && title[1].isLower() ? title[0].toLower() + title.mid(1) : title;
    };
    for (const auto& place : places) {
        const auto parts = qtext(place).split('.');
        const auto section = parts.size() > 1 ? columnName(parts.front()).title : QString();
        if (sections.empty() || sections.back().first != section) sections.push_back({section, {}});
        QStringList names;
        for (qsizetype i = parts.size() > 1 ? 1 : 0; i < parts.size(); ++i) names << columnName(parts[i]).title;
        sections.back().second << within(names.join(", "));
    }
    QStringList all;
    for (const auto& [section, names] : sections) {
        const auto said = section.isEmpty() ? names.join(", ") : section + ": " + names.join(", ");
        all << (all.isEmpty() ? said : within(said));
    }
    return all.join("; ");
}

QString scalarText(const nlohmann::json& value, const QString& unit) {
    if (value.is_number()) return quantityText(value.get<double>(), unit, 4);
    if (value.is_boolean()) return value.get<bool>() ? words("yes") : words("no");
    if (value.is_string()) return qtext(value.get<std::string>());
    return QString("–");
}

/// Returns "Net charge 1.20 µC, Load 1 kΩ": the plain values of a body, named as in tables. Joins lists of words.
QString fieldsText(const nlohmann::json& body) {
    QStringList parts;
    for (const auto& [key, value] : body.items()) {
        const auto named = columnName(qtext(key));
        if (value.is_array()) {
            QStringList each;
            for (const auto& one : value)
                if (one.is_primitive()) each << scalarText(one, named.unit).replace('_', ' ').replace('.', ' ');
            if (!each.isEmpty()) parts << named.title.toLower() + " " + each.join(", ");
        } else if (value.is_primitive() && !value.is_null()) {
            parts << named.title.toLower() + " " + scalarText(value, named.unit);
        }
    }
    return parts.join(", ");
}

/// Returns the numbers of a body that also has text.
nlohmann::json numbersOf(const nlohmann::json& body) {
    auto numbers = nlohmann::json::object();
    for (const auto& [key, value] : body.items())
        if (value.is_number()) numbers[key] = value;
    return numbers;
}

/// Returns the event's own text.
QString ownWords(const nlohmann::json& body) {
    for (const char* key : {"text", "message", "reason", "why"})
        if (const auto own = textOr(body, key); !own.empty()) return qtext(own);
    return {};
}

QString armingSentence(const nlohmann::json& body) {
    const auto load = conditionText(textOr(body, "load"));
    const bool calibrated = flagOr(body, "calibrated");
    return QObject::tr("Arming was asked for, into a load declared as %1, with a stimulator that is %2.")
        .arg(load.isEmpty() ? QString("–") : load, calibrated ? words("calibrated") : words("not calibrated"));
}

QString marksSentence(const nlohmann::json& body) {
    QStringList flags;
    for (const auto& flag : textsOr(body, "flags")) flags << qtext(flagSentence(flag));
    return flags.isEmpty() ? words("The bench was closed without a flag of R.")
                           : QObject::tr("The bench was closed. %1").arg(flags.join(' '));
}

/// Returns "11:02:10" if the session has a time of day, "0:12.3" on a virtual clock.
QString momentText(const ReadSession& session, Instant at) {
    const auto& about = session.about;
    const auto start = QDateTime::fromString(qtext(about.wallStart), Qt::ISODate);
    if (!about.virtualClock && start.isValid())
        return start.addMSecs(qint64(toSeconds(at - about.wallStartAt) * 1e3)).toLocalTime().toString("HH:mm:ss");
    return minutesText(std::max(0.0, toSeconds(at)));
}

QString beginning(const ReadSession& session) {
    const auto& labels = session.labels;
    QStringList devices;
    for (const auto& device : session.about.devices) devices << qtext(device.name);
    devices.removeDuplicates();
    return QObject::tr("%1 began%2%3%4.")
        .arg(procedureText(session.about.protocol),
             labels.operatorName.empty() ? QString() : QObject::tr(", by %1").arg(qtext(labels.operatorName)),
             labels.sample.empty() ? QString() : QObject::tr(", on sample %1").arg(qtext(labels.sample)),
             devices.isEmpty() ? words(", without devices") : QObject::tr(", with %1").arg(devices.join(", ")));
}

QString ending(const ReadSession& session) {
    if (!session.closed && session.elsewhere) return words("Another program is recording it.");
    if (!session.closed) return words("The recording has no end mark: a crash, or it is still going on.");
    QStringList found;
    const auto trials = session.trials.size();
    if (trials > 0) found << (trials == 1 ? QObject::tr("1 trial") : QObject::tr("%1 trials").arg(trials));
    const auto& delivered = session.delivered;
    if (delivered.trains > 0)
        found << (delivered.unit.empty() ? QObject::tr("%1 trains").arg(delivered.trains)
                                         : QObject::tr("%1 trains of at most %2")
                                               .arg(delivered.trains)
                                               .arg(quantityText(delivered.most, qtext(delivered.unit), 4)));
    return found.isEmpty() ? words("Ended in order; nothing was delivered.")
                           : QObject::tr("Ended in order: %1.").arg(found.join(", "));
}

}  // namespace

QString conditionText(const std::string& condition) { return withOhmSigns(qtext(condition)); }

QString beganText(const QDateTime& began) {
    const auto today = QDate::currentDate();
    const auto time = began.toString("HH:mm");
    if (began.date() == today) return QObject::tr("Today %1").arg(time);
    if (began.date() == today.addDays(-1)) return QObject::tr("Yesterday %1").arg(time);
    const auto language = QLocale::c();
    return began.date().year() == today.year() ? language.toString(began, "d MMM HH:mm")
                                               : language.toString(began, "d MMM yyyy");
}

SessionEnding endingOf(const SessionEntry& entry, bool recording) {
    const auto as = [](const QString& word, const VerdictStyle& style) {
        return SessionEnding{word, style.icon, style.colour};
    };
    if (!entry.problem.isEmpty()) return as(words("cannot be read"), verdictStyle("error"));
    if (recording) return {words("recording"), "state-delivering", verdictStyle({}).colour};
    if (entry.elsewhere) return {words("recording in another program"), "state-delivering", verdictStyle({}).colour};
    const auto& summary = entry.summary;
    if (!summary.verdict.empty() && summary.verdict != "none")
        return as(qtext(summary.verdict), verdictStyle(qtext(summary.verdict)));
    if (!summary.closed) return as(words("not ended in order"), verdictStyle("error"));
    if (summary.faulted) return {words("fault"), "state-faulted", colours().fault};
    return as(words("no verdict"), verdictStyle({}));
}

QString eventSentence(const SessionRow& event) {
    const auto& body = event.body;
    const auto own = ownWords(body);
    if (event.name == kOperatorMarkEvent) return QObject::tr("Mark: “%1”").arg(own);
    if (event.name == "interlock") return sentence(own);
    if (event.name == "arming") return armingSentence(body);
    if (event.name == kMarksEvent) return marksSentence(body);
    if (event.name == "settings")
        return QObject::tr("The encoding profile was changed. %1.").arg(fieldNames(textsOr(body, "changed")));
    auto kind = qtext(event.name);
    if (kind.startsWith("script: ")) kind = kind.mid(8);
    const auto known = titles().find(event.name);
    const auto title = known != titles().end() ? words(known->second) : titled(kind.replace('_', ' '));
    const auto values = fieldsText(numbersOf(body));
    const bool few = !own.isEmpty() && !values.isEmpty() && values.size() < kShortValues;
    const auto rest = own.isEmpty() ? fieldsText(body) : few ? own + " (" + values + ")" : own;
    return rest.isEmpty() ? title + '.' : sentence(title + ": " + rest);
}

QList<SessionMoment> whatHappened(const ReadSession& session) {
    struct Line {
        Instant at;
        QString text;
        bool mark;
    };
    std::vector<Line> lines;
    for (const auto& event : session.events)
        lines.push_back({event.at, eventSentence(event), event.name == kOperatorMarkEvent});
    for (const auto& line : session.log) lines.push_back({line.at, sentence(qtext(textOr(line.body, "text"))), false});
    for (const auto& verdict : session.verdicts) {
        const auto why =
            verdict.reasons.empty() ? QString() : ": " + withoutScriptPlace(qtext(verdict.reasons.front()));
        lines.push_back({verdict.at, sentence(QObject::tr("Verdict %1%2").arg(qtext(verdict.verdict), why)), false});
    }
    std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
    QList<SessionMoment> all{{toSeconds(session.about.wallStartAt), momentText(session, session.about.wallStartAt),
                              beginning(session), false}};
    std::size_t repeats = 1;
    const auto count = [&] {
        if (repeats > 1) all.back().text += QObject::tr(" (%1 times)").arg(repeats);
        repeats = 1;
    };
    QString last;
    for (const auto& line : lines) {
        if (line.text == last && !line.mark) {
            ++repeats;
            continue;
        }
        count();
        last = line.text;
        all << SessionMoment{toSeconds(line.at), momentText(session, line.at), line.text, line.mark};
    }
    count();
    all << SessionMoment{toSeconds(session.length), momentText(session, session.length), ending(session), false};
    for (const auto& each : session.signatures) {
        const auto at = QDateTime::fromString(qtext(each.signature.wall), Qt::ISODate).toLocalTime();
        all << SessionMoment{toSeconds(session.length), at.toString("yyyy-MM-dd HH:mm"), qtext(sentenceOf(each)),
                             false};
    }
    return all;
}

QString columnTitle(const SessionStream& stream, std::size_t column) {
    const auto key = qtext(stream.columns.at(column));
    return key.size() == 1 ? key : columnName(key).title;
}

QString columnUnit(const SessionStream& stream, std::size_t column) {
    const auto own = columnName(qtext(stream.columns.at(column))).unit;
    return own.isEmpty() ? qtext(writtenUnit(stream.unit)) : own;
}

}  // namespace tacto::gui
