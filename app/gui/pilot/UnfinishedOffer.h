// UnfinishedOffer.h - offers to continue an interrupted session, or to end it and begin another. Neither is
// preselected.
//
// Thread-safety: the GUI thread; unfinishedOf() may be called wherever its Study may be.
#pragma once

#include <QDateTime>
#include <QFrame>
#include <QLabel>
#include <QRadioButton>
#include <optional>

#include "core/study/Study.h"

namespace tacto::gui {

struct Unfinished {
    int number = 0;
    std::string protocol;
    int answered = 0;  ///< number of answers on disk
    QDateTime brokenOff;
    bool mayGoOn = true;    ///< true if the session was interrupted recently enough to continue
    bool complete = false;  ///< the session was completed, but the study does not know: nothing is left to ask
    bool person = false;    ///< a person answered
    QString language{};     ///< in which its participant reads; empty if not known
    QString trouble{};      ///< why it cannot be resumed: its record cannot be read or was changed
    bool operator==(const Unfinished&) const = default;
};
/// Returns the participant's unfinished session; nothing if there is none. Errors: Unsupported without the study's key.
[[nodiscard]] Result<std::optional<Unfinished>> unfinishedOf(const Study& study, const Participant& participant);

class UnfinishedOffer final : public QFrame {
    Q_OBJECT
public:
    explicit UnfinishedOffer(QWidget* parent = nullptr);
    /// Shows the offer; hides itself if there is nothing to offer.
    void offer(const std::optional<Unfinished>& unfinished);
    /// Chooses to go on, if that is possible.
    void chooseGoOn() { goOn_->setChecked(goOn_->isEnabled() && asks()); }
    [[nodiscard]] bool asks() const { return offered_.has_value(); }
    /// Returns "resume" or "end", the protocol's setting; empty if nothing is offered or chosen.
    [[nodiscard]] std::string chosen() const;
    [[nodiscard]] bool goesOn() const { return chosen() == "resume"; }
    /// True if a session can begin: nothing is offered, or a choice has been made.
    [[nodiscard]] bool isSettled() const { return !asks() || !chosen().empty(); }
    [[nodiscard]] const std::optional<Unfinished>& offered() const { return offered_; }

signals:
    void changed();

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void fit();
    std::optional<Unfinished> offered_;
    QLabel* says_;
    QRadioButton* goOn_;
    QRadioButton* end_;
};

}  // namespace tacto::gui
