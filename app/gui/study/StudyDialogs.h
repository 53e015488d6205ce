// StudyDialogs.h - dialogs that change an open study, each shown with openDialog(). If the study refuses the change,
// the dialog stays open and says why. `study` must outlive the dialog.
#pragma once

#include <QDialog>
#include <functional>

#include "app/gui/study/OpenStudy.h"

namespace tacto::gui {

/// Enrols a participant and shows the code once, in large letters, for the participant to keep, not for notes.
/// `consentWanted` is called to continue with the consent.
[[nodiscard]] QDialog* enrolDialog(OpenStudy& study, std::function<void(const QString& code)> consentWanted,
                                   QWidget* parent);
/// Records a participant's consent: to which version, when, and before which investigator.
[[nodiscard]] QDialog* consentDialog(OpenStudy& study, const QString& code, QWidget* parent);
/// Ends a participant's part. Leaving keeps the data. Withdrawing destroys the key to the data, asks for the code once
/// more and says which copies it cannot reach.
enum class EndOfPart { Leave, Withdraw };
[[nodiscard]] QDialog* endPartDialog(OpenStudy& study, EndOfPart how, const QString& code, QWidget* parent);
/// Records an adverse event of a session; the record survives a withdrawal. `code`: the person whose last session is
/// selected first; may be empty.
[[nodiscard]] QDialog* adverseEventDialog(OpenStudy& study, const QString& code, QWidget* parent);
/// Releases the study after a serious adverse event, by name.
[[nodiscard]] QDialog* releaseDialog(OpenStudy& study, QWidget* parent);
/// Notes what standards of reporting ask (StudyLog.h); the particulars of the study are shown as they are known.
[[nodiscard]] QDialog* noteDialog(OpenStudy& study, const StudyLogKind& kind, QWidget* parent);
/// Asks what of age, sex and handedness an export carries, and says in which form. `wanted` is called with the answer.
[[nodiscard]] QDialog* exportDialog(OpenStudy& study, std::function<void(const BidsWith& with)> wanted,
                                    QWidget* parent);
/// Records what a participant reports on a day after a session: side effects, redness, swelling.
[[nodiscard]] QDialog* nextDayDialog(OpenStudy& study, const QString& code, QWidget* parent);
/// Changes a study's settings under an amendment approved by the committee, which has its own reference. `encoding`:
/// proposed as the only one; empty: no proposal.
[[nodiscard]] QDialog* amendDialog(OpenStudy& study, QWidget* parent, const QString& encoding = {});
/// Proposes the encoding that people told apart better, for this study or for others; nothing changes unasked.
/// `amendWanted` continues with an amendment; `profileWanted` is called with the profile to save.
struct UseOfEncoding {
    QString encoding;  ///< "swapped"
    QString found;     ///< why it is better
    std::function<void()> amendWanted;
    std::function<void(const Profile& profile)> profileWanted;
};
[[nodiscard]] QDialog* useEncodingDialog(OpenStudy& study, const UseOfEncoding& use, QWidget* parent);
/// Continues with a study's ledger that is older than the newest known on this computer: says what is lost, and asks
/// for the passphrase again and for the word that names the loss.
[[nodiscard]] QDialog* goBackDialog(OpenStudy& study, QWidget* parent);

}  // namespace tacto::gui
