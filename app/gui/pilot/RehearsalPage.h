// RehearsalPage.h - what a rehearsal needs before it begins: where its study lies, who answers, what is run, and how
// both people sit. An interrupted rehearsal is offered for continuation.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QWidget>
#include <memory>

#include "app/gui/pilot/PilotStart.h"
#include "app/gui/pilot/SeatRows.h"
#include "app/gui/theme/EntryFields.h"
#include "app/gui/theme/Labels.h"

namespace tacto::gui {

class ProcedureRows;
class UnfinishedOffer;

class RehearsalPage final : public QWidget {
    Q_OBJECT
public:
    explicit RehearsalPage(QWidget* parent = nullptr);
    [[nodiscard]] PilotStart rehearsal() const;
    [[nodiscard]] ScreenChoice& screens() const { return seats_->screens(); }
    void setButtonDevices(std::shared_ptr<const ButtonDevices> devices) {
        seats_->inputs().setDevices(std::move(devices));
    }
    /// A sentence in the way; empty for none.
    void say(const QString& what);
    /// Looks again whether there is something to go on with.
    void look();
    /// The same in a new folder.
    void renew();

signals:
    void beginWanted();

private:
    void addStudyRows();
    void addParticipantRows();
    void addSessionRows();
    void judge();

    QLabel* title_;
    QFormLayout* rows_ = nullptr;
    FolderRow* folder_;
    UnfinishedOffer* offer_;
    QComboBox* who_;
    QComboBox* pace_;
    QSpinBox* seed_;
    QComboBox* modality_;
    ProcedureRows* procedure_;
    QSpinBox* blocks_;
    std::unique_ptr<SeatRows> seats_;
    TroubleLine* trouble_;
    QPushButton* begin_;
};

}  // namespace tacto::gui
