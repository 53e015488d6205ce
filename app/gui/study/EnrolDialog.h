// EnrolDialog.h - enrols a participant and shows their code, once and large: for them to keep, not for notes. Leads to
// their consent.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>

#include "app/gui/study/StudyDialog.h"

namespace tacto::gui {

class EnrolDialog final : public StudyDialog {
    Q_OBJECT
public:
    /// `study` outlives it.
    EnrolDialog(OpenStudy& study, QWidget* parent);

signals:
    void consentWanted(const QString& code);  ///< the next step with the participant who was enrolled

private:
    void judge();
    void act();
    void enrol();
    void showCode(const Participant& participant);
    QWidget* form_;
    QComboBox* who_;
    QSpinBox* seed_;
    QComboBox* group_;
    QLineEdit* own_;
    QLineEdit* age_;
    QComboBox* sex_;
    QComboBox* hand_;
    QLabel* code_;
    QLabel* next_;
    QPushButton* enrol_;
    QPushButton* close_;
};

}  // namespace tacto::gui
