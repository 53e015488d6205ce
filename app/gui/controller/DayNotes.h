// DayNotes.h - who works at this bench today, on which sample: asked once a day, written into every session that is
// begun on that day, and shown where it can be changed.
//
// Notes of another day no longer count: the person and the sample may have changed.
#pragma once

#include <QDate>
#include <QObject>
#include <functional>

#include "app/run/RunNotes.h"

namespace tacto::gui {

class DayNotes final : public QObject {
    Q_OBJECT
public:
    /// `today` is asked whenever it matters; empty: the computer's.
    explicit DayNotes(QObject* parent = nullptr, std::function<QDate()> today = {});

    /// The notes as entered today; empty where nothing was.
    [[nodiscard]] RunNotes notes() const;
    /// Keeps them until the day is over, beyond the end of the program.
    void set(const RunNotes& notes);
    /// Whether the question was answered or put off today.
    [[nodiscard]] bool asked() const;
    void noteAsked();
    /// Whether the day's notes have to be asked for before a session. True where the program has been open since
    /// another day and was not asked today: wanted() asks, and what was ordered does not begin. It is ordered again
    /// after the answer.
    [[nodiscard]] bool asksFirst();
    /// Why what was ordered does not begin on a new day.
    [[nodiscard]] static QString wantedText() { return tr("A new day: enter operator and sample, then start again."); }
    /// The notes of the last day before, to be offered. Empty where nothing is known.
    [[nodiscard]] RunNotes before() const;
    /// "A. Weber · sample S-014"; empty where neither was entered.
    [[nodiscard]] QString words() const;

signals:
    void changed();
    void wanted();  ///< the question, by asksFirst()

private:
    [[nodiscard]] bool isToday(const char* group) const;
    void beginDay();
    const std::function<QDate()> today_;
    const QDate began_;  // the program's first day: that day's question is asked at the start
};

}  // namespace tacto::gui
