// SeatRows.h - form fields before a session: what to run, and screens, keys and devices for participant and operator.
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

/// Returns the fields for the protocol, and for the method that finds the detection threshold.
[[nodiscard]] std::vector<FormField> procedureFields();
/// Shows the settings of the interrupted session if that session is to continue.
void followOffer(FieldForm& form, const UnfinishedOffer& offer);
/// Says in `line` which typed value is refused, and takes it back once it is accepted. Returns true if one is refused.
bool sayRefused(TroubleLine& line, const FieldForm& form);
/// False if the session finds only thresholds.
[[nodiscard]] bool isWholeSession(const FieldForm& form);

/// Chooses the participant's screen by name, remembers it and notices when it goes. On a single screen the
/// participant's window covers the operator's.
class ScreenChoice final : public QComboBox {
    Q_OBJECT
public:
    explicit ScreenChoice(QWidget* parent = nullptr);
    /// Returns the chosen screen; null if it is gone.
    [[nodiscard]] QScreen* chosen() const;
    /// Returns the chosen screen; if it is gone, chooses another as fill() does. Null without any screen.
    [[nodiscard]] QScreen* seat();
    [[nodiscard]] QString chosenName() const { return currentData().toString(); }
    /// True if there is only one screen, so that both windows share it.
    [[nodiscard]] static bool isOnly();

signals:
    void lost(const QString& name);  ///< the chosen screen is gone
    void back(const QString& name);

private:
    void fill();
};

/// Fields for the participant's screen and keys, both people's game pads and foot switches, markers and blindness.
class SeatRows {
public:
    /// Show fields() in `form`, which takes the widgets, before any other call.
    explicit SeatRows(FieldForm& form);
    [[nodiscard]] std::vector<FormField> fields() const;
    /// Call this once the fields are shown.
    void connectFields();
    [[nodiscard]] ScreenChoice& screens() const { return *screen_; }
    [[nodiscard]] InputRows& inputs() const { return *inputs_; }
    /// Offers the languages of a study (its folder, the words that its approval states), of which one is read.
    void offerWords(const QString& folder, const std::vector<WordsHash>& approved);
    void writeTo(PilotStart& start) const;
    /// Returns a sentence that says why a session cannot begin with these settings; empty if it can.
    [[nodiscard]] QString missing(bool person) const;
    /// Restores what is remembered for `place` (InputRows.h), and the markers' port; forgets earlier choices.
    void recall(const QString& place);
    /// Shows screen, keys and buttons for a person only. `realTime`: a virtual participant takes a person's time.
    /// `lasts`: how long a virtual participant's session takes; empty: seconds.
    void showFor(bool person, const QString& lasts = {});
    /// Sets whether the study is blind. Its sessions are then always blind: that is part of its approval.
    void setBlind(bool study);
    /// Returns the explanation of these fields, to be placed below the form.
    [[nodiscard]] QLabel* about() const { return about_; }

private:
    QString wordsTrouble_;  // why the words cannot be read
    FieldForm& form_;
    ScreenChoice* screen_;
    InputRows* inputs_;
    QLabel* about_;
};

}  // namespace tacto::gui
