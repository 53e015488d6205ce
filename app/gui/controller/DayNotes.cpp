#include "app/gui/controller/DayNotes.h"

#include <QSettings>

namespace tacto::gui {

namespace {

// Two groups of settings: the newest day with notes, and the day with notes before it.
constexpr const char* kDay = "day";
constexpr const char* kDayBefore = "dayBefore";

struct DayField {
    const char* key;
    std::string RunNotes::*text;
};
constexpr DayField kDayFields[] = {{"operator", &RunNotes::operatorName},
                                   {"sample", &RunNotes::sample},
                                   {"reviewer", &RunNotes::reviewer},
                                   {"ambient", &RunNotes::ambient}};

QString keyOf(const char* group, const char* key) { return QString("%1/%2").arg(group, key); }

RunNotes storedIn(const char* group) {
    const QSettings settings;
    RunNotes notes;
    for (const auto& field : kDayFields)
        notes.*field.text = settings.value(keyOf(group, field.key)).toString().toStdString();
    return notes;
}

void store(const char* group, const RunNotes& notes) {
    QSettings settings;
    for (const auto& field : kDayFields)
        settings.setValue(keyOf(group, field.key), QString::fromStdString(notes.*field.text));
}

}  // namespace

DayNotes::DayNotes(QObject* parent, std::function<QDate()> today)
    : QObject(parent), today_(today ? std::move(today) : [] { return QDate::currentDate(); }), began_(today_()) {}

bool DayNotes::isToday(const char* group) const { return QSettings().value(keyOf(group, "date")).toDate() == today_(); }

RunNotes DayNotes::notes() const { return isToday(kDay) ? storedIn(kDay) : RunNotes{}; }

RunNotes DayNotes::before() const { return storedIn(isToday(kDay) ? kDayBefore : kDay); }

void DayNotes::set(const RunNotes& notes) {
    beginDay();
    store(kDay, notes);
    emit changed();
}

bool DayNotes::asked() const { return isToday(kDay); }

bool DayNotes::asksFirst() {
    if (asked() || today_() == began_) return false;
    emit wanted();
    return true;
}

void DayNotes::noteAsked() {
    if (isToday(kDay)) return;
    beginDay();
    emit changed();
}

void DayNotes::beginDay() {
    if (isToday(kDay)) return;
    if (const auto last = storedIn(kDay); !last.operatorName.empty() || !last.sample.empty()) store(kDayBefore, last);
    store(kDay, {});
    QSettings().setValue(keyOf(kDay, "date"), today_());
}

QString DayNotes::words() const {
    const auto today = notes();
    QStringList words;
    if (!today.operatorName.empty()) words << QString::fromStdString(today.operatorName);
    if (!today.sample.empty()) words << tr("sample %1").arg(QString::fromStdString(today.sample));
    return words.join(" · ");
}

}  // namespace tacto::gui

#include "moc_DayNotes.cpp"
