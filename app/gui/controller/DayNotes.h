// DayNotes.h - who works at this bench today, and on which sample: asked once a day, written into every session of that
// day, and shown where it can be changed.
//
// Notes of another day are not used: the person and the sample may have changed.
#pragma once

#include <QDate>
#include <QObject>
#include <functional>

#include "app/run/RunNotes.h"

namespace tacto::gui {

class DayNotes final : public QObject {
    Q_OBJECT
public:
    /// `today` returns the date whenever needed; empty: the computer's date.
    explicit DayNotes(QObject* parent = nullptr, std::function<QDate()> today = {});

    /// Returns the notes entered today; empty if there are none.
    [[nodiscard]] RunNotes notes() const;
    /// Stores the notes until the end of the day, even if the program ends.
    void set(const RunNotes& notes);
    /// True if the question was answered or put off today.
    [[nodiscard]] bool asked() const;
    void noteAsked();
    /// True if the day's notes must be asked for before a session: the program has been open since another day and has
    /// not asked today. Then emits wanted(), and the order must not begin; after the answer the user orders it again.
    [[nodiscard]] bool asksFirst();
    /// Returns the sentence that says why an order does not begin on a new day.
    [[nodiscard]] static QString wantedText() { return tr("A new day: enter operator and sample, then start again."); }
    /// Returns the notes of the last day before today, to be offered. Empty if there are none.
    [[nodiscard]] RunNotes before() const;
    /// Returns "A. Weber · sample S-014"; empty if neither was entered.
    [[nodiscard]] QString words() const;

signals:
    void changed();
    void wanted();  ///< asks for the notes; emitted by asksFirst()

private:
    [[nodiscard]] bool isToday(const char* group) const;
    void beginDay();
    const std::function<QDate()> today_;
    const QDate began_;  // the day on which the program started, when the notes are asked for at the start
};

}  // namespace tacto::gui
