// RehearsalPage.h - what a rehearsal needs before it begins: where its study lies, who answers, what is run, and how
// both people sit. An interrupted rehearsal is offered for continuation.
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QWidget>
#include <memory>

#include "app/gui/pilot/PilotStart.h"
#include "app/gui/pilot/SeatRows.h"
#include "app/gui/theme/EntryFields.h"
#include "app/gui/theme/Labels.h"

namespace tacto::gui {

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
    /// Looks again whether a session can be resumed.
    void look();
    /// Starts over in a new folder.
    void renew();

signals:
    void beginWanted();

private:
    [[nodiscard]] std::vector<FormField> fields() const;
    [[nodiscard]] bool person() const;   ///< answers
    [[nodiscard]] bool ownPace() const;  ///< the session's
    void judge();

    QLabel* title_;
    FieldForm* form_ = nullptr;
    FolderRow* folder_;
    UnfinishedOffer* offer_;
    std::optional<Modality> modality_;  ///< the modality of a rehearsal that exists already
    QString seen_;                      ///< the seed that was looked for
    std::unique_ptr<SeatRows> seats_;
    TroubleLine* trouble_;
    QPushButton* begin_ = nullptr;
};

}  // namespace tacto::gui
