// StepBox.h - a combo box of scales: steps of the ladder, and the scale that a box or a fit has made.
//
// Thread-safety: the GUI thread.
#pragma once

class QComboBox;
class QString;

namespace tacto::gui {

/// "20 V/div", with its value as data.
void addStep(QComboBox& box, double perDivision, const QString& unit);
/// Chooses the present scale. One that is not a step of the ladder stands last, as long as it is the present one.
void showStep(QComboBox& box, double now, const QString& unit);

}  // namespace tacto::gui
