// StudyDialogs.h - dialogs that change an open study, each to be opened by openDialog(). Where the study refuses, the
// dialog stays and says why. `study` outlives it.
#pragma once

#include <QDialog>
#include <functional>

#include "app/gui/study/OpenStudy.h"

namespace tacto::gui {

/// Enrols a participant and shows their code, once and large: for them to keep, not for notes. `consentWanted` is the
/// next step with them.
[[nodiscard]] QDialog* enrolDialog(OpenStudy& study, std::function<void(const QString& code)> consentWanted,
                                   QWidget* parent);
/// Notes that a participant consented: to which version, when, and before which investigator.
[[nodiscard]] QDialog* consentDialog(OpenStudy& study, const QString& code, QWidget* parent);
/// Ends a participant's part: leaving keeps their data, withdrawing destroys the key to them, which takes the code
/// typed once more and says what it cannot reach.
enum class EndOfPart { Leave, Withdraw };
[[nodiscard]] QDialog* endPartDialog(OpenStudy& study, EndOfPart how, const QString& code, QWidget* parent);
/// Notes an adverse event of a session; it survives a withdrawal. `code`: the person whose last session is chosen
/// first; may be empty.
[[nodiscard]] QDialog* adverseEventDialog(OpenStudy& study, const QString& code, QWidget* parent);
/// Notes what a participant reports on a day after a session: side effects, redness, swelling.
[[nodiscard]] QDialog* nextDayDialog(OpenStudy& study, const QString& code, QWidget* parent);
/// Changes a study's settings under an amendment of the committee, which has a reference of its own.
[[nodiscard]] QDialog* amendDialog(OpenStudy& study, QWidget* parent);
/// Continues with a study's ledger that is not the newest that this computer knows: says what is lost, and takes the
/// passphrase once more and the word that names the loss.
[[nodiscard]] QDialog* goBackDialog(OpenStudy& study, QWidget* parent);

}  // namespace tacto::gui
