#include "app/gui/study/DialogField.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QObject>
#include <QStringList>

#include "app/gui/theme/Text.h"

namespace tacto::gui {

ProtocolParameter dialogField(const char* name, const QString& label, ParameterType type, std::string value) {
    ProtocolParameter made;
    made.name = name;
    made.label = label.toStdString();
    made.type = type;
    made.value = std::move(value);
    return made;
}

QString scoreChoice(std::span<const char* const> words, int score, int from) {
    return QString("%1  %2").arg(score).arg(QCoreApplication::translate("Score", words[std::size_t(score - from)]));
}

ProtocolParameter scoreField(const char* name, const QString& label, std::span<const char* const> words,
                             const QString& needed, int from) {
    auto made = dialogField(name, label, ParameterType::Choice, {});
    made.needed = needed.toStdString();
    made.choices.emplace_back("", QObject::tr("to be chosen").toStdString());
    for (int score = from; score < from + int(words.size()); ++score)
        made.choices.emplace_back(std::to_string(score), scoreChoice(words, score, from).toStdString());
    return made;
}

ProtocolParameter sessionField(const Study& study, const QString& code) {
    auto made = dialogField("session", QObject::tr("Session"), ParameterType::Choice, {});
    made.needed = QObject::tr("it belongs to nothing").toStdString();
    std::string chosen, last;
    for (const auto& each : study.sessions()) {
        const auto begun = QDateTime::fromSecsSinceEpoch(each.parts.front().begun.time_since_epoch().count());
        const auto who = each.code.empty() ? QObject::tr("withdrawn") : qtext(each.code);
        made.choices.emplace_back(each.id, QObject::tr("%1, session %2, %3")
                                               .arg(who)
                                               .arg(each.number)
                                               .arg(begun.toString("yyyy-MM-dd HH:mm"))
                                               .toStdString());
        last = each.id;
        if (!code.isEmpty() && qtext(each.code) == code) chosen = each.id;
    }
    if (made.choices.empty()) made.choices.emplace_back("", QObject::tr("no session was begun").toStdString());
    if (chosen.empty() && code.isEmpty()) chosen = last;
    if (chosen.empty() && !made.choices.front().first.empty()) {
        const auto none = QObject::tr("to be chosen: %1 has no session").arg(code).toStdString();
        made.choices.insert(made.choices.begin(), {"", none});
    }
    made.value = chosen;
    return made;
}

}  // namespace tacto::gui
