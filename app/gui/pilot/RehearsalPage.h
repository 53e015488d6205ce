// RehearsalPage.h - what a rehearsal needs before it begins: where its study lies, who answers, with what, and on which
// screen.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QWidget>

#include "app/gui/pilot/AnswerKeys.h"

namespace tacto::gui {

class ScreenChoice;

struct Rehearsal {
    QString folder;
    bool person = false;     ///< the one at the participant's window answers; else a virtual participant
    std::uint64_t seed = 1;  ///< of plan, order, and the virtual participant
    int blocks = 5;
    bool blind = true;
    KeySet keys = KeySet::Figures;
};

class RehearsalPage final : public QWidget {
    Q_OBJECT
public:
    explicit RehearsalPage(QWidget* parent = nullptr);
    [[nodiscard]] Rehearsal rehearsal() const;
    [[nodiscard]] ScreenChoice& screens() { return *screen_; }
    /// A sentence in the way; empty for none.
    void say(const QString& what);
    void setChangeable(bool changeable);

signals:
    void beginWanted();

private:
    void judge();
    QLineEdit* folder_;
    QComboBox* who_;
    QSpinBox* seed_;
    QSpinBox* blocks_;
    QCheckBox* blind_;
    QComboBox* keys_;
    ScreenChoice* screen_;
    QLabel* about_;
    QLabel* trouble_;
    QPushButton* begin_;
};

}  // namespace tacto::gui
