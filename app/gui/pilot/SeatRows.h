// SeatRows.h - rows of a form: how the two people of a session sit. The participant's screen and keys, the game pads
// and foot switches of both, what the operator sees.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>

#include "app/gui/pilot/InputRows.h"
#include "app/gui/pilot/PilotStart.h"

namespace tacto::gui {

class ScreenChoice;

class SeatRows {
public:
    /// The rows are added to `form`, and belong to `parent`.
    SeatRows(QFormLayout& form, QWidget& parent);
    [[nodiscard]] ScreenChoice& screens() const { return *screen_; }
    [[nodiscard]] InputRows& inputs() const { return *inputs_; }
    void writeTo(PilotStart& start) const;
    /// Where recorders connect for markers; "off" or empty: none are sent. Remembered.
    [[nodiscard]] QLineEdit& markers() const { return *markers_; }
    /// Why a session cannot begin with these rows, a sentence; empty where it can.
    [[nodiscard]] QString missing(bool person) const;
    /// What is remembered of `place` (RememberedInputs.h), and the markers' port: chosen before is forgotten.
    void recall(const QString& place);
    /// Screen, keys and buttons are a person's. `realTime`: of a virtual participant's session.
    void showFor(bool person, bool realTime = false);
    /// A blind study's sessions are blind: that is part of its approval.
    void setBlind(bool study);
    /// What that means, to be placed below the form.
    [[nodiscard]] QLabel* about() const { return about_; }
    /// The last row that takes the focus.
    [[nodiscard]] QWidget* last() const { return blind_; }

private:
    QFormLayout& form_;
    ScreenChoice* screen_;
    QComboBox* keys_;
    InputRows* inputs_;
    QLineEdit* markers_;
    QCheckBox* blind_;
    QLabel* about_;
};

}  // namespace tacto::gui
