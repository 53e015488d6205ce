// SessionWords.h - describes a session in words: its name, when it took place, how it ended, what happened in it.
//
// Thread-safety: pure functions; endingOf() on the GUI thread, for the theme's colours.
#pragma once

#include <QColor>
#include <QDateTime>
#include <QList>
#include <QString>

#include "app/gui/sessions/ReadSession.h"
#include "app/gui/sessions/SessionModel.h"

namespace tacto::gui {

/// Returns "Today 11:02", "Yesterday 16:20", "20 Nov 14:05"; in another year only the date.
[[nodiscard]] QString beganText(const QDateTime& began);
/// Returns "1 kΩ, 10.0 V" for "1 kohm, 10.0 V": loads and conditions as people write them.
[[nodiscard]] QString conditionText(const std::string& condition);

/// The end of a session as a word, an icon and a colour.
struct SessionEnding {
    QString word;
    QString icon;
    QColor colour;
};
/// `recording`: this session is being written now.
[[nodiscard]] SessionEnding endingOf(const SessionEntry& entry, bool recording);

/// One line in the list of events.
struct SessionMoment {
    double at_s = 0;  ///< time on the session's time base
    QString when;     ///< time of day; on a virtual clock the time since the start
    QString text;     ///< a sentence
    bool mark = false;
};
/// Returns the events in order, from start to end; equal events in sequence become one line with their count.
[[nodiscard]] QList<SessionMoment> whatHappened(const ReadSession& session);
/// Returns one event as a sentence: no ids, no JSON.
[[nodiscard]] QString eventSentence(const SessionRow& event);

/// Return a stream column's readable name ("Pressure" for "pressure_pa"), and its unit: its own, or the stream's.
[[nodiscard]] QString columnTitle(const SessionStream& stream, std::size_t column);
[[nodiscard]] QString columnUnit(const SessionStream& stream, std::size_t column);

}  // namespace tacto::gui
