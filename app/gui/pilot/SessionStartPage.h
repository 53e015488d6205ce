// SessionStartPage.h - page before a study participant's session: an interrupted session, what to run, both people's
// screens and devices, and the exclusion checklist. A virtual participant sees none and answers no to each item.
#pragma once

#include <QBoxLayout>
#include <QButtonGroup>
#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QWidget>
#include <vector>

#include "app/gui/pilot/PilotStart.h"
#include "app/gui/pilot/SeatRows.h"
#include "app/gui/theme/Labels.h"
#include "core/study/Gates.h"
#include "core/study/Study.h"

namespace tacto::gui {

class DeviceRows;
class DeviceWatch;
class ExclusionChecklist;
class ScrollingPage;
class UnfinishedOffer;

class SessionStartPage final : public QWidget {
    Q_OBJECT
public:
    /// `watch`, which lists the connected devices, must outlive this page.
    explicit SessionStartPage(const DeviceWatch& watch, QWidget* parent = nullptr);
    /// Resets the page for a session with `participant`. Returns why none can begin or go on now, as far as the study
    /// knows before the checklist is answered; then the page is as before.
    [[nodiscard]] QString prepare(const Study& study, const Participant& participant);
    /// Chooses to go on with the interrupted session, if that is possible.
    void chooseGoOn();
    /// Returns all settings except the study's folder and passphrase.
    [[nodiscard]] PilotStart start() const;
    [[nodiscard]] ScreenChoice& screens() const { return seats_->screens(); }
    void setButtonDevices(std::shared_ptr<const ButtonDevices> devices) {
        seats_->inputs().setDevices(std::move(devices));
    }
    /// Shows a sentence that says why no session can begin; empty if there is none.
    void say(const QString& what);

signals:
    void beginWanted();
    void endDayWanted();  ///< a question was answered with yes, which the study is to keep
    void backWanted();

private:
    [[nodiscard]] QLayout* buildForm(QWidget& parent, const DeviceWatch& watch);
    void buildChecklist();
    void judge();

    std::string code_;
    QString refusedAnew_, refusedAgain_;  ///< why no session begins, and why an interrupted one cannot go on
    QString title_;                       ///< the study's title
    QString study_;                       ///< the study's id
    int blocks_ = 5;
    std::uint64_t seed_ = 0;  ///< of a virtual participant
    bool virtual_ = false;
    bool rehearsal_ = false;
    bool massager_ = false;
    QLabel* head_;
    QLabel* about_;
    UnfinishedOffer* offer_;
    FieldForm* form_ = nullptr;
    DeviceRows* devices_ = nullptr;
    std::unique_ptr<SeatRows> seats_;
    QWidget* asks_ = nullptr;
    ExclusionChecklist* checklist_ = nullptr;
    TroubleLine* trouble_;
    ScrollingPage* page_ = nullptr;
    QPushButton* begin_ = nullptr;
    QPushButton* endDay_ = nullptr;  ///< in the place of begin_ after a yes
    QLabel* whyNot_ = nullptr;       ///< why no session can begin, beside the button
};

/// The questions of the exclusion checklist, each answered by yes or no. No answer is preselected. A yes that is
/// changed to no stays a yes until the operator ticks that it was a slip.
class ExclusionChecklist final : public QWidget {
    Q_OBJECT
public:
    explicit ExclusionChecklist(QWidget* parent = nullptr);
    /// Asks these questions, none of them answered.
    void ask(const std::vector<ExclusionItem>& items);
    /// Returns the answers given so far, in order.
    [[nodiscard]] std::vector<ExclusionAnswer> answers() const;
    [[nodiscard]] const std::vector<ExclusionItem>& items() const { return items_; }
    [[nodiscard]] bool whole() const { return answers().size() == groups_.size(); }
    /// True if a yes was changed to no, whether or not it is ticked as a slip.
    [[nodiscard]] bool changedFromYes() const;

signals:
    void changed();

private:
    enum Answer { kNo, kYes };
    void addRow(const ExclusionItem& item);
    void noteAnswer(std::size_t row, bool yes);
    QGridLayout* grid_;
    QCheckBox* slip_;  ///< shown after a yes was changed to no
    std::vector<ExclusionItem> items_;
    std::vector<QButtonGroup*> groups_;  ///< in the order of items_
    std::vector<bool> saidYes_;          ///< for each of items_: whether yes was chosen, perhaps not any more
};

}  // namespace tacto::gui
