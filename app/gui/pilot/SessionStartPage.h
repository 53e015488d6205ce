// SessionStartPage.h - a session of a participant of a study before it begins: what was interrupted, what is run, how
// both people sit, and the exclusion checklist. A virtual participant has none: it answers no to each.
#pragma once

#include <QBoxLayout>
#include <QButtonGroup>
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
class UnfinishedOffer;

class SessionStartPage final : public QWidget {
    Q_OBJECT
public:
    /// `watch` outlives it: what is plugged in.
    explicit SessionStartPage(const DeviceWatch& watch, QWidget* parent = nullptr);
    /// Afresh for a session of `participant`.
    void prepare(const Study& study, const Participant& participant);
    /// All of it but the study's folder and passphrase.
    [[nodiscard]] PilotStart start() const;
    [[nodiscard]] ScreenChoice& screens() const { return seats_->screens(); }
    void setButtonDevices(std::shared_ptr<const ButtonDevices> devices) {
        seats_->inputs().setDevices(std::move(devices));
    }
    /// A sentence in the way; empty for none.
    void say(const QString& what);

signals:
    void beginWanted();
    void backWanted();

private:
    [[nodiscard]] QLayout* buildForm(QWidget& parent, const DeviceWatch& watch);
    void buildChecklist();
    void judge();

    std::string code_;
    QString title_;  ///< the study's title
    QString study_;  ///< its id
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
    QPushButton* begin_ = nullptr;
};

/// The questions of the exclusion checklist, each answered by yes or no. No answer is
/// preselected.
class ExclusionChecklist final : public QWidget {
    Q_OBJECT
public:
    explicit ExclusionChecklist(QWidget* parent = nullptr);
    void clear();
    /// The questions that are answered, in order.
    [[nodiscard]] std::vector<ExclusionAnswer> answers() const;
    [[nodiscard]] bool whole() const { return answers().size() == groups_.size(); }

signals:
    void changed();

private:
    enum Answer { kNo, kYes };
    std::vector<QButtonGroup*> groups_;  ///< as exclusionItems()
};

}  // namespace tacto::gui
