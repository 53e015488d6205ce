// SessionWords.h - a session in words: its name, when it was, how it ended, what happened in it.
//
// Thread-safety: pure functions; endingOf() the GUI thread, for the theme's colours.
#pragma once

#include <QColor>
#include <QDateTime>
#include <QList>
#include <QString>

#include "app/gui/sessions/ReadSession.h"
#include "app/gui/sessions/SessionModel.h"

namespace tacto::gui {

/// "Today 11:02", "Yesterday 16:20", "20 Nov 14:05"; in another year the date alone.
[[nodiscard]] QString beganText(const QDateTime& began);
/// "1 trial", "25 trials".
[[nodiscard]] QString trialsText(std::size_t count);
/// "1 kΩ, 10.0 V" of "1 kohm, 10.0 V": loads and conditions as people write them.
[[nodiscard]] QString conditionText(const std::string& condition);

/// The end of a session as a word, an icon and its colour.
struct SessionEnding {
    QString word;
    QString icon;
    QColor colour;
};
/// `recording`: of the session that is being written.
[[nodiscard]] SessionEnding endingOf(const SessionEntry& entry, bool recording);

/// A line of what happened.
struct SessionMoment {
    double at_s = 0;  ///< time on the session's time base
    QString when;     ///< time of day; on a virtual clock the time since the beginning
    QString text;     ///< a sentence
    bool mark = false;
};
/// What happened, in order, from the beginning to the end; what follows itself stands once, with its count.
[[nodiscard]] QList<SessionMoment> whatHappened(const ReadSession& session);
/// One event as a sentence: no ids, no JSON.
[[nodiscard]] QString eventSentence(const SessionRow& event);

/// A column of a stream for reading, "Pressure" of "pressure_pa", and its unit: its own, or the stream's.
[[nodiscard]] QString columnTitle(const SessionStream& stream, std::size_t column);
[[nodiscard]] QString columnUnit(const SessionStream& stream, std::size_t column);

}  // namespace tacto::gui
