// StudyList.h - an open study on one page: its approval, its participants and sessions with their states in words, and
// what can be done with each. Every change has a dialog of its own.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>
#include <QWidget>

#include "app/gui/runner/ReportMaker.h"
#include "app/gui/study/OpenStudy.h"

namespace tacto::gui {

/// As RecordColumns.h shows them: {code, who, group, state, consent, sessions}; without those who withdrew.
[[nodiscard]] nlohmann::json participantRows(const Study& study);
class StudySessions;

class StudyList final : public QWidget {
    Q_OBJECT
public:
    /// `study` outlives it.
    explicit StudyList(OpenStudy& study, QWidget* parent = nullptr);
    /// A sentence in the way; empty for none.
    void say(const QString& what, bool trouble = true);
    /// Why no session can begin; nothing where one can.
    void sayWhatHinders();
    /// Empty where none is.
    [[nodiscard]] QString chosen() const;

signals:
    void sessionWanted(const QString& code);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void layOut();
    [[nodiscard]] QWidget* buildParticipants();
    [[nodiscard]] QWidget* buildOfOne();
    [[nodiscard]] QWidget* buildFoot();
    [[nodiscard]] QPushButton* button(const QString& text, const QString& tip, const char* name, QWidget* parent);
    void refresh();
    void showTables(const Study& study);
    void judge();
    void choose(const QString& code);
    void askForConsent(const QString& code);
    void makeReport(const QString& title, const QString& name, const QStringList& more);
    void askForExport(const BidsWith& with);
    [[nodiscard]] bool noteReport(const QString& out, const QStringList& more);

    OpenStudy& study_;
    ReportMaker reports_;
    QString code_;  ///< of the participant that is chosen
    QLabel* title_;
    QLabel* facts_;
    QLabel* trouble_;
    QVBoxLayout* tables_;
    QTableWidget* participants_ = nullptr;
    QLabel* withdrawn_;
    StudySessions* sessions_;
    std::vector<QPushButton*> ofOne_;  ///< need a participant
    std::vector<QPushButton*> all_;    ///< need the study
    QAction* goBack_ = nullptr;        ///< in sight where the ledger is not the newest known
    QWidget* ofOneRow_ = nullptr;
};

}  // namespace tacto::gui
