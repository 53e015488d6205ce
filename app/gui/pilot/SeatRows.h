// SeatRows.h - fields of the forms before a session: what it runs, and how its two people sit.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>

#include "app/gui/pilot/InputRows.h"
#include "app/gui/pilot/PilotStart.h"
#include "app/gui/pilot/UnfinishedOffer.h"
#include "app/gui/theme/FieldForm.h"

class QScreen;

namespace tacto::gui {

/// The procedure of a session, and how it finds the level that is just felt.
[[nodiscard]] std::vector<FormField> procedureFields();
/// Shows the settings of an interrupted session that goes on.
void followOffer(FieldForm& form, const UnfinishedOffer& offer);
/// False where it finds thresholds alone.
[[nodiscard]] bool isWholeSession(const FieldForm& form);

/// Chooses the participant's screen: by its name, remembered, and watched. On a single screen the participant's window
/// covers the operator's.
class ScreenChoice final : public QComboBox {
    Q_OBJECT
public:
    explicit ScreenChoice(QWidget* parent = nullptr);
    /// The chosen one; null when it is gone.
    [[nodiscard]] QScreen* chosen() const;
    /// The chosen one; where it is gone another is chosen, as at first. Null without any screen.
    [[nodiscard]] QScreen* seat();
    [[nodiscard]] QString chosenName() const { return currentData().toString(); }
    /// Whether there is just one screen, so that the operator's window has none of its own.
    [[nodiscard]] static bool isOnly();

signals:
    void lost(const QString& name);  ///< the chosen one
    void back(const QString& name);

private:
    void fill();
};

/// The participant's screen and keys, the game pads and foot switches of both, markers, what the operator sees.
class SeatRows {
public:
    /// fields() are to be shown in `form`, which takes what they hold, before anything else is called.
    explicit SeatRows(FieldForm& form);
    [[nodiscard]] std::vector<FormField> fields() const;
    /// Called once they are shown.
    void connectFields();
    [[nodiscard]] ScreenChoice& screens() const { return *screen_; }
    [[nodiscard]] InputRows& inputs() const { return *inputs_; }
    void writeTo(PilotStart& start) const;
    /// Why a session cannot begin with the form as it is, a sentence; empty where it can.
    [[nodiscard]] QString missing(bool person) const;
    /// Recalls what is remembered of `place` (InputRows.h), and the markers' port: earlier choices are forgotten.
    void recall(const QString& place);
    /// Screen, keys and buttons are a person's. `realTime`: of a virtual participant's session.
    void showFor(bool person, bool realTime = false);
    /// A blind study's sessions are blind: that is part of its approval.
    void setBlind(bool study);
    /// The explanation of these, to be placed below the form.
    [[nodiscard]] QLabel* about() const { return about_; }

private:
    FieldForm& form_;
    ScreenChoice* screen_;
    InputRows* inputs_;
    QLabel* about_;
};

}  // namespace tacto::gui
