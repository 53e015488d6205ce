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

/// What a session runs, and how it finds the level that is just felt.
[[nodiscard]] std::vector<FormField> procedureFields();
/// Where an interrupted session goes on, its own.
void followOffer(FieldForm& form, const UnfinishedOffer& offer);
/// Else thresholds alone.
[[nodiscard]] bool isWholeSession(const FieldForm& form);

/// Which screen is the participant's: by its name, remembered, and watched.
/// Where there is one screen the participant's window covers it.
class ScreenChoice final : public QComboBox {
    Q_OBJECT
public:
    explicit ScreenChoice(QWidget* parent = nullptr);
    /// The chosen one; null when it is gone.
    [[nodiscard]] QScreen* chosen() const;
    /// The chosen one; where it is gone another is chosen, as at first. Null without any screen.
    [[nodiscard]] QScreen* seat();
    [[nodiscard]] QString chosenName() const { return currentData().toString(); }
    /// Whether the operator's window has one of its own beside it.
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
    /// Once they are shown.
    void connectFields();
    [[nodiscard]] ScreenChoice& screens() const { return *screen_; }
    [[nodiscard]] InputRows& inputs() const { return *inputs_; }
    void writeTo(PilotStart& start) const;
    /// Why a session cannot begin with the form as it is, a sentence; empty where it can.
    [[nodiscard]] QString missing(bool person) const;
    /// What is remembered of `place` (InputRows.h), and the markers' port: chosen before is forgotten.
    void recall(const QString& place);
    /// Screen, keys and buttons are a person's. `realTime`: of a virtual participant's session.
    void showFor(bool person, bool realTime = false);
    /// A blind study's sessions are blind: that is part of its approval.
    void setBlind(bool study);
    /// What that means, to be placed below the form.
    [[nodiscard]] QLabel* about() const { return about_; }

private:
    FieldForm& form_;
    ScreenChoice* screen_;
    InputRows* inputs_;
    QLabel* about_;
};

}  // namespace tacto::gui
