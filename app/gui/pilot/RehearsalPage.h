// RehearsalPage.h - form to begin a rehearsal: the study's folder, who answers, what to run, and screens, keys and
// devices for both people. Offers to continue an interrupted rehearsal.
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
    /// Shows a sentence that says why no session can begin; empty if there is none.
    void say(const QString& what);
    /// Checks again whether a session can be resumed.
    void look();
    /// True if the folder's interrupted session can go on.
    [[nodiscard]] bool mayGoOn() const;
    [[nodiscard]] QString folder() const { return folder_->folder(); }
    /// Starts over in a new folder.
    void renew();

signals:
    void beginWanted();
    void resultWanted(const QString& session);  ///< of the folder's last session that has ended

private:
    [[nodiscard]] std::vector<FormField> fields() const;
    [[nodiscard]] bool person() const;  ///< a person answers
    void judge();

    QLabel* title_;
    FieldForm* form_ = nullptr;
    FolderRow* folder_;
    UnfinishedOffer* offer_;
    std::optional<Modality> modality_;  ///< the modality of a rehearsal that already exists
    std::optional<bool> person_;        ///< whether a person answered in the participant's last session
    QString ended_;                     ///< the id of the last session that has ended
    QString seen_;                      ///< the seed of the last check
    std::unique_ptr<SeatRows> seats_;
    TroubleLine* trouble_;
    QPushButton* begin_ = nullptr;
    QLabel* whyNot_ = nullptr;  ///< why no rehearsal can begin, beside the button
    QPushButton* result_ = nullptr;
};

}  // namespace tacto::gui
