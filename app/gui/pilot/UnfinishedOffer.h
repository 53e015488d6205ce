// UnfinishedOffer.h - offers to go on with an interrupted session, or to end it and begin another. Neither is
// preselected.
//
// Thread-safety: the GUI thread; unfinishedOf() is as Study.
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
    int answered = 0;  ///< answers on disk
    QDateTime brokenOff;
    bool mayGoOn = true;    ///< it was not too long ago to go on
    bool complete = false;  ///< the program was ended before the study knew: nothing is left to ask
    QString trouble{};      ///< why it cannot be resumed, where its record cannot be read or was changed
    bool operator==(const Unfinished&) const = default;
};
/// The participant's unfinished session; nothing without one. Errors: Unsupported without the study's key.
[[nodiscard]] Result<std::optional<Unfinished>> unfinishedOf(const Study& study, const Participant& participant);

class UnfinishedOffer final : public QFrame {
    Q_OBJECT
public:
    explicit UnfinishedOffer(QWidget* parent = nullptr);
    /// Hides itself where there is nothing to offer.
    void offer(const std::optional<Unfinished>& unfinished);
    [[nodiscard]] bool asks() const { return offered_.has_value(); }
    /// "resume" or "end", as the protocol's setting; empty where nothing is offered or chosen.
    [[nodiscard]] std::string chosen() const;
    [[nodiscard]] bool goesOn() const { return chosen() == "resume"; }
    /// Whether a session can begin: nothing is offered, or a choice is made.
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
